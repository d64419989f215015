/**
 * What promises and actor spaces share: the event loop with its queue entries, queues and timers. For generated code
 * and for this library; may change at any time.
 */
@NullMarked
package io.troupe.actor.internal.loop;

import org.jspecify.annotations.NullMarked;
