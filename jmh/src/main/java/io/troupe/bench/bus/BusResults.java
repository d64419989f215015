package io.troupe.bench.bus;

import io.troupe.tools.SampleStatistics;
import java.util.List;
import java.util.Map;
import java.util.function.ToDoubleFunction;
import java.util.stream.IntStream;

/**
 * The results of a comparison.
 *
 * @param turns by workload and contender, one turn for each round; the round is the index
 * @param encodedBytes the bytes of a value or frame, by workload and contender
 * @param nodes what a node costs
 */
record BusResults(
        Map<BusWorkload, Map<BusContender, List<BusTurn>>> turns,
        Map<BusWorkload, Map<BusContender, Double>> encodedBytes,
        Map<Node, BusMemory.Cost> nodes) {
    /** A node whose memory is measured. */
    enum Node {
        ALONE("without connection"),
        CONNECTED("connected to a server"),
        SERVICES("connected, with a broker and an actor as a service");

        private final String label;

        Node(String label) {
            this.label = label;
        }

        String label() {
            return label;
        }
    }

    /** The workloads of a part that were measured. */
    List<BusWorkload> measured(BusWorkload.Part part) {
        return part.workloads().stream().filter(turns::containsKey).toList();
    }

    SampleStatistics of(BusWorkload workload, BusContender contender, ToDoubleFunction<BusTurn> figure) {
        return SampleStatistics.of(
                turnsOf(workload, contender).stream().mapToDouble(figure).toArray());
    }

    /** A figure of ours divided by that of the last contender in the same round. */
    SampleStatistics ratio(BusWorkload workload, BusContender contender, ToDoubleFunction<BusTurn> figure) {
        var ours = turnsOf(workload, contender);
        var others = turnsOf(workload, workload.part().contenders().getLast());
        return SampleStatistics.of(IntStream.range(0, ours.size())
                .mapToDouble(round -> figure.applyAsDouble(ours.get(round)) / figure.applyAsDouble(others.get(round)))
                .toArray());
    }

    double encoded(BusWorkload workload, BusContender contender) {
        Double bytes = encodedBytes.getOrDefault(workload, Map.of()).get(contender);
        if (bytes == null) {
            throw missing("number of bytes", workload, contender);
        }
        return bytes;
    }

    private List<BusTurn> turnsOf(BusWorkload workload, BusContender contender) {
        var found = turns.getOrDefault(workload, Map.of()).get(contender);
        if (found == null) {
            throw missing("turns", workload, contender);
        }
        return found;
    }

    private static IllegalArgumentException missing(String what, BusWorkload workload, BusContender contender) {
        return new IllegalArgumentException("no " + what + " of " + contender.label() + " with " + workload.label());
    }
}
