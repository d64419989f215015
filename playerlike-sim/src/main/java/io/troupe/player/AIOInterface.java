package io.troupe.player;

import io.troupe.player.structures.aio.PlayerAioData;

/**
 * Analogue inputs and outputs, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface aio.
 */
public class AIOInterface extends UnofferedDevice {
    public AIOInterface(PlayerClient client) {
        super(client, "aio");
    }

    public PlayerAioData getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public void setState(int id, float voltage) {
        throw notOffered();
    }
}
