package io.troupe.player;

import io.troupe.player.structures.speechrecognition.PlayerSpeechRecognitionData;

/**
 * A speech recognizer. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface speech_recognition.
 */
public class SpeechRecognitionInterface extends UnsupportedDevice {
    public SpeechRecognitionInterface(PlayerClient client) {
        super(client, "speech_recognition");
    }

    public PlayerSpeechRecognitionData getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }
}
