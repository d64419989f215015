package io.troupe.bench;

import io.troupe.bench.MeasureNets.NetTask;
import io.troupe.tools.UsedHeap;
import java.lang.ref.Reference;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;

/**
 * The searches of {@link MeasureNets}. Their answers are compared, the number of markings on the way to these is not.
 */
public final class NetTable implements BuildTable {
    /** One of each kind of search, of a few milliseconds. */
    static final Set<String> QUICK = Set.of(
            "6 robots, all dead markings",
            "corrected net, minimal siphons",
            "12 robots stopping together, decision",
            "50 philosophers, decision",
            "20 workers, by orbits");

    /** They take more than a second, each time. */
    static final Set<String> LONG = Set.of(
            "3 robots, full graph",
            "3 robots, all markings without edges",
            "3 robots, orbits of all markings",
            "6 robots, WiringCheck and its proposal",
            "20 workers, WiringCheck");

    @Override
    public List<Row> rows() {
        return NetTask.all().stream()
                .map(task -> new Row(task.name(), choice(task.name()), "result"))
                .toList();
    }

    private static Choice choice(String name) {
        return QUICK.contains(name) ? Choice.QUICK : LONG.contains(name) ? Choice.NAMED : Choice.USUAL;
    }

    @Override
    public Turn turn(String row, int operations) {
        NetTask task = named(row);
        System.gc(); // what other searches left
        var answers = new ArrayList<String>();
        Turn turn = TurnMeter.measure(operations, () -> {
            for (int i = 0; i < operations; i++) {
                answers.add(task.work().get().text());
            }
        });
        return turn.withAnswer(answers.getLast());
    }

    @Override
    public double keptBytes(String row) {
        NetTask task = named(row);
        long before = UsedHeap.bytes();
        var found = task.work().get();
        long after = UsedHeap.bytes();
        Reference.reachabilityFence(found.kept());
        return after - before;
    }

    private static NetTask named(String name) {
        return NetTask.all().stream()
                .filter(task -> task.name().equals(name))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException("no search is called " + name));
    }
}
