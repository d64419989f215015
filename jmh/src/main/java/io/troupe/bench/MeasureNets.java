package io.troupe.bench;

import java.lang.ref.Reference;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/**
 * Measures the searches over the paper's nets, and prints a table. Progress goes to stderr, one line for each finished
 * search.
 */
public final class MeasureNets {
    private static final int DEFAULT_REPETITIONS = 7;
    private static final int WARM_UPS = 3;

    private MeasureNets() {}

    public static void main(String... args) {
        int repetitions;
        try {
            repetitions = repetitions(args);
        } catch (IllegalArgumentException e) {
            System.err.println(e.getMessage());
            System.exit(2);
            return;
        }
        System.out.printf(
                Locale.ROOT,
                "Java %s, %d processors, at most %d MiB of heap, %d warm-ups, %d repetitions%n%n",
                Runtime.version(),
                Runtime.getRuntime().availableProcessors(),
                mebibytes(Runtime.getRuntime().maxMemory()),
                WARM_UPS,
                repetitions);
        System.out.println("| search | found | ms, median (quartiles) | per second | MiB kept by the result |");
        System.out.println("|---|---|---|---|---|");
        for (NetTask task : NetTask.all()) {
            System.out.println(measure(task, repetitions));
        }
    }

    static int repetitions(String... args) {
        if (args.length == 0) {
            return DEFAULT_REPETITIONS;
        }
        if (args.length != 2 || !args[0].equals("--repetitions")) {
            throw new IllegalArgumentException(
                    "arguments are " + List.of(args) + ", expected none or --repetitions and a number");
        }
        int number;
        try {
            number = Integer.parseInt(args[1]);
        } catch (NumberFormatException e) {
            throw new IllegalArgumentException("--repetitions is " + args[1] + ", expected a number", e);
        }
        if (number < 1) {
            throw new IllegalArgumentException("--repetitions is " + number + ", expected 1 or more");
        }
        return number;
    }

    /** A row of the table. */
    static String measure(NetTask task, int repetitions) {
        List<Double> millis = new ArrayList<>();
        for (int i = -WARM_UPS; i < repetitions; i++) {
            long start = System.nanoTime();
            var found = task.work().get();
            double spent = (System.nanoTime() - start) / 1e6;
            Reference.reachabilityFence(found);
            if (i >= 0) {
                millis.add(spent);
            }
            System.err.printf(
                    Locale.ROOT, "%s: %s %.1f ms%n", task.name(), i < 0 ? "warm-up" : "run " + (i + 1), spent);
        }
        long before = usedBytes();
        var found = task.work().get();
        long kept = usedBytes() - before;
        // keeps the result alive until the heap is measured
        Reference.reachabilityFence(found.kept());
        var spread = Quartiles.of(millis);
        return String.format(
                Locale.ROOT,
                "| %s | %,d %s; %s | %.1f (%.1f..%.1f) | %,.0f | %d |",
                task.name(),
                found.items(),
                found.unit(),
                found.text(),
                spread.median(),
                spread.lower(),
                spread.upper(),
                found.items() / (spread.median() / 1000),
                mebibytes(kept));
    }

    private static long usedBytes() {
        for (int i = 0; i < 4; i++) {
            System.gc();
        }
        return Runtime.getRuntime().totalMemory() - Runtime.getRuntime().freeMemory();
    }

    private static long mebibytes(long bytes) {
        return Math.round(bytes / 1048576.0);
    }
}
