/** Data structures and constants of the Player Java client. */
@NullMarked
package io.troupe.player.structures;

import org.jspecify.annotations.NullMarked;
