package io.troupe.player.wire;

/** When a server sends data. */
public enum Delivery {
    /** As soon as they are published. */
    PUSH,
    /** When they are asked for. */
    PULL
}
