package io.troupe.player;

import io.troupe.player.structures.map.PlayerMapData;
import io.troupe.player.structures.map.PlayerMapDataVector;
import io.troupe.player.structures.map.PlayerMapInfo;

/**
 * A map. This client does not support it; the class exists so that programs that mention it compile.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, whose message lists the supported interfaces and the
 * devices of the server.
 *
 * <p><b>Source.</b> Player interface map.
 */
public class MapInterface extends UnsupportedDevice {
    public MapInterface(PlayerClient client) {
        super(client, "map");
    }

    public void requestMapInformation() {
        throw notSupported();
    }

    public void requestMapData(PlayerMapData value) {
        throw notSupported();
    }

    public void requestMapDataVector() {
        throw notSupported();
    }

    public PlayerMapInfo getData() {
        throw notSupported();
    }

    public boolean isDataReady() {
        throw notSupported();
    }

    public PlayerMapData getGridData() {
        throw notSupported();
    }

    public boolean isGridDataReady() {
        throw notSupported();
    }

    public PlayerMapDataVector getMapDataVector() {
        throw notSupported();
    }

    public boolean isMapDataVectorReady() {
        throw notSupported();
    }
}
