/** Test kit: a space cranked by hand, a manual clock, and probes that record what actors do. */
@NullMarked
package io.troupe.actor.testkit;

import org.jspecify.annotations.NullMarked;
