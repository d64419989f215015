package io.troupe.bench;

import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static java.util.Objects.requireNonNull;

import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.petri.Answer;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.PaperNets;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Symmetry;
import io.troupe.petri.deadlock.DeadlockCheck;
import io.troupe.petri.structure.Siphons;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.tools.SampleStatistics;
import io.troupe.tools.UsedHeap;
import java.lang.ref.Reference;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/**
 * Measures the searches over the paper's nets and dining philosophers, and prints a table. Progress goes to stderr, one
 * line for each finished search.
 */
@Command(
        name = "MeasureNets",
        description = "Measures the searches over the paper's nets and dining philosophers.",
        showDefaultValues = true)
public final class MeasureNets implements Callable<Integer> {
    private static final int WARM_UPS = 3;

    @Option(
            names = "--repetitions",
            paramLabel = "N",
            converter = AtLeastOne.class,
            description = "of each search, after " + WARM_UPS + " warm-ups")
    int repetitions = 7;

    @Option(
            names = "--large",
            description = "measures only the full graph of 14 million markings and 167 million edges, once")
    boolean large;

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
        System.out.println("| search | found | ms, median (quartiles) | per second | MiB kept by the result "
                + "| bytes for each marking beside itself |");
        System.out.println("|---|---|---|---|---|---|");
        if (large) {
            System.out.println(measure(NetTask.large(), 0, 1));
            return 0;
        }
        for (NetTask task : NetTask.all()) {
            System.out.println(measure(task, WARM_UPS, repetitions));
        }
        return 0;
    }

    /** A row of the table. */
    static String measure(NetTask task, int warmUps, int repetitions) {
        List<Double> millis = new ArrayList<>();
        NetTask.@Nullable Found found = null;
        var before = 0L;
        for (int i = -warmUps; i < repetitions; i++) {
            found = null; // the garbage of the next measurement
            before = UsedHeap.bytes();
            long start = System.nanoTime();
            found = task.work().get();
            double spent = (System.nanoTime() - start) / 1e6;
            Reference.reachabilityFence(found);
            if (i >= 0) {
                millis.add(spent);
            }
            System.err.printf(
                    Locale.ROOT, "%s: %s %.1f ms%n", task.name(), i < 0 ? "warm-up" : "run " + (i + 1), spent);
        }
        long kept = UsedHeap.bytes() - before;
        requireNonNull(found, "at least one repetition");
        // keeps the result alive until the heap is measured
        Reference.reachabilityFence(found.kept());
        var spread = SampleStatistics.of(millis);
        return String.format(
                Locale.ROOT,
                "| %s | %,d %s; %s | %.1f (%.1f..%.1f) | %,.0f | %d | %s |",
                task.name(),
                found.items(),
                found.unit(),
                found.text(),
                spread.median(),
                spread.lowerQuartile(),
                spread.upperQuartile(),
                found.items() / (spread.median() / 1000),
                mebibytes(kept),
                found.bytesPerMarking() == 0
                        ? ""
                        : "%.1f".formatted((double) kept / found.items() - found.bytesPerMarking()));
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
         * @param bytesPerMarking what a marking itself takes of this; 0 unless it is a large search without edges
         */
        record Found(long items, String unit, String text, Object kept, int bytesPerMarking) {
            Found(long items, String unit, String text, Object kept) {
                this(items, unit, text, kept, 0);
            }
        }

        private static final SearchLimits LIMITS = SearchLimits.markings(2_000_000);
        /** From so many markings on the bytes for each can be measured. */
        private static final int MANY = 50_000;

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
                    new NetTask("6 robots, WiringCheck and its proposal", () -> check(PaperWiring.robots(6))),
                    new NetTask("12 robots stopping together, decision", () -> decide(RobotTeams.stoppingTogether(12))),
                    new NetTask(
                            "12 robots stopping one by one, decision", () -> decide(RobotTeams.stoppingOneByOne(12))),
                    new NetTask(
                            "12 robots with a service each, decision",
                            () -> decide(households(12).net())),
                    new NetTask("50 philosophers, decision", () -> decide(philosophers(50))),
                    new NetTask("1,000 philosophers, decision", () -> decide(philosophers(1_000))),
                    new NetTask(
                            "50 philosophers as a wiring, decision",
                            () -> decide(table(50, false).net())),
                    new NetTask(
                            "50 as a wiring, one left-handed, decision",
                            () -> decide(table(50, true).net())),
                    new NetTask(
                            "3 robots, all markings without edges",
                            () -> withoutEdges(RobotTeams.uncorrected(3), false)),
                    new NetTask(
                            "3 robots, orbits of all markings", () -> withoutEdges(RobotTeams.uncorrected(3), true)),
                    new NetTask("10 workers, by stubborn sets alone", () -> dead(workers(10))),
                    new NetTask("10 workers, by orbits", () -> deadByOrbits(workers(10))),
                    new NetTask("20 workers, by orbits", () -> deadByOrbits(workers(20))),
                    new NetTask("50 workers, by orbits", () -> deadByOrbits(workers(50))),
                    new NetTask("50 workers, decision", () -> decide(workers(50))),
                    new NetTask("20 workers, WiringCheck", () -> check(workerWiring(20))),
                    new NetTask("6 robots of the paper, by orbits", () -> deadByOrbits(RobotTeams.uncorrected(6))));
        }

        static NetTask large() {
            return new NetTask(
                    "15 philosophers, either fork first, markings without edges",
                    () -> withoutEdges(eitherForkFirst(15), false));
        }

        /** Each of n workers takes two of n + 1 tools, one after the other; one of them can always take its second. */
        private static Wiring workerWiring(int count) {
            var worker = Protocol.of("worker")
                    .state("idle", acquires("tool").then("one"))
                    .state("one", acquires("tool").then("both"))
                    .state("both", releases("tool").then("back"))
                    .state("back", releases("tool").then("idle"))
                    .build();
            return Wiring.of(count + " workers")
                    .components("worker", count, worker)
                    .resource("tool", count + 1)
                    .build();
        }

        private static PetriNet workers(int count) {
            return workerWiring(count).net();
        }

        private static Found withoutEdges(PetriNet net, boolean byOrbits) {
            var symmetry = byOrbits ? Symmetry.find(net) : Symmetry.none(net);
            var graph = ReachabilityGraph.exploreMarkings(net, symmetry, SearchLimits.markings(Integer.MAX_VALUE));
            return new Found(
                    graph.size(),
                    byOrbits ? "orbits of " + symmetry : "markings",
                    graph.edgeCount() + " edges, " + graph.dead().size() + " dead, " + graph.end(),
                    graph,
                    graph.size() > MANY ? graph.bytesPerMarking() : 0);
        }

        private static Found deadByOrbits(PetriNet net) {
            var symmetry = Symmetry.find(net);
            var search = DeadlockSearch.run(net, symmetry, LIMITS);
            return new Found(
                    search.visitedMarkings(),
                    "orbits of " + symmetry,
                    search.deadlocks().size() + " dead, " + search.end(),
                    search);
        }

        /** Each takes the left fork, then the right one, and puts both down. */
        private static PetriNet philosophers(int count) {
            var net = PetriNet.builder(count + " philosophers");
            for (var i = 0; i < count; i++) {
                net.place("thinks" + i, 1).place("holds" + i).place("eats" + i).place("fork" + i, 1);
            }
            for (var i = 0; i < count; i++) {
                var left = "fork" + i;
                var right = "fork" + (i + 1) % count;
                net.transition("takeLeft" + i, List.of("thinks" + i, left), List.of("holds" + i));
                net.transition("takeRight" + i, List.of("holds" + i, right), List.of("eats" + i));
                net.transition("put" + i, List.of("eats" + i), List.of("thinks" + i, left, right));
            }
            return net.build();
        }

        /** Each takes either fork, then the other one: 3^n markings, two of them dead. */
        private static PetriNet eitherForkFirst(int count) {
            var net = PetriNet.builder(count + " philosophers, either fork first");
            for (var i = 0; i < count; i++) {
                net.place("thinks" + i, 1).place("left" + i).place("right" + i);
                net.place("eats" + i).place("fork" + i, 1);
            }
            for (var i = 0; i < count; i++) {
                var left = "fork" + i;
                var right = "fork" + (i + 1) % count;
                net.transition("takeLeft" + i, List.of("thinks" + i, left), List.of("left" + i));
                net.transition("takeRight" + i, List.of("thinks" + i, right), List.of("right" + i));
                net.transition("thenRight" + i, List.of("left" + i, right), List.of("eats" + i));
                net.transition("thenLeft" + i, List.of("right" + i, left), List.of("eats" + i));
                net.transition("put" + i, List.of("eats" + i), List.of("thinks" + i, left, right));
            }
            return net.build();
        }

        /** The forks are components too; with {@code leftHanded} the last philosopher takes them in the other order. */
        private static Wiring table(int count, boolean leftHanded) {
            var fork = Protocol.of("fork")
                    .state("free", provides("take").then("taken"))
                    .state("taken", provides("put").then("free"))
                    .build();
            var philosopher = Protocol.of("philosopher")
                    .state("thinking", requests("first.take").then("holding"))
                    .state("holding", requests("second.take").then("eating"))
                    .state("eating", requests("first.put").then("leaving"))
                    .state("leaving", requests("second.put").then("thinking"))
                    .build();
            var table = Wiring.of("table")
                    .components("philosopher", count, philosopher)
                    .components("fork", count, fork);
            for (var i = 1; i <= count; i++) {
                var isOther = leftHanded && i == count;
                table.bind("philosopher" + i, isOther ? "second" : "first", "fork" + i);
                table.bind("philosopher" + i, isOther ? "first" : "second", "fork" + (i % count + 1));
            }
            return table.build();
        }

        /** Each robot has a separate player, middleware and service, and stops together with these. */
        private static Wiring households(int robots) {
            return Wiring.of(robots + " robots with a service each")
                    .components("robot", robots, PaperWiring.robot())
                    .components("player", robots, PaperWiring.player())
                    .components("middleware", robots, PaperWiring.middleware())
                    .components("service", robots, PaperWiring.service())
                    .bindEach("robot", "player", i -> "player" + i)
                    .bindEach("player", "middleware", i -> "middleware" + i)
                    .bindEach("middleware", "service", i -> "service" + i)
                    .bindEach("service", "middleware", i -> "middleware" + i)
                    .build()
                    .withSynchronisedStops(IntStream.rangeClosed(1, robots)
                            .mapToObj(i -> Set.of("robot" + i, "player" + i, "middleware" + i, "service" + i))
                            .toList());
        }

        private static Found decide(PetriNet net) {
            var result = DeadlockCheck.decide(net, LIMITS);
            return switch (result) {
                case Answer.No<Deadlock>(var dead) -> new Found(dead.trace().size(), "firings", "can deadlock", result);
                case Answer.Yes<Deadlock>(var proof, var markings) -> markings(markings, "Proved", result);
                case Answer.Unknown<Deadlock>(var end, var markings) -> markings(markings, "Unknown", result);
            };
        }

        private static Found dead(PetriNet net) {
            var search = DeadlockSearch.run(net, LIMITS);
            return new Found(
                    search.visitedMarkings(),
                    "markings",
                    search.deadlocks().size() + " dead, " + search.end(),
                    search,
                    search.visitedMarkings() > MANY ? search.bytesPerMarking() : 0);
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
        private static Found check(Wiring wiring) {
            var result = WiringCheck.check(wiring);
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
