package io.troupe.player;

/**
 * Sound clips, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface sound.
 */
public class SoundInterface extends UnofferedDevice {
    public SoundInterface(PlayerClient client) {
        super(client, "sound");
    }

    public void play(int index) {
        throw notOffered();
    }
}
