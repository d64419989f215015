package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** The jobs of an evaluation and their order. */
final class Plan {
    private static final double CYCLE_SECONDS = 0.1;
    /** Loops of a warm-up round: enough for the compilers, even if fewer are measured. */
    private static final int WARM_UP_LOOPS = 1000;

    private final EvaluationSettings settings;

    Plan(EvaluationSettings settings) {
        this.settings = settings;
    }

    /** The jobs of a warm-up round: each one once. */
    List<Job> warmUp(int round) {
        return repetition(round).stream()
                .map(job -> new Job(
                        job.kind(),
                        job.mode(),
                        job.subject(),
                        Math.max(WARM_UP_LOOPS, job.loops()),
                        settings.seconds(),
                        job.seed(),
                        0))
                .toList();
    }

    /** The jobs of a repetition: each kind in each mode once. The order rotates between repetitions. */
    List<Job> repetition(int number) {
        var jobs = new ArrayList<Job>();
        for (Mode mode : settings.modes()) {
            jobs.add(job(MeasurementKind.LOOPS, mode, Measurement.BOTH, number));
            jobs.add(job(MeasurementKind.SWITCHES, mode, Measurement.BOTH, number));
            if (settings.reconnect() && mode != Mode.SYNC) { // in the paper the synchronous program connects only once
                jobs.add(job(MeasurementKind.RECONNECTS, mode, Measurement.BOTH, number));
            }
        }
        for (Service service : List.of(Service.WALL_FOLLOWER, Service.SPACE_WANDERER)) {
            jobs.add(job(MeasurementKind.ALONE, modeAlone(settings.modes()), service.name(), number));
        }
        Collections.rotate(jobs, number);
        return jobs;
    }

    /** The mode for services that run alone: promise mode if it is measured. */
    static Mode modeAlone(List<Mode> modes) {
        return modes.contains(Mode.PROMISE) ? Mode.PROMISE : modes.getLast();
    }

    private Job job(MeasurementKind kind, Mode mode, String subject, int number) {
        return new Job(kind, mode, subject, settings.loops(), settings.seconds(), number, 0);
    }

    /** Approximate duration of a job in robot time. */
    static double expectedSeconds(Job job) {
        if (!job.countsLoops()) {
            return job.seconds();
        }
        boolean oneAfterTheOther = job.mode() == Mode.SYNC && job.kind() == MeasurementKind.LOOPS;
        return job.loops() * CYCLE_SECONDS * (oneAfterTheOther ? 2 : 1);
    }
}
