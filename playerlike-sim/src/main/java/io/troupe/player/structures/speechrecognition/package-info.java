/** Structures of a speech recognizer; no device here uses them. */
@NullMarked
package io.troupe.player.structures.speechrecognition;

import org.jspecify.annotations.NullMarked;
