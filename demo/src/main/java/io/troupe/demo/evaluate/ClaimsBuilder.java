package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.PaperClaim.Finding;
import io.troupe.services.subsumption.Mode;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;
import java.util.function.Predicate;

/** Collects the claims for which measurements exist, with methods for the frequent kinds of claim. */
final class ClaimsBuilder {
    /** Our reading of "much": at least half as much again. */
    static final double MUCH = 1.5;

    private static final double CYCLE_MS = 100;

    private final List<CoreMeasurements> findings;
    private final boolean realTime;
    private final List<PaperClaim> claims = new ArrayList<>();

    /** @param findings by number of cores */
    ClaimsBuilder(List<CoreMeasurements> findings, boolean realTime) {
        this.findings = findings;
        this.realTime = realTime;
    }

    List<PaperClaim> claims() {
        return List.copyOf(claims);
    }

    /** Name of the robots' clock. */
    String elapsed() {
        return realTime ? "time on the wall" : "simulated time";
    }

    void add(
            String source,
            String words,
            String measure,
            String criterion,
            Predicate<CoreMeasurements> measured,
            Function<CoreMeasurements, Finding> finding) {
        List<CoreMeasurements> with = findings.stream().filter(measured).toList();
        if (!with.isEmpty()) {
            claims.add(new PaperClaim(
                    source,
                    words,
                    measure,
                    criterion,
                    with.stream().map(finding).toList()));
        }
    }

    static Predicate<CoreMeasurements> has(Mode... modes) {
        return each -> each.has(modes);
    }

    /** Whether times are equal, up to the difference of starting in the middle of a cycle. */
    static ClaimVerdict same(double[] millis, double[] expectedMillis) {
        double tolerance =
                Math.max(0.02, CYCLE_MS / SampleStatistics.of(expectedMillis).least());
        return ClaimVerdict.within(Measurements.ratios(millis, expectedMillis), 1 - tolerance, 1 + tolerance);
    }

    /** The verdict on ratios of a quantity. Only elapsed simulated time is conclusive without repetitions. */
    static ClaimVerdict certain(ClaimVerdict verdict, Quantity quantity, double[] ratios) {
        return quantity == Quantity.TIME ? verdict : verdict.ifRepeated(ratios.length);
    }

    /** Adds the claim that one mode takes more of a quantity than another. */
    void ratio(String source, String words, String measure, Mode more, Mode less, Quantity quantity, double limit) {
        add(
                source,
                words,
                measure,
                CoreMeasurements.format("%s more than %s times %s", more, limit == 1 ? "1" : limit, less),
                has(more, less),
                in -> {
                    double[] ratios = in.ratio(more, less, quantity);
                    return new Finding(
                            in.cores(),
                            more + " " + text(in.both(MeasurementKind.LOOPS, more, quantity), quantity) + ", " + less
                                    + " "
                                    + text(in.both(MeasurementKind.LOOPS, less, quantity), quantity) + ": "
                                    + CoreMeasurements.times(ratios),
                            differs(in, more, less, quantity)
                                    ? certain(ClaimVerdict.above(ratios, limit), quantity, ratios)
                                    : ClaimVerdict.CANNOT_BE_TOLD);
                });
    }

    static String text(double[] values, Quantity quantity) {
        return quantity == Quantity.TIME ? CoreMeasurements.seconds(values) : CoreMeasurements.micros(values);
    }

    /**
     * Whether a difference in time is significant. In real time it must exceed one cycle, since a run may start in the
     * middle of a cycle.
     */
    private boolean differs(CoreMeasurements in, Mode more, Mode less, Quantity quantity) {
        return !realTime
                || quantity != Quantity.TIME
                || same(in.both(MeasurementKind.LOOPS, more, quantity), in.both(MeasurementKind.LOOPS, less, quantity))
                        != ClaimVerdict.HOLDS;
    }

    /** Adds the claim that callback and promise mode take about the same. */
    void close(String measure, Quantity quantity) {
        add(
                "4, Figure 22",
                "there is not much time difference between actor with callback model and actor with promise.",
                measure,
                "callback 0.9 to 1.1 times promise",
                has(Mode.CALLBACK, Mode.PROMISE),
                in -> {
                    double[] ratios = in.ratio(Mode.CALLBACK, Mode.PROMISE, quantity);
                    return new Finding(
                            in.cores(),
                            CoreMeasurements.times(ratios),
                            certain(ClaimVerdict.within(ratios, 0.9, 1.1), quantity, ratios));
                });
    }

    void services(String words, String measure, Mode mode, Quantity quantity) {
        add(
                "4",
                words,
                measure,
                CoreMeasurements.format("wall follower more than %s times space wanderer, %s mode", MUCH, mode),
                has(mode),
                in -> {
                    double[] follower = in.service(mode, CoreMeasurements.FOLLOWER, quantity);
                    double[] wanderer = in.service(mode, CoreMeasurements.WANDERER, quantity);
                    double[] ratios = Measurements.ratios(follower, wanderer);
                    return new Finding(
                            in.cores(),
                            "wall follower " + text(follower, quantity) + ", space wanderer " + text(wanderer, quantity)
                                    + ": " + CoreMeasurements.times(ratios),
                            certain(ClaimVerdict.above(ratios, MUCH), quantity, ratios));
                });
    }
}
