/** Structures of analogue inputs and outputs; no device here uses them. */
@NullMarked
package io.troupe.player.structures.aio;

import org.jspecify.annotations.NullMarked;
