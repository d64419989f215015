package io.troupe.player.wire;

/** When a server sends data. */
public enum Delivery {
    /** As soon as data are published. */
    PUSH,
    /** On request. */
    PULL
}
