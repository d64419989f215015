package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.List;

/**
 * Settings of an evaluation.
 *
 * @param cores numbers of cores for which the measuring JVMs are configured
 * @param warmUps rounds in lock step before the measurement, so that the JVMs have compiled the code
 * @param seconds duration of the parts with state changes, in robot time
 * @param log file for the log output of the measuring JVMs
 */
record EvaluationSettings(
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
    EvaluationSettings {
        cores = List.copyOf(cores);
        modes = List.copyOf(modes);
    }

    EvaluationSettings withRepetitions(int number) {
        return new EvaluationSettings(world, loops, cores, modes, number, warmUps, seconds, reconnect, realTime, log);
    }
}
