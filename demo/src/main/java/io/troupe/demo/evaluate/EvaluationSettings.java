package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.List;

/**
 * What is evaluated.
 *
 * @param cores what the JVMs that measure are told, one after the other
 * @param warmUps how often everything is done before it is measured, in lock step, so that the JVMs have compiled it
 * @param seconds with changes of state, on the robots' clock
 * @param log where the JVMs that measure write what they log
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
