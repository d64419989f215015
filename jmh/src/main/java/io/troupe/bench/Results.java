package io.troupe.bench;

import io.troupe.tools.SampleStatistics;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The results of a comparison.
 *
 * @param turns by workload and contender, one turn for each round
 * @param retainedBytes the bytes of the heap that an actor retains, by contender; empty if no workload creates actors
 */
record Results(Map<Workload, Map<String, List<TurnResult>>> turns, Map<String, Double> retainedBytes) {
    SampleStatistics nanos(Workload workload, String contender) {
        return SampleStatistics.of(
                of(workload, contender).stream().map(TurnResult::nanos).toList());
    }

    SampleStatistics bytes(Workload workload, String contender) {
        return SampleStatistics.of(
                of(workload, contender).stream().map(TurnResult::bytes).toList());
    }

    /** The contender's time as a multiple of the limit's in the same round. */
    SampleStatistics ratio(Workload workload, String contender) {
        var limit = of(workload, Contenders.LIMIT.label());
        var mine = of(workload, contender);
        return SampleStatistics.of(IntStream.range(0, mine.size())
                .mapToObj(round -> mine.get(round).nanos() / limit.get(round).nanos())
                .toList());
    }

    /** The bytes that an actor retains, for a workload that creates actors. */
    @Nullable
    Double retained(Workload workload, String contender) {
        return workload == Workload.CREATE ? retainedBytes.get(contender) : null;
    }

    private List<TurnResult> of(Workload workload, String contender) {
        var turns = turns().get(workload);
        var found = turns == null ? null : turns.get(contender);
        if (found == null) {
            throw new IllegalArgumentException("no turns of " + contender + " in " + workload.label());
        }
        return found;
    }
}
