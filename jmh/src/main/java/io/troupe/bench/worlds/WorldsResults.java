package io.troupe.bench.worlds;

import io.troupe.tools.SampleStatistics;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

/**
 * The results of a comparison.
 *
 * @param turns by number of robots and contender, one turn for each round; the round is the index
 * @param retainedBytes the bytes of the heap that one of our robots retains, by number of robots
 */
record WorldsResults(Map<Integer, Map<WorldKind, List<WorldTurn>>> turns, Map<Integer, Double> retainedBytes) {
    SampleStatistics factor(int robots, WorldKind kind) {
        return SampleStatistics.of(
                of(robots, kind).stream().map(WorldTurn::factor).toList());
    }

    SampleStatistics bytesPerStep(int robots, WorldKind kind) {
        return SampleStatistics.of(
                of(robots, kind).stream().map(WorldTurn::bytesPerStep).toList());
    }

    /** The contender's factor divided by ours in the same round. */
    SampleStatistics ratio(int robots, WorldKind kind) {
        var ours = of(robots, WorldKind.TROUPE);
        var its = of(robots, kind);
        return SampleStatistics.of(IntStream.range(0, its.size())
                .mapToObj(round -> its.get(round).factor() / ours.get(round).factor())
                .toList());
    }

    private List<WorldTurn> of(int robots, WorldKind kind) {
        var found = turns.getOrDefault(robots, Map.of()).get(kind);
        if (found == null) {
            throw new IllegalArgumentException("no turns of " + kind.label() + " with " + robots + " robots");
        }
        return found;
    }
}
