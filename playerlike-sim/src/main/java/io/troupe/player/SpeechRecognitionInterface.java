package io.troupe.player;

import io.troupe.player.structures.speechrecognition.PlayerSpeechRecognitionData;

/**
 * A speech recognizer, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface speech_recognition.
 */
public class SpeechRecognitionInterface extends UnofferedDevice {
    public SpeechRecognitionInterface(PlayerClient client) {
        super(client, "speech_recognition");
    }

    public PlayerSpeechRecognitionData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }
}
