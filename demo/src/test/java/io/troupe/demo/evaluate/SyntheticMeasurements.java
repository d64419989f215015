package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Synthetic measurements for all modes and for 2 and 3 cores. */
final class SyntheticMeasurements {
    static final List<Mode> MODES = List.of(Mode.values());
    static final List<Integer> CORES = List.of(2, 3);
    static final int REPETITIONS = ClaimVerdict.ENOUGH_REPETITIONS;

    private record Key(Kind kind, Mode mode, String subject, Quantity quantity) {}

    private final Map<Key, Double> values = new LinkedHashMap<>();

    static Evaluation.Settings settings(Path out) {
        return new Evaluation.Settings(
                Path.of("none.world"), 1000, CORES, MODES, REPETITIONS, 0, 300, false, false, out.resolve("log"));
    }

    /** Measurements that confirm every claim of the paper. */
    static SyntheticMeasurements confirmingThePaper() {
        var made = new SyntheticMeasurements();
        double[] both = {5_000, 4_010, 4_000};
        for (Mode mode : MODES) {
            made.loops(mode, Measurement.BOTH, Quantity.TIME, both[mode.ordinal()])
                    .loops(mode, Measurement.BOTH, Quantity.TURN, both[mode.ordinal()])
                    .loops(mode, Measurement.BOTH, Quantity.PROCESSOR, 2 * both[mode.ordinal()]);
            for (Quantity quantity : List.of(Quantity.TIME, Quantity.CYCLE)) {
                made.loops(mode, Measurement.FOLLOWER, quantity, 4_000)
                        .loops(mode, Measurement.WANDERER, quantity, 1_000);
            }
            made.loops(mode, Measurement.WANDERER, Quantity.INTERVAL, 250);
            made.add(Kind.SWITCHES, mode, Measurement.BOTH, Quantity.STATE_CHANGES, 10);
        }
        made.loops(Mode.SYNC, Measurement.BOTH, Quantity.TIME, 8_000)
                .add(Kind.ALONE, Mode.PROMISE, Measurement.FOLLOWER, Quantity.TIME, 4_000)
                .add(Kind.ALONE, Mode.PROMISE, Measurement.WANDERER, Quantity.TIME, 4_000);
        made.loops(Mode.SYNC, Measurement.BOTH, Quantity.TURN, 8_000)
                .add(Kind.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.DELAY, 1_500)
                .add(Kind.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.DELAY_P99, 2_000)
                .add(Kind.SWITCHES, Mode.CALLBACK, Measurement.BOTH, Quantity.SENT, 300)
                .add(Kind.SWITCHES, Mode.PROMISE, Measurement.BOTH, Quantity.SENT, 10);
        return made;
    }

    SyntheticMeasurements loops(Mode mode, String subject, Quantity quantity, double value) {
        return add(Kind.LOOPS, mode, subject, quantity, value);
    }

    /** Adds a value; replaces an existing one. */
    SyntheticMeasurements add(Kind kind, Mode mode, String subject, Quantity quantity, double value) {
        values.put(new Key(kind, mode, subject, quantity), value);
        return this;
    }

    SyntheticMeasurements forget(Kind kind, Mode mode) {
        values.keySet().removeIf(key -> key.kind() == kind && key.mode() == mode);
        return this;
    }

    Measurements measurements() {
        var measurements = new Measurements();
        values.forEach((key, value) -> {
            for (int cores : CORES) {
                for (int repetition = 1; repetition <= REPETITIONS; repetition++) {
                    measurements.add(new Measurement(
                            key.kind(), key.mode(), cores, repetition, key.subject(), key.quantity(), value));
                }
            }
        });
        return measurements;
    }

    List<PaperClaims.Judged> claims() {
        return PaperClaims.judge(measurements(), MODES, CORES, false);
    }
}
