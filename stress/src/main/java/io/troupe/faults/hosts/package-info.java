/** The hosts of a run: network namespaces, or processes on loopback. */
@NullMarked
package io.troupe.faults.hosts;

import org.jspecify.annotations.NullMarked;
