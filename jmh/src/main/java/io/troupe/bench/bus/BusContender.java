package io.troupe.bench.bus;

import io.troupe.bench.BenchmarkCommand;
import java.util.Arrays;

/** The contenders. */
enum BusContender {
    /** Our codec, and our bus over NATS. */
    TROUPE("troupe"),
    /** Calls of an actor on another node, by its interface. */
    ACTOR("troupe-actor"),
    /** The NATS client by itself, with the same bytes. */
    RAW("raw-nats"),
    /** Jackson's CBOR. */
    JACKSON("jackson");

    private final String label;

    BusContender(String label) {
        this.label = label;
    }

    String label() {
        return label;
    }

    static BusContender named(String label) {
        return Arrays.stream(values())
                .filter(each -> each.label.equals(label))
                .findFirst()
                .orElseThrow(() -> BenchmarkCommand.unknown(
                        label, Arrays.stream(values()).map(each -> each.label).toList()));
    }
}
