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
public class MapInterface extends UnofferedDevice {
    public MapInterface(PlayerClient client) {
        super(client, "map");
    }

    public void requestMapInformation() {
        throw notOffered();
    }

    public void requestMapData(PlayerMapData value) {
        throw notOffered();
    }

    public void requestMapDataVector() {
        throw notOffered();
    }

    public PlayerMapInfo getData() {
        throw notOffered();
    }

    public boolean isDataReady() {
        throw notOffered();
    }

    public PlayerMapData getGridData() {
        throw notOffered();
    }

    public boolean isGridDataReady() {
        throw notOffered();
    }

    public PlayerMapDataVector getMapDataVector() {
        throw notOffered();
    }

    public boolean isMapDataVectorReady() {
        throw notOffered();
    }
}
