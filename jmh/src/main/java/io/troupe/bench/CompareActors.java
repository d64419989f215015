package io.troupe.bench;

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

/**
 * Compares Troupe with other actor libraries, and all of them with the limit.
 *
 * <p><b>Role.</b> Every contender runs in a separate JVM, so that its classes do not affect the compiled code of
 * another. The contenders take turns of about 30 ms in random order while the others wait, so that all of them run
 * under the same conditions. The result is the ratio to the limit in the same round.
 *
 * <p><b>Errors.</b> A contender that fails or hangs is reported and left out.
 */
public final class CompareActors {
    private final CompareOptions options;
    private final Random random;
    private final Results results = new Results(new EnumMap<>(Workload.class), new LinkedHashMap<>());

    private CompareActors(CompareOptions options) {
        this.options = options;
        random = new Random(options.seed());
    }

    public static void main(String[] args) throws IOException {
        CompareOptions options;
        try {
            options = CompareOptions.parse(args);
        } catch (IllegalArgumentException wrong) {
            System.err.println(wrong.getMessage());
            System.err.print(CompareOptions.USAGE);
            System.exit(2);
            return;
        }
        new CompareActors(options).run();
    }

    private void run() throws IOException {
        List<ContenderPipe> pipes = new ArrayList<>();
        try {
            for (String name : options.contenders()) {
                start(name).ifPresent(pipes::add);
            }
            for (Workload workload : options.workloads()) {
                results.turns().put(workload, compare(workload, pipes));
            }
            if (options.workloads().contains(Workload.CREATE)) {
                measureRetained(pipes);
            }
        } finally {
            for (ContenderPipe pipe : pipes) {
                pipe.close();
            }
        }
        System.out.print(new CompareReport(options, results).table());
        var figure = options.figure();
        if (figure != null) {
            Files.writeString(figure, CompareDrawing.of(results).svg());
        }
    }

    private static Optional<ContenderPipe> start(String name) throws IOException {
        try {
            return Optional.of(new ContenderPipe(name));
        } catch (IOException failure) {
            leftOut(name, failure);
            return Optional.empty();
        }
    }

    private Map<String, List<TurnResult>> compare(Workload workload, List<ContenderPipe> pipes) throws IOException {
        Map<String, List<TurnResult>> turns = new LinkedHashMap<>();
        Map<ContenderPipe, Integer> operations = new LinkedHashMap<>();
        for (ContenderPipe pipe : List.copyOf(pipes)) {
            progress(workload.label() + ": warming up " + pipe.name());
            turns.put(pipe.name(), new ArrayList<>());
            attempt(pipe, pipes, () -> operations.put(pipe, pipe.warm(workload, options.warmUpMillis())));
        }
        for (int round = 1; round <= options.rounds(); round++) {
            progress(workload.label() + ": round " + round + " of " + options.rounds());
            var order = new ArrayList<>(pipes);
            Collections.shuffle(order, random);
            for (ContenderPipe pipe : order) {
                attempt(pipe, pipes, () -> turns.get(pipe.name()).add(pipe.turn(workload, operations.get(pipe))));
            }
        }
        progress("");
        turns.values().removeIf(each -> each.size() < options.rounds());
        return turns;
    }

    /** Measures the retained bytes. Runs after all the turns, because it collects garbage many times. */
    private void measureRetained(List<ContenderPipe> pipes) throws IOException {
        for (ContenderPipe pipe : List.copyOf(pipes)) {
            progress("retained bytes: " + pipe.name());
            attempt(pipe, pipes, () -> results.retainedBytes().put(pipe.name(), pipe.retainedBytes()));
        }
        progress("");
    }

    private interface Attempt {
        void run() throws IOException;
    }

    /** Drops a contender that fails; without the limit there is no comparison. */
    private static void attempt(ContenderPipe pipe, List<ContenderPipe> pipes, Attempt attempt) throws IOException {
        try {
            attempt.run();
        } catch (IOException failure) {
            leftOut(pipe.name(), failure);
            pipes.remove(pipe);
            pipe.close();
        }
    }

    private static void leftOut(String name, IOException failure) throws IOException {
        if (name.equals(Contenders.LIMIT.label())) {
            throw failure;
        }
        System.err.println("\nleft out: " + failure.getMessage());
    }

    private static void progress(String text) {
        System.err.printf("\r%-60s", text);
        if (text.isEmpty()) {
            System.err.print("\r");
        }
    }
}
