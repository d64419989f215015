package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.terminal.Interruption;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.tools.MeasuringJvm;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

/**
 * Runs all measurements and judges the claims of the paper by them.
 *
 * <p><b>Order.</b> One job at a time, alternating between the measuring JVMs, so that no measurement disturbs another.
 */
final class Evaluation {
    private static final Duration NOTICE = Duration.ofSeconds(2);

    /**
     * Settings of an evaluation.
     *
     * @param cores numbers of cores for which the measuring JVMs are configured
     * @param warmUps rounds in lock step before the measurement, so that the JVMs have compiled the code
     * @param seconds duration of the parts with state changes, in robot time
     * @param log file for the log output of the measuring JVMs
     */
    record Settings(
            Path world,
            int loops,
            List<Integer> cores,
            List<Mode> modes,
            int repetitions,
            int warmUps,
            double seconds,
            boolean reconnect,
            boolean realTime,
            Path log) {
        Settings {
            cores = List.copyOf(cores);
            modes = List.copyOf(modes);
        }

        private Settings withRepetitions(int number) {
            return new Settings(world, loops, cores, modes, number, warmUps, seconds, reconnect, realTime, log);
        }
    }

    /**
     * What an evaluation has found.
     *
     * @param settings with the number of complete repetitions, in which every job was measured
     * @param measurements of the complete repetitions
     * @param claims judged by the complete repetitions; empty if there are none
     * @param all everything that was measured, incomplete repetitions included
     */
    record Outcome(Settings settings, Measurements measurements, List<PaperClaims.Judged> claims, Measurements all) {
        static Outcome of(Settings settings, int completeRepetitions, Measurements all) {
            var measurements = all.ofRepetitions(completeRepetitions);
            return new Outcome(
                    settings.withRepetitions(completeRepetitions),
                    measurements,
                    PaperClaims.judge(measurements, settings.modes(), settings.cores(), settings.realTime()),
                    all);
        }
    }

    private final Settings settings;
    private final PaperWorld world;
    private final Plan plan;
    private final EvaluationProgress progress;
    private final Interruption interruption;
    private final Measurements measurements = new Measurements();
    private int completeRepetitions;

    /**
     * @param world the world of the settings
     * @param interruption stops the measurement
     */
    Evaluation(Settings settings, PaperWorld world, EvaluationProgress progress, Interruption interruption) {
        this.interruption = interruption;
        this.settings = settings;
        this.world = world;
        this.plan = new Plan(settings);
        this.progress = progress;
    }

    /** Runs the measurements, all of them or until an interruption, and judges the claims. */
    Outcome run() throws IOException {
        measure();
        return Outcome.of(settings, completeRepetitions, measurements);
    }

    private void measure() throws IOException {
        var processes = new CopyOnWriteArrayList<MeasuringProcess>();
        interruption.onRequest(() -> processes.forEach(MeasuringProcess::end));
        try {
            for (int cores : settings.cores()) {
                interruption.check();
                processes.add(MeasuringProcess.start(cores, settings.world(), settings.log()));
            }
            progress.expect(expectedSeconds());
            warmUp(processes);
            for (int repetition = 1; repetition <= settings.repetitions(); repetition++) {
                for (Job job : plan.repetition(repetition)) {
                    for (MeasuringProcess process : processes) {
                        interruption.check();
                        progress.begins(job, process.cores());
                        keep(
                                settings.realTime() ? inRealTime(job, process) : process.measure(job),
                                job,
                                process.cores());
                        progress.ended(Plan.expectedSeconds(job));
                    }
                }
                completeRepetitions++;
            }
        } catch (IOException | RuntimeException ended) {
            // Ctrl-C also ends the child processes, possibly before this process receives it
            if (!interruption.isRequestedWithin(NOTICE)) {
                throw ended;
            }
        } finally {
            processes.forEach(MeasuringProcess::close);
        }
    }

    private void warmUp(List<MeasuringProcess> processes) throws IOException {
        for (int round = 1; round <= settings.warmUps(); round++) {
            for (Job job : plan.warmUp(round)) {
                for (MeasuringProcess process : processes) {
                    interruption.check();
                    progress.warmsUp(process.cores());
                    process.measure(job);
                    progress.ended(warmUpSeconds(job));
                }
            }
        }
    }

