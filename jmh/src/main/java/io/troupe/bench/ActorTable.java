package io.troupe.bench;

import io.troupe.bench.ContenderProcess.RetainedHeap;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** The ranked workloads of {@link CompareActors} on Troupe. Only the processor time includes clearing up. */
public final class ActorTable implements BuildTable {
    private @Nullable Subject subject;

    @Override
    public List<Row> rows() {
        return Stream.of(Workload.values())
                .filter(Workload::isRanked)
                .map(each -> new Row(each.label(), Choice.QUICK, each == Workload.CREATE ? "actor" : ""))
                .toList();
    }

    @Override
    public Turn turn(String row, int operations) throws Exception {
        var workload = Workload.named(row);
        int whole = workload.whole(operations);
        workload.run(subject(), Math.max(1, operations / 10)); // back to full speed before the clock starts
        var results = new ArrayList<TurnResult>();
        Turn turn = TurnMeter.measure(whole, () -> results.add(workload.run(subject(), whole)));
        TurnResult result = results.getFirst();
        return new Turn(result.nanos() * whole, turn.processorNanos(), result.bytes() * whole, whole, "");
    }

    @Override
    public double keptBytes(String row) throws Exception {
        return RetainedHeap.bytesPerActor(subject().contender());
    }

    private Subject subject() {
        if (subject == null) {
            subject = new Subject(new TroupeContender());
        }
        return subject;
    }
}
