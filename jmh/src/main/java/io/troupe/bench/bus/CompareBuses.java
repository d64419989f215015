package io.troupe.bench.bus;

import io.troupe.bench.BenchmarkCommand;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.bench.ComparisonOptions;
import io.troupe.bench.bus.BusWorkload.Part;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Random;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

/**
 * Compares our bus between processes with the NATS client by itself, and our codec with Jackson's CBOR.
 *
 * <p><b>Role.</b> Every contender runs in a separate JVM, with both connections of a pair in it. They take turns of
 * fixed wall-clock time in random order while the others wait, so that all of them run under the same conditions. The
 * result is the ratio to the other contender in the same round. The command starts a server on loopback.
 *
 * <p><b>Errors.</b> The comparison ends if a contender fails, or loses a message. If {@code nats-server} is needed and
 * not installed, the exit status is 3.
 */
@Command(
        name = "CompareBuses",
        description = "Compares our bus with the NATS client by itself, and our codec with Jackson's CBOR.",
        showDefaultValues = true)
public final class CompareBuses implements Callable<Integer> {
    static final int NO_SERVER = 3;

    @Option(
            names = "--parts",
            paramLabel = "NAME",
            split = ",",
            converter = PartConverter.class,
            description = "codec, ask, publish, memory; codec needs no server")
    List<Part> parts = List.of(Part.values());

    @Mixin
    final ComparisonOptions comparison = new ComparisonOptions(15, 5_000);

    @Option(names = "--turn", paramLabel = "MILLIS", converter = AtLeastOne.class, description = "of a turn")
    int turnMillis = 500;

    private final BusResults results = new BusResults(
            new EnumMap<>(BusWorkload.class), new EnumMap<>(BusWorkload.class), new EnumMap<>(BusResults.Node.class));

    /** Replaces the options before it, and is replaced by those after it. */
    @Option(
            names = "--quick",
            description = "as --rounds 5 --turn 200 --warm-up 2000",
            showDefaultValue = Visibility.NEVER)
    private void quick(boolean chosen) {
        if (chosen) {
            comparison.rounds = 5;
            turnMillis = 200;
            comparison.warmUpMillis = 2_000;
        }
    }

    public static void main(String[] arguments) {
        System.exit(BenchmarkCommand.of(new CompareBuses()).execute(arguments));
    }

    /** Converts the names of parts. */
    static final class PartConverter implements ITypeConverter<Part> {
        @Override
        public Part convert(String name) {
            return Arrays.stream(Part.values())
                    .filter(each -> nameOf(each).equals(name))
                    .findFirst()
                    .orElseThrow(() -> BenchmarkCommand.unknown(
                            name,
                            Arrays.stream(Part.values())
                                    .map(PartConverter::nameOf)
                                    .toList()));
        }

        private static String nameOf(Part part) {
            return part.name().toLowerCase(Locale.ROOT);
        }
    }

    @Override
    public Integer call() throws IOException {
        return call(NatsServerProcess.isInstalled());
    }

    int call(boolean isInstalled) throws IOException {
        boolean needsServer = parts.stream().anyMatch(part -> part != Part.CODEC);
        if (needsServer && !isInstalled) {
            System.err.println(NatsServerProcess.HOW_TO_GET + "; or measure without it: --parts codec");
            return NO_SERVER;
        }
        double load = load();
        if (needsServer) {
            try (var server = NatsServerProcess.start()) {
                measure(server.address());
            }
        } else {
            measure("none");
        }
        System.out.printf(
                Locale.ROOT,
                "Java %s, %d processors, %d rounds of %d ms, seed %d, load average %.1f before and %.1f after%n",
                Runtime.version(),
                Runtime.getRuntime().availableProcessors(),
                comparison.rounds,
                turnMillis,
                comparison.seed,
                load,
                load());
        System.out.print(new BusReport(results).tables());
        if (comparison.figure != null) {
            Files.writeString(comparison.figure, BusDrawing.of(results).svg());
        }
        return 0;
    }

    private static double load() {
        return ManagementFactory.getOperatingSystemMXBean().getSystemLoadAverage();
    }

    private void measure(String server) throws IOException {
        try (var line = ProgressLine.open()) {
            var random = new Random(comparison.seed);
            for (Part part : parts.stream().distinct().toList()) {
                if (part == Part.MEMORY) {
                    measureNodes(server, line);
                } else {
                    measureTurns(part, server, random, line);
                }
            }
        }
    }

    /** Measures in new JVMs for each part. */
    private void measureTurns(Part part, String server, Random random, ProgressLine line) throws IOException {
        List<BusProcess> processes = new ArrayList<>();
        try {
            for (BusContender contender : part.contenders()) {
                processes.add(new BusProcess(contender, server));
            }
            for (BusWorkload workload : part.workloads()) { // all first: what is compiled for one affects another
                warmUp(workload, processes, line);
            }
            for (BusWorkload workload : part.workloads()) {
                results.turns().put(workload, compare(workload, processes, random, line));
            }
        } finally {
            processes.forEach(BusProcess::close);
        }
    }

    private void warmUp(BusWorkload workload, List<BusProcess> processes, ProgressLine line) throws IOException {
        Map<BusContender, Double> encoded = new EnumMap<>(BusContender.class);
        for (BusProcess process : processes) {
            line.show(workload.label() + ": warming up " + process.contender().label());
            encoded.put(process.contender(), process.encodedBytes(workload));
            process.turn(workload, comparison.warmUpMillis);
        }
        results.encodedBytes().put(workload, encoded);
    }

    private Map<BusContender, List<BusTurn>> compare(
            BusWorkload workload, List<BusProcess> processes, Random random, ProgressLine line) throws IOException {
        Map<BusContender, List<BusTurn>> turns = new EnumMap<>(BusContender.class);
        processes.forEach(process -> turns.put(process.contender(), new ArrayList<>()));
        for (int round = 1; round <= comparison.rounds; round++) {
            line.show(workload.label() + ": round " + round + " of " + comparison.rounds);
            var order = new ArrayList<>(processes);
            Collections.shuffle(order, random);
            for (BusProcess process : order) {
                turns.get(process.contender()).add(process.turn(workload, turnMillis));
            }
        }
        return turns;
    }

    private void measureNodes(String server, ProgressLine line) throws IOException {
        for (BusResults.Node node : BusResults.Node.values()) {
            line.show("memory of a node: " + node.label());
            try (var process = new BusProcess(BusContender.TROUPE, server)) {
                results.nodes().put(node, process.costOf(node));
            }
        }
    }
}
