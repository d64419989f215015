/** Structures of digital inputs and outputs; no device here uses them. */
@NullMarked
package io.troupe.player.structures.dio;

import org.jspecify.annotations.NullMarked;
