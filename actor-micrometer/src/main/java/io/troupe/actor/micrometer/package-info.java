/** The figures of actor spaces as meters of Micrometer. */
@NullMarked
package io.troupe.actor.micrometer;

import org.jspecify.annotations.NullMarked;
