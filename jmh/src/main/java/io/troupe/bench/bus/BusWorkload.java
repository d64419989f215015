package io.troupe.bench.bus;

import java.util.List;
import java.util.stream.Stream;

/** What is measured of each contender. */
enum BusWorkload {
    ENCODE_SONAR(Part.CODEC, "sonar, encode"),
    DECODE_SONAR(Part.CODEC, "sonar, decode"),
    ENCODE_VELOCITY(Part.CODEC, "velocity, encode"),
    DECODE_VELOCITY(Part.CODEC, "velocity, decode"),
    ENCODE_REPORT(Part.CODEC, "nested, encode"),
    DECODE_REPORT(Part.CODEC, "nested, decode"),
    ASK_64(Part.ASK, "64 bytes"),
    ASK_1000(Part.ASK, "1,000 bytes"),
    PUBLISH(Part.PUBLISH, "sonar records");

    /** A part of the comparison, with its own table. */
    enum Part {
        CODEC,
        ASK,
        PUBLISH,
        MEMORY;

        /** The contenders, ours first, and last the one that they are compared with. */
        List<BusContender> contenders() {
            return switch (this) {
                case CODEC -> List.of(BusContender.TROUPE, BusContender.JACKSON);
                case ASK -> List.of(BusContender.TROUPE, BusContender.ACTOR, BusContender.RAW);
                case PUBLISH -> List.of(BusContender.TROUPE, BusContender.RAW);
                case MEMORY -> List.of(BusContender.TROUPE);
            };
        }

        List<BusWorkload> workloads() {
            return Stream.of(BusWorkload.values())
                    .filter(each -> each.part == this)
                    .toList();
        }
    }

    private final Part part;
    private final String label;

    BusWorkload(Part part, String label) {
        this.part = part;
        this.label = label;
    }

    Part part() {
        return part;
    }

    String label() {
        return label;
    }

    /** The bytes of the text in a request; only for requests. */
    int payloadBytes() {
        return switch (this) {
            case ASK_64 -> 64;
            case ASK_1000 -> 1_000;
            default -> throw new IllegalArgumentException(this + " sends no requests");
        };
    }
}
