/** What the processes of a run have written down, and what has to be true of it. */
@NullMarked
package io.troupe.faults.history;

import org.jspecify.annotations.NullMarked;
