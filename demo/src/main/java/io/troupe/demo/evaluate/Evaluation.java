package io.troupe.demo.evaluate;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;

/**
 * Measures everything, one job at a time, so that no two measurements disturb each other: the JVMs take turns.
 */
final class Evaluation {
    private final EvaluationSettings settings;
    private final PaperWorld world;
    private final Plan plan;
    private final EvaluationProgress progress;
    private final Measurements measurements = new Measurements();

    Evaluation(EvaluationSettings settings, EvaluationProgress progress) {
        this.settings = settings;
        this.world = PaperWorld.read(settings.world());
        this.plan = new Plan(settings);
        this.progress = progress;
    }

    Measurements measure() throws IOException {
        var processes = new ArrayList<MeasuringProcess>();
        try {
            for (int cores : settings.cores()) {
                processes.add(MeasuringProcess.start(cores, settings.world()));
            }
            progress.expect(expectedSeconds());
            warmUp(processes);
            for (int repetition = 1; repetition <= settings.repetitions(); repetition++) {
                for (Job job : plan.repetition(repetition, 0)) {
                    for (MeasuringProcess process : processes) {
                        progress.begins(job, process.cores());
                        keep(settings.realTime() ? inRealTime(job, process) : process.measure(job), job, process.cores());
                        progress.ended(Plan.expectedSeconds(job));
                    }
                }
            }
            return measurements;
        } finally {
            processes.forEach(MeasuringProcess::close);
        }
    }

    private void warmUp(List<MeasuringProcess> processes) throws IOException {
        for (int round = 1; round <= Plan.WARM_UPS; round++) {
            for (Job job : plan.repetition(round, 0)) {
                for (MeasuringProcess process : processes) {
                    progress.warmsUp(process.cores());
                    process.measure(job);
                    if (!settings.realTime()) {
                        progress.ended(Plan.expectedSeconds(job));
                    }
                }
            }
        }
    }

    private Result inRealTime(Job job, MeasuringProcess process) throws IOException {
        try (var server = RealTimeServer.open(world, job.seed())) {
            return process.measure(new Job(
                    job.part(), job.mode(), job.subject(), job.loops(), job.seconds(), job.seed(), server.port()));
        }
    }

    private void keep(Result result, Job job, int cores) {
        for (var value : result.values()) {
            measurements.add(new Measurement(
                    job.part(),
                    job.mode(),
                    cores,
                    Math.toIntExact(job.seed()),
                    value.subject(),
                    value.quantity(),
                    value.value()));
        }
    }

    /** On the robots' clock, of all that takes time. */
    private double expectedSeconds() {
        double once = plan.repetition(1, 0).stream()
                .mapToDouble(Plan::expectedSeconds)
                .sum();
        int rounds = settings.repetitions() + (settings.realTime() ? 0 : Plan.WARM_UPS);
        return once * rounds * settings.cores().size();
    }
}
