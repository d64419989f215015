package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** Which jobs are done in which order. */
final class Plan {
    /** So often everything is done before it is measured, so that the JVM has compiled it. */
    static final int WARM_UPS = 3;

    private static final double CYCLE_SECONDS = 0.1;

    private final EvaluationSettings settings;

    Plan(EvaluationSettings settings) {
        this.settings = settings;
    }

    /** The jobs of a repetition: each mode once with each thing, beginning with another one each time. */
    List<Job> repetition(int number, int server) {
        var jobs = new ArrayList<Job>();
        for (Mode mode : settings.modes()) {
            jobs.add(job(Part.LOOPS, mode, Measurement.BOTH, number, server));
            jobs.add(job(Part.SWITCHES, mode, Measurement.BOTH, number, server));
            if (settings.reconnect() && mode != Mode.SYNC) { // in the paper the synchronous program connects once
                jobs.add(job(Part.RECONNECTS, mode, Measurement.BOTH, number, server));
            }
        }
        for (Service service : List.of(Service.WALL_FOLLOWER, Service.SPACE_WANDERER)) {
            jobs.add(job(Part.ALONE, modeAlone(settings.modes()), service.name(), number, server));
        }
        Collections.rotate(jobs, number);
        return jobs;
    }

    /** The mode in which a service runs by itself: an asynchronous one if there is one. */
    static Mode modeAlone(List<Mode> modes) {
        return modes.contains(Mode.PROMISE) ? Mode.PROMISE : modes.getLast();
    }

    private Job job(Part part, Mode mode, String subject, int number, int server) {
        return new Job(part, mode, subject, settings.loops(), seconds(), number, server);
    }

    /** With changes of state: in real time no longer than the loops take. */
    private double seconds() {
        return settings.realTime() ? settings.loops() * CYCLE_SECONDS : settings.seconds();
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
