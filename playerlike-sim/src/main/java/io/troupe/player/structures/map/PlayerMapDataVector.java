package io.troupe.player.structures.map;

import io.troupe.player.structures.PlayerSegment;

/** Part of a message of the Player interface map. This client does not use it. */
public class PlayerMapDataVector {
    private float minx;
    private float maxx;
    private float miny;
    private float maxy;
    private int segments_count;
    private PlayerSegment[] segments = new PlayerSegment[0];

    public synchronized float getMinx() {
        return minx;
    }

    public synchronized void setMinx(float value) {
        minx = value;
    }

    public synchronized float getMaxx() {
        return maxx;
    }

    public synchronized void setMaxx(float value) {
        maxx = value;
    }

    public synchronized float getMiny() {
        return miny;
    }

    public synchronized void setMiny(float value) {
        miny = value;
    }

    public synchronized float getMaxy() {
        return maxy;
    }

    public synchronized void setMaxy(float value) {
        maxy = value;
    }

    public synchronized int getSegments_count() {
        return segments_count;
    }

    public synchronized void setSegments_count(int value) {
        segments_count = value;
    }

    public synchronized PlayerSegment[] getSegments() {
        return segments;
    }

    public synchronized void setSegments(PlayerSegment[] value) {
        segments = value;
    }
}
