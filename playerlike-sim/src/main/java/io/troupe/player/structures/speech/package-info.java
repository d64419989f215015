/** Structures of a speech synthesizer; no device here uses them. */
@NullMarked
package io.troupe.player.structures.speech;

import org.jspecify.annotations.NullMarked;
