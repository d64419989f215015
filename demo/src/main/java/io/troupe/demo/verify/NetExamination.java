package io.troupe.demo.verify;

import io.troupe.petri.Answer;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.DeadlockSearch.Deadlock;
import io.troupe.petri.Liveness;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import io.troupe.petri.deadlock.DeadlockCheck;
import java.io.IOException;
import java.math.BigDecimal;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * Examines a net from a file, within limits of time and memory. The deadlock verdict comes first, in half of the time:
 * by stubborn sets, and by {@link DeadlockCheck} if these are too many. Then the other results, and the pictures last.
 * Each result is reported as soon as it is known; a later failure does not invalidate it.
 */
final class NetExamination {
    /** Exit statuses by verdict. */
    static final int PROVED = 0;

    static final int CAN_DEADLOCK = 1;
    static final int UNKNOWN = 3;

    /** A search that finds all dead markings, nearest first, is tried with so many markings. */
    private static final int FEW_MARKINGS = 50_000;

    private static final int MARKINGS_PER_REPORT = 10_000;
    private static final int MAX_FIRINGS_PRINTED = 200;

    private final PetriNet net;
    private final Limits limits;
    private final Consumer<String> progress;
    private final Consumer<String> results;
    private DeadlockSearch.@Nullable Deadlock nearest;
    private boolean isDecided;
    private @Nullable ReachabilityGraph graph;

    /**
     * Limits of the searches.
     *
     * @param time total time
     * @param left supplies the remaining time
     * @param memoryBytes memory limit of the largest search
     */
    record Limits(Duration time, Supplier<Duration> left, long memoryBytes) {
        /** The same limits with less time. */
        private Limits sparing(Duration spared) {
            return new Limits(time, () -> left.get().minus(spared), memoryBytes);
        }

        private Limits withMemory(long bytes) {
            return new Limits(time, left, Math.max(1, bytes));
        }

        private SearchLimits search(int maxMarkings) {
            return SearchLimits.markings(maxMarkings)
                    .cancelledBy(() -> !left.get().isPositive())
                    .within(memoryBytes);
        }
    }

    /**
     * Creates an examination; results are whole lines.
     *
     * @param progress called with the current activity
     * @param results called with each result as soon as it is known
     */
    NetExamination(PetriNet net, Limits limits, Consumer<String> progress, Consumer<String> results) {
        this.net = net;
        this.limits = limits;
        this.progress = progress;
        this.results = results;
    }

    /**
     * Decides whether the net can deadlock, and reports the verdict.
     *
     * @return the exit status
     * @throws ArithmeticException if a place can hold more tokens than a long
     */
    int decide() {
        String why;
        try {
            var search = DeadlockSearch.run(net, deadlockLimits(FEW_MARKINGS));
            var dead = search.deadlocks();
            if (!dead.isEmpty()) {
                nearest = dead.getFirst();
                return canDeadlock(
                        dead.size() + " dead " + (dead.size() == 1 ? "marking" : "markings")
                                + (search.end() == SearchEnd.COMPLETE ? "" : " so far") + ", the nearest ",
                        nearest.marking().toString(),
                        nearest.trace());
            }
            if (search.end() == SearchEnd.COMPLETE) {
                return proved(search.visitedMarkings() + " markings by stubborn sets");
            }
            if (search.end() == SearchEnd.CANCELLED) {
                return notKnown(unknown(search.visitedMarkings(), search.end()));
            }
            switch (DeadlockCheck.decide(net, deadlockLimits(Integer.MAX_VALUE))) {
                case Answer.No<Deadlock>(var found) -> {
                    nearest = found;
                    return canDeadlock("", found.marking().toString(), found.trace());
                }
                case Answer.Yes<Deadlock>(var proof, var markings) -> {
                    return proved(proof + (markings == 0 ? "" : ", " + markings + " of them"));
                }
                case Answer.Unknown<Deadlock>(var end, var markings) -> why = unknown(markings, end);
            }
        } catch (OutOfMemoryError e) {
            why = "the virtual machine has too little memory for a search";
        }
        return notKnown(why);
    }

    private SearchLimits deadlockLimits(int maxMarkings) {
        return reporting(limits.sparing(limits.time().dividedBy(2)).search(maxMarkings), "dead markings");
    }

