package io.troupe.demo.evaluate;

import io.troupe.demo.terminal.Interruption;
import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

/**
 * Runs all measurements, one job at a time, alternating between the measuring JVMs, so that no measurement disturbs
 * another.
 */
final class Evaluation {
    private static final Duration NOTICE = Duration.ofSeconds(2);

    private final EvaluationSettings settings;
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
    Evaluation(EvaluationSettings settings, PaperWorld world, EvaluationProgress progress, Interruption interruption) {
        this.interruption = interruption;
        this.settings = settings;
        this.world = world;
        this.plan = new Plan(settings);
        this.progress = progress;
    }

    /** Runs the measurements and returns them; after an interruption, those completed so far. */
    Measurements measure() throws IOException {
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
            return measurements;
        } catch (IOException | RuntimeException ended) {
            // Ctrl-C also ends the child processes, possibly before this process receives it
            if (!interruption.isRequestedWithin(NOTICE)) {
                throw ended;
            }
            return measurements;
        } finally {
            processes.forEach(MeasuringProcess::close);
        }
    }

    /** Number of repetitions in which every job was measured. */
    int completeRepetitions() {
        return completeRepetitions;
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

    private Result inRealTime(Job job, MeasuringProcess process) throws IOException {
        try (var server = RealTimeServer.open(world, job.seed(), progress::within)) {
            return process.measure(new Job(
                    job.kind(), job.mode(), job.subject(), job.loops(), job.seconds(), job.seed(), server.port()));
        }
    }

    private void keep(Result result, Job job, int cores) {
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
}
