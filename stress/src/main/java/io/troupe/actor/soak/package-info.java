/** Many messages from many threads, for a while: nothing lost, nothing out of order, nothing kept. */
@NullMarked
package io.troupe.actor.soak;

import org.jspecify.annotations.NullMarked;
