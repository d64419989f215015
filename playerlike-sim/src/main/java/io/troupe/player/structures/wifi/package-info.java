/** Structures of a wireless network; no device here uses them. */
@NullMarked
package io.troupe.player.structures.wifi;

import org.jspecify.annotations.NullMarked;
