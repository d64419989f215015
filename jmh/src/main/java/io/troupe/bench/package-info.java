/** Benchmarks of the actors and of the net searches: workloads, contenders, harness and reports. */
@NullMarked
package io.troupe.bench;

import org.jspecify.annotations.NullMarked;
