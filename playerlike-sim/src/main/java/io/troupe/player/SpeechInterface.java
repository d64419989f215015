package io.troupe.player;

/**
 * A speech synthesizer, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface speech.
 */
public class SpeechInterface extends UnofferedDevice {
    public SpeechInterface(PlayerClient client) {
        super(client, "speech");
    }

    public void speech(String text) {
        throw notOffered();
    }
}
