package io.troupe.demo.evaluate;

import static io.troupe.services.subsumption.Mode.CALLBACK;
import static io.troupe.services.subsumption.Mode.PROMISE;
import static io.troupe.services.subsumption.Mode.SYNC;

import io.troupe.common.text.Plural;
import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import io.troupe.tools.SampleStatistics;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.function.DoubleBinaryOperator;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * The claims about time and messages in sections 3.4 to 4 of the paper, and the verdicts of our measurements on them.
 *
 * <p>{@link #all} is the list of the claims: each has a {@link Rule}, which decides it by the measurements for one
 * number of cores. {@link #judge} applies the rules.
 */
final class PaperClaims {
    private static final String WANDERER_TAKES_LESS =
            "Space Wanderer service takes very less time than Wall Follower in covering 1000 loops of the service.";
    private static final String COMPUTING = "computing time";
    /** Excludes thread wake-up, whose cost depends on the operating system and is many times larger than the rest. */
    private static final String COMPUTING_WITH_MESSAGES = "computing time with messages";

    private static final String MESSAGES = "messages";

    /** Our reading of "much": at least half as much again. */
    private static final double MUCH = 1.5;

    private static final double CYCLE_MS = 100;

    private PaperClaims() {}

    /**
     * A claim of the paper.
     *
     * @param source section and figure of the paper
     * @param words quotation of the paper; in brackets if the paper only shows it
     * @param measure the kind of time, or what else is counted
     * @param rule decides the claim
     */
    record Claim(String source, String words, String measure, Rule rule) {}

    /**
     * The result for JVMs configured with one number of cores.
     *
     * @param ours the measured numbers, as text
     */
    record Finding(int cores, String ours, ClaimVerdict verdict) {}

    /**
     * A claim and our results.
     *
     * @param findings one for each number of cores
     */
    record Judged(Claim claim, List<Finding> findings) {
        Judged {
            findings = List.copyOf(findings);
        }

        ClaimVerdict verdict() {
            return ClaimVerdict.agreed(findings.stream().map(Finding::verdict).toList());
        }

        /** The measured numbers; printed once if they are equal for all numbers of cores. */
        String ours() {
            if (findings.stream().map(Finding::ours).distinct().count() == 1) {
                return findings.getFirst().ours();
            }
            return findings.stream()
                    .map(each -> Plural.of(each.cores(), "core") + ": " + each.ours())
                    .collect(Collectors.joining("; "));
        }
    }

    /** All claims in the order of the report, whether measured or not. */
    static List<Claim> all(boolean realTime) {
        return Stream.of(elapsedTime(realTime ? "time on the wall" : "simulated time"), computingTime(), messages())
                .flatMap(List::stream)
                .toList();
    }

    /** @param elapsed name of the robots' clock */
    private static List<Claim> elapsedTime(String elapsed) {
        return List.of(
                new Claim(
                        "3.4, Figure 15",
                        "The total time taken is equal to a sum of the time taken by both the services.",
                        elapsed,
                        new TakesTheSum()),
                new Claim(
                        "3.5, Figure 18",
                        "(both services run at once, so that callback takes as long as the longer one)",
                        elapsed,
                        new TakesTheLonger(CALLBACK)),
                new Claim(
                        "3.6, Figure 21",
                        "(both services run at once, so that promise takes as long as the longer one)",
                        elapsed,
                        new TakesTheLonger(PROMISE)),
                new Claim(
                        "3.5",
                        "It [callback] is faster than the synchronous model.",
                        elapsed,
                        new TakesMore(SYNC, CALLBACK, Quantity.TIME, 1)),
                new Claim(
                        "4, Figure 23",
                        "The time taken in running services synchronously takes much time than the other because both the services run one after the other.",
                        elapsed,
                        new TakesMore(SYNC, PROMISE, Quantity.TIME, MUCH)),
                new Claim(
                        "3.6, Figure 21",
                        "It [promise] is faster than synchronous [..]",
                        elapsed,
                        new TakesMore(SYNC, PROMISE, Quantity.TIME, 1)),
                new Claim(
                        "3.6, Figure 21",
                        "It [promise] is faster than [..] actor with callback.",
                        elapsed,
                        new TakesMore(CALLBACK, PROMISE, Quantity.TIME, 1)),
                new Claim(
                        "4, Figure 22",
                        "there is not much time difference between actor with callback model and actor with promise.",
                        elapsed,
                        new TakesAboutTheSame(Quantity.TIME)),
                new Claim("4", WANDERER_TAKES_LESS, elapsed, new FollowerTakesMore(PROMISE, Quantity.TIME)),
                new Claim("3.4", "The switching is fast (200-300 milliseconds)", elapsed, new TakesTwoOrThreeCycles()));
    }

    private static List<Claim> computingTime() {
        return List.of(
                new Claim("4", WANDERER_TAKES_LESS, COMPUTING, new FollowerTakesMore(PROMISE, Quantity.CYCLE)),
                new Claim(
                        "4, Figure 23",
                        "running services synchronously takes much time than the other",
                        COMPUTING_WITH_MESSAGES,
                        new TakesMore(SYNC, PROMISE, Quantity.TURN, MUCH)),
                new Claim(
                        "3.6, Figure 21",
                        "services running on promise takes less time than callback.",
                        COMPUTING_WITH_MESSAGES,
                        new TakesMore(CALLBACK, PROMISE, Quantity.TURN, 1)),
                new Claim(
                        "4, Figure 22",
                        "there is not much time difference between actor with callback model and actor with promise.",
                        COMPUTING_WITH_MESSAGES,
                        new TakesAboutTheSame(Quantity.TURN)));
    }

    private static List<Claim> messages() {
        return List.of(
                new Claim(
                        "4",
                        "The time taken by the callback function to send messages to the main function is almost equal to 1-2 milliseconds.",
                        "delay of a message",
                        new ArrivesInOneOrTwoMillis()),
                new Claim("3.6", "It sends a color only single time", MESSAGES, new SendsOnce()),
                new Claim(
                        "3.6",
                        "a callback sends the color repeatedly till the service is switched off.",
                        MESSAGES,
                        new SendsRepeatedly()));
    }

    /**
     * Judges all claims for whose modes measurements exist.
     *
     * @param modes those measured
     */
    static List<Judged> judge(Measurements measurements, List<Mode> modes, List<Integer> cores, boolean realTime) {
        Mode alone = Evaluation.modeAlone(modes);
        List<ForCores> all = cores.stream()
                .map(count -> new ForCores(measurements, alone, count, realTime))
                .toList();
        return all(realTime).stream()
                .map(claim -> new Judged(
                        claim,
                        all.stream()
                                .filter(each -> each.hasLoops(claim.rule().modes()))
                                .map(claim.rule()::judge)
                                .toList()))
                .filter(judged -> !judged.findings().isEmpty())
                .toList();
    }

    /** Decides a claim. */
    sealed interface Rule {
        /** When the claim counts as confirmed, in words. */
        String criterion();

        /** The modes that must have been measured. */
        List<Mode> modes();

        Finding judge(ForCores in);
    }

    /** Synchronous mode takes as long as both services by themselves, one after the other. */
    record TakesTheSum() implements Rule {
        @Override
        public String criterion() {
            return "synchronous within 2 % or a cycle of the sum of both by themselves";
        }

        @Override
        public List<Mode> modes() {
            return List.of(SYNC);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] follower = in.aloneMs(Measurement.FOLLOWER);
            double[] wanderer = in.aloneMs(Measurement.WANDERER);
            return in.finding(
                    seconds(in.elapsedMs(SYNC)) + ", the services by themselves " + seconds(follower) + " and "
                            + seconds(wanderer),
                    same(in.elapsedMs(SYNC), pairs(follower, wanderer, Double::sum)));
        }
    }

    /** A mode takes as long as the service that takes longer by itself. */
    record TakesTheLonger(Mode mode) implements Rule {
        @Override
        public String criterion() {
            return "within 2 % or a cycle of the longer one by itself";
        }

        @Override
        public List<Mode> modes() {
            return List.of(mode);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] longer = pairs(in.aloneMs(Measurement.FOLLOWER), in.aloneMs(Measurement.WANDERER), Math::max);
            return in.finding(
                    seconds(in.elapsedMs(mode)) + ", the longer one by itself " + seconds(longer),
                    same(in.elapsedMs(mode), longer));
        }
    }

    /** One mode takes more than {@code times} as much of a quantity as another. */
    record TakesMore(Mode more, Mode less, Quantity quantity, double times) implements Rule {
        @Override
        public String criterion() {
            return String.format(Locale.ROOT, "%s more than %s times %s", more, times == 1 ? "1" : times, less);
        }

        @Override
        public List<Mode> modes() {
            return List.of(more, less);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] ratios = in.ratios(more, less, quantity);
            return in.finding(
                    more + " " + text(in.both(Kind.LOOPS, more, quantity), quantity) + ", " + less + " "
                            + text(in.both(Kind.LOOPS, less, quantity), quantity) + ": " + ratioText(ratios),
                    isSignificant(in)
                            ? certain(ClaimVerdict.above(ratios, times), quantity, ratios)
                            : ClaimVerdict.CANNOT_BE_TOLD);
        }

        /** In real time a difference must exceed one cycle, since a run may start in the middle of a cycle. */
        private boolean isSignificant(ForCores in) {
            return !in.realTime
                    || quantity != Quantity.TIME
                    || same(in.elapsedMs(more), in.elapsedMs(less)) != ClaimVerdict.HOLDS;
        }
    }

    /** Callback and promise mode take about the same. */
    record TakesAboutTheSame(Quantity quantity) implements Rule {
        @Override
        public String criterion() {
            return "callback 0.9 to 1.1 times promise";
        }

        @Override
        public List<Mode> modes() {
            return List.of(CALLBACK, PROMISE);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] ratios = in.ratios(CALLBACK, PROMISE, quantity);
            return in.finding(ratioText(ratios), certain(ClaimVerdict.within(ratios, 0.9, 1.1), quantity, ratios));
        }
    }

    /** The wall follower takes much more of a quantity than the space wanderer. */
    record FollowerTakesMore(Mode mode, Quantity quantity) implements Rule {
        @Override
        public String criterion() {
            return String.format(Locale.ROOT, "wall follower more than %s times space wanderer, %s mode", MUCH, mode);
        }

        @Override
        public List<Mode> modes() {
            return List.of(mode);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] follower = in.service(mode, Measurement.FOLLOWER, quantity);
            double[] wanderer = in.service(mode, Measurement.WANDERER, quantity);
            double[] ratios = Measurements.ratios(follower, wanderer);
            return in.finding(
                    "wall follower " + text(follower, quantity) + ", space wanderer " + text(wanderer, quantity) + ": "
                            + ratioText(ratios),
                    certain(ClaimVerdict.above(ratios, MUCH), quantity, ratios));
        }
    }

    /** In synchronous mode a service has its next cycle after two or three cycles. */
    record TakesTwoOrThreeCycles() implements Rule {
        @Override
        public String criterion() {
            return "from one cycle of a service to its next 200 to 300 ms; to the other service's it takes half as long";
        }

        @Override
        public List<Mode> modes() {
            return List.of(SYNC);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] intervals = in.service(SYNC, Measurement.WANDERER, Quantity.INTERVAL);
            return in.finding(
                    SampleStatistics.of(intervals).text(0) + " ms", ClaimVerdict.within(intervals, 200 - 1, 300 + 1));
        }
    }

    /** A colour of a callback reaches the main code in one to two milliseconds. */
    record ArrivesInOneOrTwoMillis() implements Rule {
        @Override
        public String criterion() {
            return "the middle of a run's messages, with changes of state: 1000 to 2000 us";
        }

        @Override
        public List<Mode> modes() {
            return List.of(CALLBACK);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] delays = in.both(Kind.SWITCHES, CALLBACK, Quantity.DELAY);
            return delays.length == 0
                    ? in.finding("no message was sent", ClaimVerdict.CANNOT_BE_TOLD)
                    : in.finding(
                            micros(delays) + ", 99 of 100 within "
                                    + micros(in.both(Kind.SWITCHES, CALLBACK, Quantity.DELAY_P99)),
                            ClaimVerdict.within(delays, 1000, 2000));
        }
    }

    /** A promise brings a colour once. */
    record SendsOnce() implements Rule {
        @Override
        public String criterion() {
            return "messages for a change of state: 1, or 2 where both robots wander and see something";
        }

        @Override
        public List<Mode> modes() {
            return List.of(PROMISE);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] messages = in.messagesPerChange(PROMISE);
            return messages.length == 0
                    ? in.noChange()
                    : in.finding(SampleStatistics.of(messages).text(1), ClaimVerdict.within(messages, 1, 2));
        }
    }

    /** A callback brings a colour again and again. */
    record SendsRepeatedly() implements Rule {
        @Override
        public String criterion() {
            return "messages for a change of state: more than 2";
        }

        @Override
        public List<Mode> modes() {
            return List.of(CALLBACK);
        }

        @Override
        public Finding judge(ForCores in) {
            double[] messages = in.messagesPerChange(CALLBACK);
            return messages.length == 0
                    ? in.noChange()
                    : in.finding(SampleStatistics.of(messages).text(1), ClaimVerdict.above(messages, 2));
        }
    }

    /** Whether times are equal, up to the difference of starting in the middle of a cycle. */
    private static ClaimVerdict same(double[] millis, double[] expectedMillis) {
        double tolerance =
                Math.max(0.02, CYCLE_MS / SampleStatistics.of(expectedMillis).least());
        return ClaimVerdict.within(Measurements.ratios(millis, expectedMillis), 1 - tolerance, 1 + tolerance);
    }

    /** The verdict on ratios of a quantity. Only elapsed simulated time is conclusive without repetitions. */
    private static ClaimVerdict certain(ClaimVerdict verdict, Quantity quantity, double[] ratios) {
        return quantity == Quantity.TIME ? verdict : verdict.ifRepeated(ratios.length);
    }

    /** Combines the values of each repetition. */
    private static double[] pairs(double[] one, double[] other, DoubleBinaryOperator operator) {
        double[] combined = one.clone();
        Arrays.setAll(combined, index -> operator.applyAsDouble(one[index], other[index]));
        return combined;
    }

    private static String text(double[] values, Quantity quantity) {
        return quantity == Quantity.TIME ? seconds(values) : micros(values);
    }

    private static String seconds(double[] millis) {
        return Measurements.seconds(millis).text(1) + " s";
    }

    private static String micros(double[] micros) {
        return SampleStatistics.of(micros).text(2) + " us";
    }

    private static String ratioText(double[] ratios) {
        return SampleStatistics.of(ratios).text(2) + " times";
    }

    /**
     * The measurements for one number of cores.
     *
     * @param alone the mode in which services ran by themselves
     */
    record ForCores(Measurements measurements, Mode alone, int cores, boolean realTime) {
        private boolean hasLoops(List<Mode> modes) {
            return modes.stream()
                    .allMatch(mode -> measurements.has(Kind.LOOPS, mode, cores, Measurement.BOTH, Quantity.TIME));
        }

        private Finding finding(String ours, ClaimVerdict verdict) {
            return new Finding(cores, ours, verdict);
        }

        private Finding noChange() {
            return finding("no state has changed", ClaimVerdict.CANNOT_BE_TOLD);
        }

        /** The values of both services together, or of the whole run. */
        private double[] both(Kind kind, Mode mode, Quantity quantity) {
            return measurements.values(kind, mode, cores, Measurement.BOTH, quantity);
        }

        private double[] elapsedMs(Mode mode) {
            return both(Kind.LOOPS, mode, Quantity.TIME);
        }

        private double[] service(Mode mode, String service, Quantity quantity) {
            return measurements.values(Kind.LOOPS, mode, cores, service, quantity);
        }

        /** Elapsed time of a service that runs alone. */
        private double[] aloneMs(String service) {
            return measurements.values(Kind.ALONE, alone, cores, service, Quantity.TIME);
        }

        private double[] ratios(Mode numerator, Mode denominator, Quantity quantity) {
            return Measurements.ratios(both(Kind.LOOPS, numerator, quantity), both(Kind.LOOPS, denominator, quantity));
        }

        /** Messages of all services to the main code, per state change. */
        private double[] messagesPerChange(Mode mode) {
            double[] changes = both(Kind.SWITCHES, mode, Quantity.STATE_CHANGES);
            double[] sent = both(Kind.SWITCHES, mode, Quantity.SENT);
            // runs without a state change are left out: their ratio is undefined
            return IntStream.range(0, changes.length)
                    .filter(index -> changes[index] > 0)
                    .mapToDouble(index -> sent[index] / changes[index])
                    .toArray();
        }
    }
}
