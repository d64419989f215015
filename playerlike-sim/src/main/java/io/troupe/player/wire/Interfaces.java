package io.troupe.player.wire;

import org.jspecify.annotations.Nullable;

/** The supported Player interfaces, with code and name. */
public enum Interfaces {
    POSITION2D(4, "position2d"),
    SONAR(5, "sonar"),
    RANGER(62, "ranger"),
    LASER(6, "laser"),
    BLOBFINDER(7, "blobfinder"),
    SIMULATION(31, "simulation"),
    FIDUCIAL(10, "fiducial"),
    BUMPER(14, "bumper"),
    CAMERA(40, "camera"),
    GRIPPER(3, "gripper");

    private final int code;
    private final String playerName;

    Interfaces(int code, String playerName) {
        this.code = code;
        this.playerName = playerName;
    }

    public int code() {
        return code;
    }

    public String playerName() {
        return playerName;
    }

    /** Null for an interface that is not supported. */
    static @Nullable Interfaces find(int code) {
        for (var each : values()) {
            if (each.code == code) {
                return each;
            }
        }
        return null;
    }

    /** The name of an interface, or its number if it is unknown. */
    public static String name(int code) {
        Interfaces known = find(code);
        return known == null ? "interface" + code : known.playerName;
    }
}
