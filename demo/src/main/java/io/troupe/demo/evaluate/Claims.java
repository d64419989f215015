package io.troupe.demo.evaluate;

import static io.troupe.services.subsumption.Mode.CALLBACK;
import static io.troupe.services.subsumption.Mode.PROMISE;
import static io.troupe.services.subsumption.Mode.SYNC;

import io.troupe.demo.evaluate.Claim.Finding;
import io.troupe.services.subsumption.Mode;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;
import java.util.function.Predicate;

/** What sections 3.4 to 4 of the paper say about time and messages, and the numbers that decide it. */
final class Claims {
    /** What "much" is taken to mean: by half. */
    private static final double MUCH = 1.5;

    private static final double CYCLE_MS = 100;

    private final List<Findings> findings;
    private final String elapsed;
    private final List<Claim> claims = new ArrayList<>();

    private Claims(List<Findings> findings, boolean realTime) {
        this.findings = findings;
        this.elapsed = realTime ? "time on the wall" : "simulated time";
    }

    /**
     * All claims for which something was measured.
     *
     * @param modes that were measured
     */
    static List<Claim> of(Measurements measurements, List<Mode> modes, List<Integer> cores, boolean realTime) {
        Mode alone = Plan.modeAlone(modes);
        var claims = new Claims(
                cores.stream()
                        .map(count -> new Findings(measurements, alone, count))
                        .toList(),
                realTime);
        claims.timeOfModes();
        claims.timeOfPromise();
        claims.timeOfServices();
        claims.computing();
        claims.messages();
        return List.copyOf(claims.claims);
    }

