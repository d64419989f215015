package io.troupe.player;

import io.troupe.player.structures.map.PlayerMapData;
import io.troupe.player.structures.map.PlayerMapDataVector;
import io.troupe.player.structures.map.PlayerMapInfo;

/**
 * A map, which this client does not offer: a name for programs that mention it.
 *
 * <p><b>Errors.</b> Each method throws {@link PlayerException}, which says what there is.
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
