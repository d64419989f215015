package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Synthetic measurements for all modes and for 2 and 3 cores. */
final class MadeUp {
    static final List<Mode> MODES = List.of(Mode.values());
    static final List<Integer> CORES = List.of(2, 3);
    static final int REPETITIONS = Verdict.ENOUGH_REPETITIONS;

    private record Key(Part part, Mode mode, String subject, Quantity quantity) {}

    private final Map<Key, Double> values = new LinkedHashMap<>();

    static EvaluationSettings settings(Path out) {
        return new EvaluationSettings(
                Path.of("none.world"), 1000, CORES, MODES, REPETITIONS, 0, 300, false, false, out.resolve("log"));
    }

    /** Measurements that confirm every claim of the paper. */
    static MadeUp asThePaperSays() {
        var made = new MadeUp();
        double[] both = {5_000, 4_010, 4_000};
        for (Mode mode : MODES) {
            made.loops(mode, Measurement.BOTH, Quantity.TIME, both[mode.ordinal()])
                    .loops(mode, Measurement.BOTH, Quantity.TURN, both[mode.ordinal()])
                    .loops(mode, Measurement.BOTH, Quantity.PROCESSOR, 2 * both[mode.ordinal()]);
            for (Quantity quantity : List.of(Quantity.TIME, Quantity.CYCLE)) {
                made.loops(mode, Findings.FOLLOWER, quantity, 4_000).loops(mode, Findings.WANDERER, quantity, 1_000);
            }
            made.loops(mode, Findings.WANDERER, Quantity.INTERVAL, 250);
            made.add(Part.SWITCHES, mode, Measurement.BOTH, Quantity.STATE_CHANGES, 10);
        }
        made.loops(Mode.SYNC, Measurement.BOTH, Quantity.TIME, 8_000)
                .add(Part.ALONE, Mode.PROMISE, Findings.FOLLOWER, Quantity.TIME, 4_000)
                .add(Part.ALONE, Mode.PROMISE, Findings.WANDERER, Quantity.TIME, 4_000);
        made.loops(Mode.SYNC, Measurement.BOTH, Quantity.TURN, 8_000)
                .add(Part.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.DELAY, 1_500)
                .add(Part.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.DELAY_P99, 2_000)
                .add(Part.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.SENT, 300)
                .add(Part.SWITCHES, Mode.PROMISE, Measurement.BOTH, Quantity.SENT, 10);
        return made;
    }

    MadeUp loops(Mode mode, String subject, Quantity quantity, double value) {
        return add(Part.LOOPS, mode, subject, quantity, value);
    }

    /** Adds a value; replaces an existing one. */
    MadeUp add(Part part, Mode mode, String subject, Quantity quantity, double value) {
        values.put(new Key(part, mode, subject, quantity), value);
        return this;
    }

    MadeUp forget(Part part, Mode mode) {
        values.keySet().removeIf(key -> key.part() == part && key.mode() == mode);
        return this;
    }

    Measurements measurements() {
        var measurements = new Measurements();
        values.forEach((key, value) -> {
            for (int cores : CORES) {
                for (int repetition = 1; repetition <= REPETITIONS; repetition++) {
                    measurements.add(new Measurement(
                            key.part(), key.mode(), cores, repetition, key.subject(), key.quantity(), value));
                }
            }
        });
        return measurements;
    }

    List<Claim> claims() {
        return Claims.of(measurements(), MODES, CORES, false);
    }
}
