/** Structures of infrared sensors; no device here uses them. */
@NullMarked
package io.troupe.player.structures.ir;

import org.jspecify.annotations.NullMarked;
