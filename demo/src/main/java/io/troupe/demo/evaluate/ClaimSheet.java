package io.troupe.demo.evaluate;

import io.troupe.demo.evaluate.Claim.Finding;
import io.troupe.services.subsumption.Mode;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;
import java.util.function.Predicate;

/** Collects the claims for which measurements exist, with methods for the frequent kinds of claim. */
final class ClaimSheet {
    /** Our reading of "much": at least half as much again. */
    static final double MUCH = 1.5;

    private static final double CYCLE_MS = 100;

    private final List<Findings> findings;
    private final boolean realTime;
    private final List<Claim> claims = new ArrayList<>();

    /** @param findings by number of cores */
    ClaimSheet(List<Findings> findings, boolean realTime) {
        this.findings = findings;
        this.realTime = realTime;
    }

    List<Claim> claims() {
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
            Predicate<Findings> measured,
            Function<Findings, Finding> finding) {
        List<Findings> with = findings.stream().filter(measured).toList();
        if (!with.isEmpty()) {
            claims.add(new Claim(
                    source,
                    words,
                    measure,
                    criterion,
                    with.stream().map(finding).toList()));
        }
    }

    static Predicate<Findings> has(Mode... modes) {
        return each -> each.has(modes);
    }

    /** Whether times are equal, up to the difference of starting in the middle of a cycle. */
    static Verdict same(double[] millis, double[] expectedMillis) {
        double tolerance = Math.max(0.02, CYCLE_MS / Spread.of(expectedMillis).least());
        return Verdict.within(Measurements.ratios(millis, expectedMillis), 1 - tolerance, 1 + tolerance);
    }

    /** The verdict on ratios of a quantity. Only elapsed simulated time is conclusive without repetitions. */
    static Verdict certain(Verdict verdict, Quantity quantity, double[] ratios) {
        return quantity == Quantity.TIME ? verdict : verdict.ifRepeated(ratios.length);
    }

    /** Adds the claim that one mode takes more of a quantity than another. */
    void ratio(String source, String words, String measure, Mode more, Mode less, Quantity quantity, double limit) {
        add(
                source,
                words,
                measure,
                Findings.format("%s more than %s times %s", more, limit == 1 ? "1" : limit, less),
                has(more, less),
                in -> {
                    double[] ratios = in.ratio(more, less, quantity);
                    return new Finding(
                            in.cores(),
                            more + " " + text(in.both(Part.LOOPS, more, quantity), quantity) + ", " + less + " "
                                    + text(in.both(Part.LOOPS, less, quantity), quantity) + ": "
                                    + Findings.times(ratios),
                            differs(in, more, less, quantity)
                                    ? certain(Verdict.above(ratios, limit), quantity, ratios)
                                    : Verdict.CANNOT_BE_TOLD);
                });
    }

    static String text(double[] values, Quantity quantity) {
        return quantity == Quantity.TIME ? Findings.seconds(values) : Findings.micros(values);
    }

    /**
     * Whether a difference in time is significant. In real time it must exceed one cycle, since a run may start in the
     * middle of a cycle.
     */
    private boolean differs(Findings in, Mode more, Mode less, Quantity quantity) {
        return !realTime
                || quantity != Quantity.TIME
                || same(in.both(Part.LOOPS, more, quantity), in.both(Part.LOOPS, less, quantity)) != Verdict.HOLDS;
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
                            Findings.times(ratios),
                            certain(Verdict.within(ratios, 0.9, 1.1), quantity, ratios));
                });
    }

    void services(String words, String measure, Mode mode, Quantity quantity) {
        add(
                "4",
                words,
                measure,
                Findings.format("wall follower more than %s times space wanderer, %s mode", MUCH, mode),
                has(mode),
                in -> {
                    double[] follower = in.service(mode, Findings.FOLLOWER, quantity);
                    double[] wanderer = in.service(mode, Findings.WANDERER, quantity);
                    double[] ratios = Measurements.ratios(follower, wanderer);
                    return new Finding(
                            in.cores(),
                            "wall follower " + text(follower, quantity) + ", space wanderer " + text(wanderer, quantity)
                                    + ": " + Findings.times(ratios),
                            certain(Verdict.above(ratios, MUCH), quantity, ratios));
                });
    }
}
