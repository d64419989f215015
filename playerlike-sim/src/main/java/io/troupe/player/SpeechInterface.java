package io.troupe.player;

/**
 * A speech synthesizer. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface speech.
 */
public class SpeechInterface extends UnsupportedDevice {
    public SpeechInterface(PlayerClient client) {
        super(client, "speech");
    }

    public void speech(String text) {
        throw notSupported();
    }
}
