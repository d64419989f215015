package io.troupe.demo.evaluate;

import io.troupe.common.measure.MeasuringJvm;
import java.io.IOException;
import java.nio.file.Path;

/**
 * A child JVM that executes jobs with a configured number of processors.
 *
 * <p><b>Errors.</b> {@link IOException} if the JVM cannot be started, fails, exits, or has a different number of
 * processors. Its log output goes to a file.
 */
final class MeasuringProcess implements AutoCloseable {
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
