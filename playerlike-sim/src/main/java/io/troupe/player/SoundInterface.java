package io.troupe.player;

/**
 * Sound clips. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface sound.
 */
public class SoundInterface extends UnsupportedDevice {
    public SoundInterface(PlayerClient client) {
        super(client, "sound");
    }

    public void play(int index) {
        throw notSupported();
    }
}
