/** Structures of an arm; no device here uses them. */
@NullMarked
package io.troupe.player.structures.limb;

import org.jspecify.annotations.NullMarked;
