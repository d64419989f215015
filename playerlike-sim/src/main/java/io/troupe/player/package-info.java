/** The client's view of a robot: the names of the Player Java client. */
@NullMarked
package io.troupe.player;

import org.jspecify.annotations.NullMarked;
