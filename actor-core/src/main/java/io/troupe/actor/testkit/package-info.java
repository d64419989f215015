/** Test kit: a space without a thread, a manual clock, and probes that record what actors do. */
@NullMarked
package io.troupe.actor.testkit;

import org.jspecify.annotations.NullMarked;
