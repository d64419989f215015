package io.troupe.player;

import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPoints;
import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPolygon;
import io.troupe.player.structures.graphics2d.PlayerGraphics2dCmdPolyline;

/**
 * 2D graphics. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface graphics2d.
 */
public class Graphics2DInterface extends UnsupportedDevice {
    public Graphics2DInterface(PlayerClient client) {
        super(client, "graphics2d");
    }

    public void clearScreen() {
        throw notSupported();
    }

    public void drawPoints(PlayerGraphics2dCmdPoints value) {
        throw notSupported();
    }

    public void drawPolyline(PlayerGraphics2dCmdPolyline value) {
        throw notSupported();
    }

    public void drawPolygon(PlayerGraphics2dCmdPolygon value) {
        throw notSupported();
    }
}
