/** Structures of a localization; no device here uses them. */
@NullMarked
package io.troupe.player.structures.localize;

import org.jspecify.annotations.NullMarked;
