package io.troupe.bench.bus;

import io.troupe.bench.BuildTable;
import io.troupe.bench.TurnMeter;
import io.troupe.bench.bus.BusWorkload.Part;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.function.BiFunction;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * The workloads of {@link CompareBuses} for our bus: its codec, and requests, calls of actors and publications, within
 * a process and over a server.
 */
public final class BusTable implements BuildTable {
    private static final String CODEC = "codec, ";

    /** Two nodes, and where they are. */
    private enum Place {
        PROCESS("within a process, "),
        SERVER("over NATS, ");

        private final String prefix;

        Place(String prefix) {
            this.prefix = prefix;
        }
    }

    /** What two nodes do. */
    private enum Traffic {
        ASK_64("request of 64 bytes"),
        ASK_1000("request of 1,000 bytes"),
        CALL("call of an actor"),
        PUBLISH("publication");

        private final String label;

        Traffic(String label) {
            this.label = label;
        }
    }

    private final @Nullable String server;
    private final String application;
    private final Map<Place, BusPair> busPairs = new EnumMap<>(Place.class);
    private final Map<Place, BusPair> actorPairs = new EnumMap<>(Place.class);
    private @Nullable CodecSubject codec;

    /**
     * A table.
     *
     * @param server its address; null if there is none
     * @param application the name of this table's nodes at the server, which other tables do not have
     */
    public BusTable(@Nullable String server, String application) {
        this.server = server;
        this.application = application;
    }

    @Override
    public List<Row> rows() {
        List<Row> rows = new ArrayList<>();
        for (BusWorkload each : Part.CODEC.workloads()) {
            rows.add(new Row(CODEC + each.label(), Choice.QUICK, ""));
        }
        for (Place place : server == null ? List.of(Place.PROCESS) : List.of(Place.values())) {
            for (Traffic traffic : Traffic.values()) {
                boolean hasNode = place == Place.PROCESS && traffic == Traffic.PUBLISH;
                rows.add(new Row(place.prefix + traffic.label, Choice.QUICK, hasNode ? "node" : ""));
            }
        }
        return rows;
    }

    @Override
    public Turn turn(String row, int operations) throws Exception {
        if (row.startsWith(CODEC)) {
            BusWorkload workload = named(row.substring(CODEC.length()));
            CodecSubject subject = codec();
            return TurnMeter.measure((long) operations * CodecSubject.BATCH, () -> {
                for (int i = 0; i < operations; i++) {
                    subject.run(workload);
                }
            });
        }
        Place place = row.startsWith(Place.PROCESS.prefix) ? Place.PROCESS : Place.SERVER;
        for (Traffic traffic : Traffic.values()) {
            if (row.equals(place.prefix + traffic.label)) {
                return turn(place, traffic, operations);
            }
        }
        throw new IllegalArgumentException("no row is called " + row);
    }

    private Turn turn(Place place, Traffic traffic, int operations) throws Exception {
        return switch (traffic) {
            case ASK_64 -> asks(busPair(place), BusWorkload.ASK_64, operations);
            case ASK_1000 -> asks(busPair(place), BusWorkload.ASK_1000, operations);
            case CALL -> asks(actorPair(place), BusWorkload.ASK_64, operations);
            case PUBLISH -> {
                BusPair pair = busPair(place);
                yield TurnMeter.measure((long) operations * BusPair.RECORDS, () -> {
                    for (int i = 0; i < operations; i++) {
                        pair.publishAll();
                    }
                });
            }
        };
    }

    private static Turn asks(BusPair pair, BusWorkload workload, int operations) throws Exception {
        return TurnMeter.measure(operations, () -> pair.askWhile(workload.payloadBytes(), new Countdown(operations)));
    }

    /** True until so many operations have been counted. */
    private static final class Countdown implements BooleanSupplier {
        private int left; // of the space that asks

        Countdown(int operations) {
            left = operations;
        }

        @Override
        public boolean getAsBoolean() {
            return --left > 0;
        }
    }

    @Override
    public double keptBytes(String row) throws Exception {
        return BusMemory.ofNode(new LoopEngine.Group()::open, (bus, space) -> {})
                .heapBytes();
    }

    private static BusWorkload named(String label) {
        return Part.CODEC.workloads().stream()
                .filter(each -> each.label().equals(label))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("no codec is measured for " + label));
    }

    private CodecSubject codec() {
        if (codec == null) {
            codec = CodecSubject.of(BusContender.TROUPE, 1);
        }
        return codec;
    }

    private BusPair busPair(Place place) throws Exception {
        BusPair pair = busPairs.get(place);
        if (pair == null) {
            pair = new TroupePair(opening(place, "bus"));
            busPairs.put(place, pair);
        }
        return pair;
    }

    private BusPair actorPair(Place place) throws Exception {
        BusPair pair = actorPairs.get(place);
        if (pair == null) {
            pair = new ActorPair(opening(place, "actor"));
            actorPairs.put(place, pair);
        }
        return pair;
    }

    /** Opens the nodes of one pair, which see each other and no others. */
    private BiFunction<String, BusSettings, Bus> opening(Place place, String pair) {
        if (place == Place.PROCESS) {
            return new LoopEngine.Group()::open;
        }
        var settings = NatsSettings.at(Objects.requireNonNull(server, "rows over NATS have a server"))
                .withApplication(application + "-" + pair);
        return (node, busSettings) -> NatsBus.open(node, settings, busSettings);
    }
}
