package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** Which jobs are done in which order. */
final class Plan {
    private static final double CYCLE_SECONDS = 0.1;
    /** In a round that warms up: enough for the compilers, however few are measured. */
    private static final int WARM_UP_LOOPS = 1000;

    private final EvaluationSettings settings;

    Plan(EvaluationSettings settings) {
        this.settings = settings;
    }

    /** What warms up a JVM: everything once. */
    List<Job> warmUp(int round) {
        return repetition(round).stream()
                .map(job -> new Job(
                        job.part(),
                        job.mode(),
                        job.subject(),
                        Math.max(WARM_UP_LOOPS, job.loops()),
                        settings.seconds(),
                        job.seed(),
                        0))
                .toList();
    }

    /** The jobs of a repetition: each mode once with each thing, beginning with another one each time. */
    List<Job> repetition(int number) {
        var jobs = new ArrayList<Job>();
        for (Mode mode : settings.modes()) {
            jobs.add(job(Part.LOOPS, mode, Measurement.BOTH, number));
            jobs.add(job(Part.SWITCHES, mode, Measurement.BOTH, number));
            if (settings.reconnect() && mode != Mode.SYNC) { // in the paper the synchronous program connects once
                jobs.add(job(Part.RECONNECTS, mode, Measurement.BOTH, number));
            }
        }
        for (Service service : List.of(Service.WALL_FOLLOWER, Service.SPACE_WANDERER)) {
            jobs.add(job(Part.ALONE, modeAlone(settings.modes()), service.name(), number));
        }
        Collections.rotate(jobs, number);
        return jobs;
    }

    /** The mode in which a service runs by itself: an asynchronous one if there is one. */
    static Mode modeAlone(List<Mode> modes) {
        return modes.contains(Mode.PROMISE) ? Mode.PROMISE : modes.getLast();
    }

    private Job job(Part part, Mode mode, String subject, int number) {
        return new Job(part, mode, subject, settings.loops(), settings.seconds(), number, 0);
    }

    /** How long a job takes on the robots' clock, about. */
    static double expectedSeconds(Job job) {
        if (!job.countsLoops()) {
            return job.seconds();
        }
        boolean oneAfterTheOther = job.mode() == Mode.SYNC && job.part() == Part.LOOPS;
        return job.loops() * CYCLE_SECONDS * (oneAfterTheOther ? 2 : 1);
    }
}
