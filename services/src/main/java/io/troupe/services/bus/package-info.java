/** The messaging infrastructure: names, addresses, typed topics and operations, data and control messages. */
@NullMarked
package io.troupe.services.bus;

import org.jspecify.annotations.NullMarked;
