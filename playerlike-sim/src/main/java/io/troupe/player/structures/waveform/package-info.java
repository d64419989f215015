/** Structures of the Player interface waveform: waveforms. This client does not use them. */
@NullMarked
package io.troupe.player.structures.waveform;

import org.jspecify.annotations.NullMarked;
