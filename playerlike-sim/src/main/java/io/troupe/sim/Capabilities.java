package io.troupe.sim;

import io.troupe.player.wire.Interfaces;
import java.util.List;

/** The messages that the simulated devices understand, as Player's type and subtype numbers. */
final class Capabilities {
    private static final int DATA = 1;
    private static final int COMMAND = 2;
    private static final int REQUEST = 3;
    /** Subtype of the capability request itself. */
    private static final int CAPABILITY = 255;

    private Capabilities() {}

    static boolean understands(Interfaces device, int type, int subtype) {
        return type == REQUEST && subtype == CAPABILITY
                || subtypes(device, type).contains(subtype);
    }

    private static List<Integer> subtypes(Interfaces device, int type) {
        return switch (type) {
            case DATA -> device == Interfaces.SIMULATION ? List.of() : List.of(1);
            case COMMAND ->
                switch (device) {
                    case POSITION2D -> List.of(1, 2, 3, 4);
                    case SIMULATION -> List.of(1, 2);
                    case SONAR, RANGER, LASER, BLOBFINDER -> List.of();
                };
            case REQUEST ->
                switch (device) {
                    case POSITION2D -> List.of(1, 2, 4, 5, 6, 253);
                    case SONAR, SIMULATION -> List.of(1, 2);
                    case RANGER -> List.of(1, 2, 3, 4, 5);
                    case LASER -> List.of(1, 2, 3, 4, 5);
                    case BLOBFINDER -> List.of();
                };
            default -> List.of();
        };
    }
}
