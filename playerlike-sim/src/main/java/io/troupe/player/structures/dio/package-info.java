/** Structures of the Player interface dio: digital inputs and outputs. This client does not use them. */
@NullMarked
package io.troupe.player.structures.dio;

import org.jspecify.annotations.NullMarked;