    private void add(
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

    private static Predicate<Findings> has(Mode... modes) {
        return each -> each.has(modes);
    }

    private static double[] time(Findings in, Mode mode) {
        return in.both(Part.LOOPS, mode, Quantity.TIME);
    }

    /** Whether times are the same but for what starting in the middle of a cycle makes. */
    private static Verdict same(double[] millis, double[] expectedMillis) {
        double tolerance = Math.max(0.02, CYCLE_MS / Spread.of(expectedMillis).least());
        return Verdict.within(Measurements.ratios(millis, expectedMillis), 1 - tolerance, 1 + tolerance);
    }

    /** Of quotients of numbers of some kind. */
    private static Verdict certain(Verdict verdict, Quantity quantity, double[] ratios) {
        return quantity == Quantity.TIME ? verdict : verdict.ifRepeated(ratios.length);
    }

    private void timeOfModes() {
        add(
                "3.4, Figure 15",
                "The total time taken is equal to a sum of the time taken by both the services.",
                elapsed,
                "synchronous within 2 % or a cycle of the sum of both by themselves",
                has(SYNC),
                in -> {
                    double[] follower = in.aloneMs(Findings.FOLLOWER);
                    double[] wanderer = in.aloneMs(Findings.WANDERER);
                    return new Finding(
                            in.cores(),
                            Findings.seconds(time(in, SYNC)) + ", the services by themselves "
                                    + Findings.seconds(follower) + " and " + Findings.seconds(wanderer),
                            same(time(in, SYNC), Findings.sum(follower, wanderer)));
                });
        for (Mode mode : Findings.asynchronous()) {
            add(
                    mode == CALLBACK ? "3.5, Figure 18" : "3.6, Figure 21",
                    "(both services run at once, so that " + mode + " takes as long as the longer one)",
                    elapsed,
                    "within 2 % or a cycle of the longer one by itself",
                    has(mode),
                    in -> {
                        double[] longer = Findings.longer(in.aloneMs(Findings.FOLLOWER), in.aloneMs(Findings.WANDERER));
                        return new Finding(
                                in.cores(),
                                Findings.seconds(time(in, mode)) + ", the longer one by itself "
                                        + Findings.seconds(longer),
                                same(time(in, mode), longer));
                    });
        }
        ratio("3.5", "It [callback] is faster than the synchronous model.", elapsed, SYNC, CALLBACK, Quantity.TIME, 1);
        ratio(
                "4, Figure 23",
                "The time taken in running services synchronously takes much time than the other because both the services run one after the other.",
                elapsed,
                SYNC,
                PROMISE,
                Quantity.TIME,
                MUCH);
    }

    /** That one mode takes more of something than another. */
    private void ratio(
            String source, String words, String measure, Mode more, Mode less, Quantity quantity, double limit) {
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
                            certain(Verdict.above(ratios, limit), quantity, ratios));
                });
    }

    private static String text(double[] values, Quantity quantity) {
        return quantity == Quantity.TIME ? Findings.seconds(values) : Findings.micros(values);
    }

    private void timeOfPromise() {
        ratio(
                "3.6, Figure 21",
                "It [promise] is faster than synchronous and actor with callback.",
                elapsed,
                CALLBACK,
                PROMISE,
                Quantity.TIME,
                1);
        close(elapsed, Quantity.TIME);
    }

    /** That callback and promise are not far from each other. */
    private void close(String measure, Quantity quantity) {
        add(
                "4, Figure 22",
                "there is not much time difference between actor with callback model and actor with promise.",
                measure,
                "callback 0.9 to 1.1 times promise",
                has(CALLBACK, PROMISE),
                in -> {
                    double[] ratios = in.ratio(CALLBACK, PROMISE, quantity);
                    return new Finding(
                            in.cores(),
                            Findings.times(ratios),
                            certain(Verdict.within(ratios, 0.9, 1.1), quantity, ratios));
                });
    }

    private void timeOfServices() {
        String words =
                "Space Wanderer service takes very less time than Wall Follower in covering 1000 loops of the service.";
        services(words, elapsed, PROMISE, Quantity.TIME);
        services(words, "computing time", PROMISE, Quantity.CYCLE);
        add(
                "3.4",
                "The switching [from one service to the other] is fast (200-300 milliseconds)",
                elapsed,
                "from one cycle of a service to its next: 200 to 300 ms",
                has(SYNC),
                in -> {
                    double[] interval = in.service(SYNC, Findings.WANDERER, Quantity.INTERVAL);
                    return new Finding(
                            in.cores(),
                            Spread.of(interval).text(0) + " ms",
                            Verdict.within(interval, 200 - 1, 300 + 1));
                });
    }

    private void services(String words, String measure, Mode mode, Quantity quantity) {
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

    private void computing() {
        ratio(
                "4, Figure 23",
                "running services synchronously takes much time than the other",
                "processor time",
                SYNC,
                PROMISE,
                Quantity.PROCESSOR,
                MUCH);
        ratio(
                "3.6, Figure 21",
                "services running on promise takes less time than callback.",
                "computing time with messages",
                CALLBACK,
                PROMISE,
                Quantity.TURN,
                1);
        close("computing time with messages", Quantity.TURN);
    }

    private void messages() {
        add(
                "4",
                "The time taken by the callback function to send messages to the main function is almost equal to 1-2 milliseconds.",
                "delay of a message",
                "the middle of a run's messages, with changes of state: 1000 to 2000 us",
                has(CALLBACK),
                in -> {
                    double[] delays = in.both(Part.SWITCHES, CALLBACK, Quantity.DELAY);
                    return delays.length == 0
                            ? new Finding(in.cores(), "no message was sent", Verdict.CANNOT_BE_TOLD)
                            : new Finding(
                                    in.cores(),
                                    Findings.micros(delays) + ", 99 of 100 within "
                                            + Findings.micros(in.both(Part.SWITCHES, CALLBACK, Quantity.DELAY_P99)),
                                    Verdict.within(delays, 1000, 2000));
                });
        perChange(
                PROMISE,
                "It sends a color only single time",
                "messages for a change of state: 1, or 2 where both robots wander and see something",
                each -> Verdict.within(each, 1, 2));
        perChange(
                CALLBACK,
                "a callback sends the color repeatedly till the service is switched off.",
                "messages for a change of state: more than 2",
                each -> Verdict.above(each, 2));
    }

    private void perChange(Mode mode, String words, String criterion, Function<double[], Verdict> verdict) {
        add("3.6", words, "messages", criterion, has(mode), in -> {
            double[] messages = in.messagesPerChange(mode);
            return messages.length == 0
                    ? new Finding(in.cores(), "no state has changed", Verdict.CANNOT_BE_TOLD)
                    : new Finding(in.cores(), Spread.of(messages).text(1), verdict.apply(messages));
        });
    }
}