    private int canDeadlock(String which, String marking, List<Transition> trace) {
        isDecided = true;
        results.accept(net.name() + ": can deadlock: " + which + marking + " after " + shortened(trace) + "\n");
        return CAN_DEADLOCK;
    }

    private int proved(String how) {
        isDecided = true;
        results.accept(net.name() + ": proved: no reachable marking is dead (" + how + ")\n");
        return PROVED;
    }

    private String unknown(int markings, SearchEnd end) {
        return "no dead marking among " + markings + " by stubborn sets, " + ended(end);
    }

    private int notKnown(String why) {
        results.accept(net.name() + ": not known whether it can deadlock: " + why + "\n");
        return UNKNOWN;
    }

    private String ended(SearchEnd end) {
        return switch (end) {
            case COMPLETE -> "all of them";
            case LIMIT -> "the most a search can number";
            case MEMORY -> "then the memory was used up (--memory)";
            case CANCELLED -> "then half of the " + seconds() + " s was over (--time)";
        };
    }

    private String seconds() {
        return BigDecimal.valueOf(limits.time().toNanos(), 9)
                .stripTrailingZeros()
                .toPlainString();
    }

    private static String shortened(List<?> items) {
        var printed = items.stream()
                .limit(MAX_FIRINGS_PRINTED)
                .map(String::valueOf)
                .collect(Collectors.joining(", ", "[", ""));
        return printed
                + (items.size() > MAX_FIRINGS_PRINTED
                        ? ", .. and " + (items.size() - MAX_FIRINGS_PRINTED) + " more]"
                        : "]");
    }

    /** Reports further results, of the full graph. */
    void explain() {
        try {
            graph = ReachabilityGraph.explore(
                    net,
                    reporting(
                            limits.withMemory(limits.memoryBytes() / 2)
                                    .sparing(limits.time().dividedBy(4))
                                    .search(ReachabilityGraph.DEFAULT_MAX_MARKINGS),
                            "all markings"));
            results.accept(withoutWhatIsDecided(graph.summary()) + "\n");
            var liveness = Liveness.of(graph).summary();
            results.accept(
                    nearest != null && liveness.startsWith(net.name() + ": live UNKNOWN, reversible UNKNOWN")
                            ? net.name() + ": live NO, reversible NO: nothing leads on from a dead marking\n"
                            : liveness + "\n");
        } catch (ArithmeticException e) {
            results.accept("the full graph is not known: " + e.getMessage() + "\n");
        } catch (OutOfMemoryError e) {
            results.accept("no more is known of the full graph: the virtual machine has too little memory\n");
        }
    }

    /** That an incomplete graph has no dead markings so far is less than the verdict. */
    private String withoutWhatIsDecided(String summary) {
        return isDecided
                ? summary.lines()
                        .filter(line -> !line.startsWith("  dead markings so far: 0;"))
                        .collect(Collectors.joining("\n"))
                : summary;
    }

    private SearchLimits reporting(SearchLimits search, String what) {
        return search.reporting(
                MARKINGS_PER_REPORT,
                at -> progress.accept("net " + net.name() + ": " + what + ", " + at.markings() + " visited"));
    }

    /** Draws the net, its nearest deadlock, and its graph if that is small enough, and reports the files. */
    void draw(NetFiles files, String name) throws IOException {
        progress.accept("net " + net.name() + ": pictures");
        var written = new ArrayList<String>();
        try {
            files.draw(name, net);
            written.add(files.path(name));
            if (nearest != null) {
                files.drawDeadlock(name + "-deadlock", net, nearest);
                written.add(files.path(name + "-deadlock"));
            }
            if (graph != null && graph.isComplete() && NetFiles.canDraw(graph)) {
                files.write(name + "-graph", graph);
                written.add(files.path(name + "-graph"));
            }
        } catch (StackOverflowError | OutOfMemoryError e) {
            results.accept("not all was drawn: the layout needs more memory than there is (" + e + ")\n");
        }
        if (!NetFiles.canDraw(net)) {
            results.accept("no .svg of the net, which has " + NetFiles.size(net) + "; .dot files have no limit\n");
        }
        results.accept(
                "wrote, as .dot" + (NetFiles.canDraw(net) ? " and .svg: " : ": ") + String.join(", ", written) + "\n");
    }
}
