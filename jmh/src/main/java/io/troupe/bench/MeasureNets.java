package io.troupe.bench;

import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.common.measure.SampleStatistics;
import io.troupe.common.measure.UsedHeap;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.structure.Siphons;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import java.lang.ref.Reference;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.function.Supplier;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/**
 * Measures the searches over the paper's nets, and prints a table. Progress goes to stderr, one line for each finished
 * search.
 */
@Command(name = "MeasureNets", description = "Measures the searches over the paper's nets.", showDefaultValues = true)
public final class MeasureNets implements Callable<Integer> {
    private static final int WARM_UPS = 3;

    @Option(
            names = "--repetitions",
            paramLabel = "N",
            converter = AtLeastOne.class,
            description = "of each search, after " + WARM_UPS + " warm-ups")
    int repetitions = 7;

    public static void main(String... arguments) {
        System.exit(BenchmarkCommand.of(new MeasureNets()).execute(arguments));
    }

    @Override
    public Integer call() {
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
        return 0;
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
        long before = UsedHeap.bytes();
        var found = task.work().get();
        long kept = UsedHeap.bytes() - before;
        // keeps the result alive until the heap is measured
        Reference.reachabilityFence(found.kept());
        var spread = SampleStatistics.of(millis);
        return String.format(
                Locale.ROOT,
                "| %s | %,d %s; %s | %.1f (%.1f..%.1f) | %,.0f | %d |",
                task.name(),
                found.items(),
                found.unit(),
                found.text(),
                spread.median(),
                spread.lowerQuartile(),
                spread.upperQuartile(),
                found.items() / (spread.median() / 1000),
                mebibytes(kept));
    }

    private static long mebibytes(long bytes) {
        return Math.round(bytes / 1048576.0);
    }

    /**
     * One search over a net.
     *
     * @param name of the net and the search
     * @param work the search
     */
    record NetTask(String name, Supplier<Found> work) {
        /**
         * The result of a search.
         *
         * @param items the number of items that the time is divided by
         * @param unit what these are
         * @param text the result in words
         * @param kept the result itself, to measure the heap it takes
         */
        record Found(long items, String unit, String text, Object kept) {}

        private static final SearchLimits LIMITS = SearchLimits.markings(2_000_000);

        static List<NetTask> all() {
            return List.of(
                    new NetTask("6 robots, all dead markings", () -> dead(RobotTeams.uncorrected(6))),
                    new NetTask("6 robots stopping together, no dead one", () -> dead(RobotTeams.stoppingTogether(6))),
                    new NetTask("6 robots stopping together, all live", () -> live(RobotTeams.stoppingTogether(6))),
                    new NetTask("3 robots, full graph", () -> full(RobotTeams.uncorrected(3))),
                    new NetTask(
                            "paper's net, minimal siphons", () -> siphons(PaperNets.uncorrected(PaperNets.Reading.A))),
                    new NetTask(
                            "corrected net, minimal siphons", () -> siphons(PaperNets.corrected(PaperNets.Reading.A))),
                    new NetTask("6 robots, WiringCheck and its proposal", NetTask::check));
        }

        private static Found dead(PetriNet net) {
            var search = DeadlockSearch.run(net, LIMITS);
            return markings(search.visitedMarkings(), search.deadlocks().size() + " dead, " + search.end(), search);
        }

        private static Found live(PetriNet net) {
            var search = ProgressSearch.run(net, LIMITS);
            return markings(search.visitedMarkings(), search.losses().size() + " losses, " + search.end(), search);
        }

        private static Found full(PetriNet net) {
            var graph = ReachabilityGraph.explore(net, LIMITS);
            return markings(
                    graph.size(),
                    graph.edgeCount() + " edges, " + graph.dead().size() + " dead, " + graph.end(),
                    graph);
        }

        private static Found siphons(PetriNet net) {
            var found = Siphons.minimalSiphons(net);
            return new Found(
                    found.sets().size(), "siphons", found.isComplete() ? "all of them" : "stopped at the limit", found);
        }

        /** The markings are those of the whole and of the repaired wiring, by stubborn sets and in the full graph. */
        private static Found check() {
            var result = WiringCheck.check(PaperWiring.robots(6));
            var text =
                    result.getClass().getSimpleName() + ", " + result.reduced().deadMarkings() + " dead";
            var markings = visited(result);
            if (result instanceof WiringResult.Deadlock deadlock
                    && deadlock.repair().isPresent()) {
                var repaired = deadlock.repair().orElseThrow().result();
                text += "; proposal " + repaired.getClass().getSimpleName();
                markings += visited(repaired);
            }
            return markings(markings, text, result);
        }

        private static long visited(WiringResult result) {
            return (long) result.figures().markings() + result.reduced().markings();
        }

        private static Found markings(long count, String text, Object kept) {
            return new Found(count, "markings", text, kept);
        }
    }
}
