package io.troupe.player;

import io.troupe.player.structures.graphics3d.PlayerGraphics3dCmdDraw;

/**
 * Drawings in space, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface graphics3d.
 */
public class Graphics3DInterface extends UnofferedDevice {
    public Graphics3DInterface(PlayerClient client) {
        super(client, "graphics3d");
    }

    public void clearScreen() {
        throw notOffered();
    }

    public void draw(PlayerGraphics3dCmdDraw value) {
        throw notOffered();
    }
}