    /** The warm-up runs in lock step, so in real time its duration is negligible. */
    private double warmUpSeconds(Job job) {
        return settings.realTime() ? 0 : Plan.expectedSeconds(job);
    }

    private Job.Result inRealTime(Job job, MeasuringProcess process) throws IOException {
        try (var server = world.serve(job.seed(), progress::within)) {
            return process.measure(new Job(
                    job.kind(), job.mode(), job.subject(), job.loops(), job.seconds(), job.seed(), server.port()));
        }
    }

    private void keep(Job.Result result, Job job, int cores) {
        for (var value : result.values()) {
            measurements.add(new Measurement(
                    job.kind(),
                    job.mode(),
                    cores,
                    Math.toIntExact(job.seed()),
                    value.subject(),
                    value.quantity(),
                    value.value()));
        }
    }

    /** Total expected duration, in robot time. Negligible parts are left out. */
    private double expectedSeconds() {
        double once =
                plan.repetition(1).stream().mapToDouble(Plan::expectedSeconds).sum();
        double warmUp = plan.warmUp(1).stream().mapToDouble(this::warmUpSeconds).sum();
        return (once * settings.repetitions() + warmUp * settings.warmUps())
                * settings.cores().size();
    }

    /** The mode for services that run alone: promise mode if it is measured. */
    static Mode modeAlone(List<Mode> modes) {
        return modes.contains(Mode.PROMISE) ? Mode.PROMISE : modes.getLast();
    }

    /** The jobs of an evaluation and their order. */
    private static final class Plan {
        private static final double CYCLE_SECONDS = 0.1;
        /** Loops of a warm-up round: enough for the compilers, even if fewer are measured. */
        private static final int WARM_UP_LOOPS = 1000;

        private final Settings settings;

        Plan(Settings settings) {
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
                jobs.add(job(Kind.LOOPS, mode, Measurement.BOTH, number));
                jobs.add(job(Kind.SWITCHES, mode, Measurement.BOTH, number));
                if (settings.reconnect()
                        && mode != Mode.SYNC) { // in the paper the synchronous program connects only once
                    jobs.add(job(Kind.RECONNECTS, mode, Measurement.BOTH, number));
                }
            }
            for (Service service : List.of(Service.WALL_FOLLOWER, Service.SPACE_WANDERER)) {
                jobs.add(job(Kind.ALONE, modeAlone(settings.modes()), service.name(), number));
            }
            Collections.rotate(jobs, number);
            return jobs;
        }

        private Job job(Kind kind, Mode mode, String subject, int number) {
            return new Job(kind, mode, subject, settings.loops(), settings.seconds(), number, 0);
        }

        /** Approximate duration of a job in robot time. */
        static double expectedSeconds(Job job) {
            if (!job.countsLoops()) {
                return job.seconds();
            }
            boolean oneAfterTheOther = job.mode() == Mode.SYNC && job.kind() == Kind.LOOPS;
            return job.loops() * CYCLE_SECONDS * (oneAfterTheOther ? 2 : 1);
        }
    }

    /**
     * A child JVM that executes jobs with a configured number of processors.
     *
     * <p><b>Errors.</b> {@link IOException} if the JVM cannot be started, fails, exits, or has a different number of
     * processors. Its log output goes to a file.
     */
    static final class MeasuringProcess implements AutoCloseable {
        private final int cores;
        private final MeasuringJvm jvm;

        private MeasuringProcess(int cores, MeasuringJvm jvm) {
            this.cores = cores;
            this.jvm = jvm;
        }

        static MeasuringProcess start(int cores, Path world, Path log) throws IOException {
            return new MeasuringProcess(
                    cores,
                    MeasuringJvm.running(JobRunner.class, world.toString())
                            .withProcessors(cores)
                            .withOptions("-Xms256m", "-Xmx256m")
                            .withLog(log)
                            .start());
        }

        int cores() {
            return cores;
        }

        Job.Result measure(Job job) throws IOException {
            return Job.Result.parse(jvm.ask(job.line(), job.title()));
        }

        /** Kills the process in any state. May be called by any thread. */
        void end() {
            jvm.end();
        }

        @Override
        public void close() {
            jvm.close();
        }
    }
}
