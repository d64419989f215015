/** Structures of messages of a driver that has its own; no device here uses them. */
@NullMarked
package io.troupe.player.structures.opaque;

import org.jspecify.annotations.NullMarked;
