/** Structures of requests to the server itself. */
@NullMarked
package io.troupe.player.structures.player;

import org.jspecify.annotations.NullMarked;
