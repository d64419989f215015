package io.troupe.bench.bus;

import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.tools.MeasuringJvm;
import java.io.IOException;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** A contender in a separate JVM. Between two requests that process waits, and uses next to no processor. */
final class BusProcess implements AutoCloseable {
    private static final Duration LIMIT = Duration.ofMinutes(5);

    private final BusContender contender;
    private final MeasuringJvm jvm;

    /** @param server its address; unused by codecs */
    BusProcess(BusContender contender, String server) throws IOException {
        this.contender = contender;
        this.jvm = MeasuringJvm.running(Child.class, contender.label(), server)
                .withOptions("-Xmx512m", "-XX:+UseG1GC")
                .withLimit(LIMIT)
                .start();
    }

    BusContender contender() {
        return contender;
    }

    BusTurn turn(BusWorkload workload, int millis) throws IOException {
        return BusTurn.parse(ask("turn " + workload + " " + millis));
    }

    /** The bytes of an encoded value, or of the frame of a request or publication. */
    double encodedBytes(BusWorkload workload) throws IOException {
        return Double.parseDouble(ask("encoded " + workload));
    }

    BusMemory.Cost costOf(BusResults.Node node) throws IOException {
        return BusMemory.Cost.parse(ask("node " + node));
    }

    private String ask(String request) throws IOException {
        return jvm.ask(request, contender.label() + ", " + request).getFirst();
    }

    @Override
    public void close() {
        jvm.close();
    }

    /**
     * The main class of a contender's JVM. It answers {@code turn <workload> <millis>} by a {@link BusTurn};
     * {@code encoded <workload>} by a number of bytes; and {@code node <kind>} by what such a node costs.
     */
    static final class Child {
        private final BusContender contender;
        private final String server;
        private @Nullable CodecSubject codec;
        private @Nullable BusPair pair;

        Child(BusContender contender, String server) {
            this.contender = contender;
            this.server = server;
        }

        public static void main(String[] arguments) throws Exception {
            MeasuringJvm.serve(() -> {
                var child = new Child(BusContender.named(arguments[0]), arguments[1]);
                return request -> List.of(child.answer(request.split(" ")));
            });
        }

        private String answer(String[] command) throws Exception {
            return switch (command[0]) {
                case "turn" ->
                    turn(BusWorkload.valueOf(command[1]), Long.parseLong(command[2]) * 1_000_000)
                            .line();
                case "encoded" -> Double.toString(encodedBytes(BusWorkload.valueOf(command[1])));
                case "node" -> costOf(BusResults.Node.valueOf(command[1])).line();
                default ->
                    throw new IllegalArgumentException(
                            "a command is " + command[0] + ", expected turn, encoded or node");
            };
        }

        BusTurn turn(BusWorkload workload, long nanos) throws Exception {
            return switch (workload.part()) {
                case CODEC -> {
                    var subject = codec();
                    yield BusTurn.ofBatches(
                            () -> subject.run(workload), CodecSubject.BATCH, nanos, BusTurn::ofThisThread);
                }
                case ASK -> {
                    var both = pair();
                    int payloadBytes = workload.payloadBytes();
                    yield BusTurn.ofEach(again -> both.askWhile(payloadBytes, again), nanos);
                }
                case PUBLISH -> BusTurn.ofBatches(pair()::publishAll, BusPair.RECORDS, nanos, System::nanoTime);
                case MEMORY -> throw new IllegalArgumentException("memory has no turns");
            };
        }

        private double encodedBytes(BusWorkload workload) throws Exception {
            return switch (workload.part()) {
                case CODEC -> codec().encodedBytes(workload);
                case ASK ->
                    contender == BusContender.ACTOR
                            ? LoopEngine.Sample.callBytes(workload.payloadBytes())
                            : LoopEngine.Sample.of(workload.payloadBytes()).request().length;
                case PUBLISH ->
                    LoopEngine.Sample.of(BusWorkload.ASK_64.payloadBytes()).publication().length;
                case MEMORY -> throw new IllegalArgumentException("memory has no values");
            };
        }

        BusMemory.Cost costOf(BusResults.Node node) throws Exception {
            return switch (node) {
                case ALONE -> BusMemory.ofNode(new LoopEngine.Group()::open, (bus, space) -> {});
                case CONNECTED -> BusMemory.ofNode(this::open, (bus, space) -> {});
                case SERVICES ->
                    BusMemory.ofNode(
                            this::openAlone,
                            (bus, space) -> ActorPair.publishEcho(ActorPair.services(bus, space), space));
            };
        }

        void close() {
            if (pair != null) {
                pair.close();
            }
        }

        private CodecSubject codec() {
            if (codec == null) {
                codec = CodecSubject.of(contender, 1);
            }
            return codec;
        }

        private BusPair pair() throws Exception {
            if (pair == null) {
                pair = switch (contender) {
                    case RAW -> new RawPair(server);
                    case ACTOR -> new ActorPair(this::open);
                    default -> new TroupePair(this::open);
                };
            }
            return pair;
        }

        private Bus open(String node, BusSettings settings) {
            var ownNames = NatsSettings.at(server).withApplication(contender.label()); // contenders run side by side
            return NatsBus.open(node, ownNames, settings);
        }

        /** Opens a node that has no others: offers of others would count as its memory. */
        private Bus openAlone(String node, BusSettings settings) {
            return NatsBus.open(node, NatsSettings.at(server).withApplication(node), settings);
        }
    }
}
