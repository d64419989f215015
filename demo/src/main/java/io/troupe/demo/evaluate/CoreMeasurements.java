package io.troupe.demo.evaluate;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.stream.IntStream;

/** The measurements for one number of cores, in the form that claims need. */
final class CoreMeasurements {
    static final String FOLLOWER = Service.WALL_FOLLOWER.name();
    static final String WANDERER = Service.SPACE_WANDERER.name();

    private final Measurements measurements;
    private final Mode alone;
    private final int cores;

    CoreMeasurements(Measurements measurements, Mode alone, int cores) {
        this.measurements = measurements;
        this.alone = alone;
        this.cores = cores;
    }

    int cores() {
        return cores;
    }

    boolean has(Mode... modes) {
        return Arrays.stream(modes)
                .allMatch(
                        mode -> measurements.has(MeasurementKind.LOOPS, mode, cores, Measurement.BOTH, Quantity.TIME));
    }

    /** The values of both services together, or of the whole run. */
    double[] both(MeasurementKind kind, Mode mode, Quantity quantity) {
        return measurements.values(kind, mode, cores, Measurement.BOTH, quantity);
    }

    double[] service(Mode mode, String service, Quantity quantity) {
        return measurements.values(MeasurementKind.LOOPS, mode, cores, service, quantity);
    }

    /** Milliseconds of a service that runs alone. */
    double[] aloneMs(String service) {
        return measurements.values(MeasurementKind.ALONE, alone, cores, service, Quantity.TIME);
    }

    double[] ratio(Mode numerator, Mode denominator, Quantity quantity) {
        return Measurements.ratios(
                both(MeasurementKind.LOOPS, numerator, quantity), both(MeasurementKind.LOOPS, denominator, quantity));
    }

    /** Formats milliseconds as seconds. */
    static String seconds(double[] millis) {
        return SampleStatistics.of(
                                Arrays.stream(millis).map(each -> each / 1000).toArray())
                        .text(1) + " s";
    }

    static String micros(double[] micros) {
        return SampleStatistics.of(micros).text(2) + " us";
    }

    static String times(double[] ratios) {
        return SampleStatistics.of(ratios).text(2) + " times";
    }

    static double[] sum(double[] one, double[] other) {
        double[] sum = one.clone();
        Arrays.setAll(sum, index -> one[index] + other[index]);
        return sum;
    }

    static double[] longer(double[] one, double[] other) {
        double[] longer = one.clone();
        Arrays.setAll(longer, index -> Math.max(one[index], other[index]));
        return longer;
    }

    /** Messages of all services to the main code, per state change. */
    double[] messagesPerChange(Mode mode) {
        double[] changes = both(MeasurementKind.SWITCHES, mode, Quantity.STATE_CHANGES);
        double[] sent = both(MeasurementKind.SWITCHES, mode, Quantity.SENT);
        // runs without a state change are left out: their ratio is undefined
        var withChanges = IntStream.range(0, changes.length)
                .filter(index -> changes[index] > 0)
                .toArray();
        return Arrays.stream(withChanges)
                .mapToDouble(index -> sent[index] / changes[index])
                .toArray();
    }

    static String format(String text, Object... values) {
        return String.format(Locale.ROOT, text, values);
    }

    static String cores(int count) {
        return count + (count == 1 ? " core" : " cores");
    }

    static List<Mode> asynchronous() {
        return List.of(Mode.CALLBACK, Mode.PROMISE);
    }
}
