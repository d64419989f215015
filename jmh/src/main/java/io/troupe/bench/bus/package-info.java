/** Compares the bus between processes, and its codec, with NATS by itself and with Jackson. */
@NullMarked
package io.troupe.bench.bus;

import org.jspecify.annotations.NullMarked;
