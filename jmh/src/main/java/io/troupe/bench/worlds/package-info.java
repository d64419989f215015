/** Benchmarks that compare the simulator with other ways to simulate the same robots. */
@NullMarked
package io.troupe.bench.worlds;

import org.jspecify.annotations.NullMarked;
