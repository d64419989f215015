package io.troupe.demo.verify;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.RobotTeams;
import io.troupe.petri.SearchLimits;
import java.util.Locale;
import java.util.function.Consumer;

/**
 * The paper's nets (reading A) for several robots, with one player per robot, and their dead markings by stubborn sets.
 */
record TeamStudy(
        int robots, DeadlockSearch uncorrected, DeadlockSearch stoppingTogether, DeadlockSearch stoppingOneByOne) {
    private static final int MARKINGS_PER_REPORT = 10_000;

    static TeamStudy of(int robots, Consumer<String> progress) {
        return new TeamStudy(
                robots,
                search(RobotTeams.uncorrected(robots), progress),
                search(RobotTeams.stoppingTogether(robots), progress),
                search(RobotTeams.stoppingOneByOne(robots), progress));
    }

    private static DeadlockSearch search(PetriNet net, Consumer<String> progress) {
        progress.accept("net " + net.name());
        return DeadlockSearch.run(
                net,
                SearchLimits.markings(ReachabilityGraph.DEFAULT_MAX_MARKINGS)
                        .reporting(
                                MARKINGS_PER_REPORT,
                                at -> progress.accept(String.format(
                                        Locale.ROOT,
                                        "net %s: %,d markings, %,d dead",
                                        net.name(),
                                        at.markings(),
                                        at.dead()))));
    }

    /** Number of dead markings and of visited markings, as a table cell. */
    static String cell(DeadlockSearch search) {
        return String.format(
                Locale.ROOT,
                "%d dead%s (%,d visited)",
                search.deadlocks().size(),
                switch (search.end()) {
                    case COMPLETE -> "";
                    case LIMIT, MEMORY, CANCELLED -> " so far";
                },
                search.visitedMarkings());
    }
}
