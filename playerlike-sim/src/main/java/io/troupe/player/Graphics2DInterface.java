package io.troupe.player;

import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPoints;
import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPolygon;
import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPolyline;

/**
 * Drawings in a plane, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
 *
 * <p><b>Source.</b> Player interface graphics2d.
 */
public class Graphics2DInterface extends UnofferedDevice {
    public Graphics2DInterface(PlayerClient client) {
        super(client, "graphics2d");
    }

    public void clearScreen() {
        throw notOffered();
    }

    public void drawPoints(PlayerGraphics2dCmdPoints value) {
        throw notOffered();
    }

    public void drawPolyline(PlayerGraphics2dCmdPolyline value) {
        throw notOffered();
    }

    public void drawPolygon(PlayerGraphics2dCmdPolygon value) {
        throw notOffered();
    }
}
