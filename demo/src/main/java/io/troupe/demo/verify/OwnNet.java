package io.troupe.demo.verify;

import io.troupe.petri.Liveness;
import io.troupe.petri.PetriNet;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.structure.DeadlockVerdict;
import io.troupe.petri.structure.SiphonAnalysis;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;

/** A net of the user's: what is known of it, in words. */
record OwnNet(PetriNet net, ReachabilityGraph graph, SiphonAnalysis siphons) {
    private static final int MARKINGS_PER_REPORT = 10_000;

    static OwnNet of(PetriNet net, Consumer<String> progress) {
        var limits = SearchLimits.markings(ReachabilityGraph.DEFAULT_MAX_MARKINGS)
                .reporting(
                        MARKINGS_PER_REPORT,
                        at -> progress.accept("net " + net.name() + ": " + at.markings() + " markings"));
        var graph = ReachabilityGraph.explore(net, limits);
        progress.accept("net " + net.name() + ": siphons");
        return new OwnNet(net, graph, SiphonAnalysis.of(net));
    }

    String summary() {
        var sets = siphons.siphons();
        return graph.summary() + "\n" + Liveness.of(graph).summary() + "\n"
                + sets.sets().size()
                + (sets.isComplete()
                        ? " minimal siphons: "
                        : " minimal siphons found until the search stopped at its limit: ")
                + words(siphons.deadlock()) + "\n";
    }

    private static String words(DeadlockVerdict verdict) {
        return switch (verdict) {
            case DeadlockVerdict.NoDeadMarking proof ->
                "they prove without a search that no reachable marking is dead"
                        + (proof.isByTrapsAlone() ? " (each contains a marked trap)" : "");
            case DeadlockVerdict.Candidates candidates ->
                candidates.siphons().size() + " of them may perhaps be emptied, which decides nothing by itself";
            case DeadlockVerdict.Undecided undecided -> undecided.reason();
        };
    }

    /** Drawings: the net, its nearest deadlock, and its graph if that is small enough to be drawn. Answers their names. */
    List<String> write(NetFiles files, String name) throws IOException {
        var written = new ArrayList<>(List.of(name));
        files.draw(name, net);
        if (!graph.dead().isEmpty()) {
            files.writeDeadlock(name + "-deadlock", graph);
            written.add(name + "-deadlock");
        }
        if (graph.isComplete() && NetFiles.canDraw(graph)) {
            files.write(name + "-graph", graph);
            written.add(name + "-graph");
        }
        return written;
    }
}
