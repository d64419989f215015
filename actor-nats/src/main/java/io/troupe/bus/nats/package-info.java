/** The bus over hosts: {@link io.troupe.bus.nats.NatsBus} carries the messages of a bus by a NATS server. */
@NullMarked
package io.troupe.bus.nats;

import org.jspecify.annotations.NullMarked;
