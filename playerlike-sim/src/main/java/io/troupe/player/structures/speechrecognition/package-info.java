/** Structures of the Player interface speech_recognition: a speech recognizer. This client does not use them. */
@NullMarked
package io.troupe.player.structures.speechrecognition;

import org.jspecify.annotations.NullMarked;
