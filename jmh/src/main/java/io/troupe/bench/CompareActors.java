package io.troupe.bench;

import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.nio.file.Files;
import java.util.ArrayList;
import java.util.Collections;
import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.concurrent.Callable;
import java.util.stream.Stream;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

/**
 * Compares Troupe with other actor libraries, and all of them with the limit.
 *
 * <p><b>Role.</b> Every contender runs in a separate JVM, so that its classes do not affect the compiled code of
 * another. The contenders take turns of about 30 ms in random order while the others wait, so that all of them run
 * under the same conditions. The result is the ratio to the limit in the same round.
 *
 * <p><b>Errors.</b> A contender that fails or hangs is reported and left out.
 */
@Command(
        name = "CompareActors",
        description = "Compares Troupe with other actor libraries, and all of them with the limit.",
        showDefaultValues = true)
public final class CompareActors implements Callable<Integer> {
    @Mixin
    final ComparisonOptions comparison = new ComparisonOptions(20, 2_000);

    @Option(
            names = "--only",
            paramLabel = "NAME",
            split = ",",
            converter = Contenders.Converter.class,
            description = "these contenders, and the limit")
    List<Contenders> only = List.of(Contenders.values());

    @Option(
            names = "--workloads",
            paramLabel = "NAME",
            split = ",",
            converter = Workload.Converter.class,
            description = "these workloads")
    List<Workload> workloads = List.of(Workload.values());

    private final Results results = new Results(new EnumMap<>(Workload.class), new LinkedHashMap<>());

    public static void main(String[] arguments) {
        System.exit(BenchmarkCommand.of(new CompareActors()).execute(arguments));
    }

    /** The contenders to compare, the limit first. */
    List<Contenders> contenders() {
        return Stream.concat(Stream.of(Contenders.LIMIT), only.stream())
                .distinct()
                .toList();
    }

    @Override
    public Integer call() throws IOException {
        try (var line = ProgressLine.open()) {
            compare(line);
        }
        System.out.print(new CompareReport(comparison.rounds, comparison.seed, results).table());
        if (comparison.figure != null) {
            Files.writeString(comparison.figure, CompareDrawing.of(results).svg());
        }
        return 0;
    }

    private void compare(ProgressLine line) throws IOException {
        var random = new Random(comparison.seed);
        List<ContenderProcess> processes = new ArrayList<>();
        try {
            for (Contenders contender : contenders()) {
                start(contender, line).ifPresent(processes::add);
            }
            for (Workload workload : workloads) {
                results.turns().put(workload, compare(workload, processes, random, line));
            }
            if (workloads.contains(Workload.CREATE)) {
                measureRetained(processes, line);
            }
        } finally {
            processes.forEach(ContenderProcess::close);
        }
    }

    private static Optional<ContenderProcess> start(Contenders contender, ProgressLine line) throws IOException {
        try {
            return Optional.of(new ContenderProcess(contender));
        } catch (IOException failure) {
            leftOut(contender, failure, line);
            return Optional.empty();
        }
    }

    private Map<String, List<TurnResult>> compare(
            Workload workload, List<ContenderProcess> processes, Random random, ProgressLine line) throws IOException {
        Map<String, List<TurnResult>> turns = new LinkedHashMap<>();
        Map<ContenderProcess, Integer> operations = new LinkedHashMap<>();
        for (ContenderProcess process : List.copyOf(processes)) {
            line.show(workload.label() + ": warming up " + process.name());
            turns.put(process.name(), new ArrayList<>());
            attempt(
                    process,
                    processes,
                    line,
                    () -> operations.put(process, process.warm(workload, comparison.warmUpMillis)));
        }
        for (int round = 1; round <= comparison.rounds; round++) {
            line.show(workload.label() + ": round " + round + " of " + comparison.rounds);
            var order = new ArrayList<>(processes);
            Collections.shuffle(order, random);
            for (ContenderProcess process : order) {
                attempt(
                        process,
                        processes,
                        line,
                        () -> turns.get(process.name()).add(process.turn(workload, operations.get(process))));
            }
        }
        turns.values().removeIf(each -> each.size() < comparison.rounds);
        return turns;
    }

    /** Measures the retained bytes. Runs after all the turns, because it collects garbage many times. */
    private void measureRetained(List<ContenderProcess> processes, ProgressLine line) throws IOException {
        for (ContenderProcess process : List.copyOf(processes)) {
            line.show("retained bytes: " + process.name());
            attempt(
                    process,
                    processes,
                    line,
                    () -> results.retainedBytes().put(process.name(), process.retainedBytes()));
        }
    }

    private interface Attempt {
        void run() throws IOException;
    }

    /** Drops a contender that fails; without the limit there is no comparison. */
    private static void attempt(
            ContenderProcess process, List<ContenderProcess> processes, ProgressLine line, Attempt attempt)
            throws IOException {
        try {
            attempt.run();
        } catch (IOException failure) {
            leftOut(process.contender(), failure, line);
            processes.remove(process);
            process.close();
        }
    }

    private static void leftOut(Contenders contender, IOException failure, ProgressLine line) throws IOException {
        if (contender == Contenders.LIMIT) {
            throw failure;
        }
        line.interrupt(() -> System.err.println("left out: " + failure.getMessage()));
    }
}
