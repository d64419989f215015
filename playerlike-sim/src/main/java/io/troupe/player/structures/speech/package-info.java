/** Structures of the Player interface speech: a speech synthesizer. This client does not use them. */
@NullMarked
package io.troupe.player.structures.speech;

import org.jspecify.annotations.NullMarked;
