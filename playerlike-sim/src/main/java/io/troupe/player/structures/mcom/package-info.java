/** Structures of a store of messages between clients; no device here uses them. */
@NullMarked
package io.troupe.player.structures.mcom;

import org.jspecify.annotations.NullMarked;
