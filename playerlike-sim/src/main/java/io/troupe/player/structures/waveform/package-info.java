/** Structures of a source of waveforms; no device here uses them. */
@NullMarked
package io.troupe.player.structures.waveform;

import org.jspecify.annotations.NullMarked;
