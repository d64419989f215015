/** Data of the sonar interface: a ring of range sensors. */
@NullMarked
package io.troupe.player.structures.sonar;

import org.jspecify.annotations.NullMarked;
