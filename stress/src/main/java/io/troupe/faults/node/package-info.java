/** The processes on the hosts. */
@NullMarked
package io.troupe.faults.node;

import org.jspecify.annotations.NullMarked;
