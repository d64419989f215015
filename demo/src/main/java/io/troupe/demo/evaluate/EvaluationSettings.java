package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.List;

/**
 * What is evaluated.
 *
 * @param cores what the JVMs that measure are told, one after the other
 * @param seconds of simulated time with changes of state, in lock step
 */
record EvaluationSettings(
        Path world,
        int loops,
        List<Integer> cores,
        List<Mode> modes,
        int repetitions,
        double seconds,
        boolean reconnect,
        boolean realTime) {
    EvaluationSettings {
        cores = List.copyOf(cores);
        modes = List.copyOf(modes);
    }
}
