package io.troupe.demo.evaluate;

import static io.troupe.services.subsumption.Mode.CALLBACK;
import static io.troupe.services.subsumption.Mode.PROMISE;
import static io.troupe.services.subsumption.Mode.SYNC;

import io.troupe.demo.evaluate.PaperClaim.Finding;
import io.troupe.services.subsumption.Mode;
import java.util.List;
import java.util.function.Function;

/** The claims about time and messages in sections 3.4 to 4 of the paper, judged by measurements. */
final class Claims {
    private static final String WANDERER_TAKES_LESS =
            "Space Wanderer service takes very less time than Wall Follower in covering 1000 loops of the service.";

    private final ClaimsBuilder builder;

    private Claims(ClaimsBuilder builder) {
        this.builder = builder;
    }

    /**
     * All claims for which measurements exist.
     *
     * @param modes those measured
     */
    static List<PaperClaim> of(Measurements measurements, List<Mode> modes, List<Integer> cores, boolean realTime) {
        Mode alone = Plan.modeAlone(modes);
        var claims = new Claims(new ClaimsBuilder(
                cores.stream()
                        .map(count -> new CoreMeasurements(measurements, alone, count))
                        .toList(),
                realTime));
        claims.elapsedTimeByMode();
        claims.elapsedTimeOfPromise();
        claims.elapsedTimeByService();
        claims.computing();
        claims.messages();
        return claims.builder.claims();
    }

    private static double[] time(CoreMeasurements in, Mode mode) {
        return in.both(MeasurementKind.LOOPS, mode, Quantity.TIME);
    }

    private void elapsedTimeByMode() {
        builder.add(
                "3.4, Figure 15",
                "The total time taken is equal to a sum of the time taken by both the services.",
                builder.elapsed(),
                "synchronous within 2 % or a cycle of the sum of both by themselves",
                ClaimsBuilder.has(SYNC),
                in -> {
                    double[] follower = in.aloneMs(CoreMeasurements.FOLLOWER);
                    double[] wanderer = in.aloneMs(CoreMeasurements.WANDERER);
                    return new Finding(
                            in.cores(),
                            CoreMeasurements.seconds(time(in, SYNC)) + ", the services by themselves "
                                    + CoreMeasurements.seconds(follower) + " and " + CoreMeasurements.seconds(wanderer),
                            ClaimsBuilder.same(time(in, SYNC), CoreMeasurements.sum(follower, wanderer)));
                });
        for (Mode mode : CoreMeasurements.asynchronous()) {
            builder.add(
                    mode == CALLBACK ? "3.5, Figure 18" : "3.6, Figure 21",
                    "(both services run at once, so that " + mode + " takes as long as the longer one)",
                    builder.elapsed(),
                    "within 2 % or a cycle of the longer one by itself",
                    ClaimsBuilder.has(mode),
                    in -> {
                        double[] longer = CoreMeasurements.longer(
                                in.aloneMs(CoreMeasurements.FOLLOWER), in.aloneMs(CoreMeasurements.WANDERER));
                        return new Finding(
                                in.cores(),
                                CoreMeasurements.seconds(time(in, mode)) + ", the longer one by itself "
                                        + CoreMeasurements.seconds(longer),
                                ClaimsBuilder.same(time(in, mode), longer));
                    });
        }
        builder.ratio(
                "3.5",
                "It [callback] is faster than the synchronous model.",
                builder.elapsed(),
                SYNC,
                CALLBACK,
                Quantity.TIME,
                1);
        builder.ratio(
                "4, Figure 23",
                "The time taken in running services synchronously takes much time than the other because both the services run one after the other.",
                builder.elapsed(),
                SYNC,
                PROMISE,
                Quantity.TIME,
                ClaimsBuilder.MUCH);
    }

    private void elapsedTimeOfPromise() {
        builder.ratio(
                "3.6, Figure 21",
                "It [promise] is faster than synchronous [..]",
                builder.elapsed(),
                SYNC,
                PROMISE,
                Quantity.TIME,
                1);
        builder.ratio(
                "3.6, Figure 21",
                "It [promise] is faster than [..] actor with callback.",
                builder.elapsed(),
                CALLBACK,
                PROMISE,
                Quantity.TIME,
                1);
        builder.close(builder.elapsed(), Quantity.TIME);
    }

    private void elapsedTimeByService() {
        builder.services(WANDERER_TAKES_LESS, builder.elapsed(), PROMISE, Quantity.TIME);
        builder.add(
                "3.4",
                "The switching is fast (200-300 milliseconds)",
                builder.elapsed(),
                "from one cycle of a service to its next 200 to 300 ms; to the other service's it takes half as long",
                ClaimsBuilder.has(SYNC),
                in -> {
                    double[] interval = in.service(SYNC, CoreMeasurements.WANDERER, Quantity.INTERVAL);
                    return new Finding(
                            in.cores(),
                            SampleStatistics.of(interval).text(0) + " ms",
                            ClaimVerdict.within(interval, 200 - 1, 300 + 1));
                });
    }

    /**
     * Claims about computing time. They exclude thread wake-up, whose cost depends on the operating system and is many
     * times larger than the rest.
     */
    private void computing() {
        builder.services(WANDERER_TAKES_LESS, "computing time", PROMISE, Quantity.CYCLE);
        builder.ratio(
                "4, Figure 23",
                "running services synchronously takes much time than the other",
                "computing time with messages",
                SYNC,
                PROMISE,
                Quantity.TURN,
                ClaimsBuilder.MUCH);
        builder.ratio(
                "3.6, Figure 21",
                "services running on promise takes less time than callback.",
                "computing time with messages",
                CALLBACK,
                PROMISE,
                Quantity.TURN,
                1);
        builder.close("computing time with messages", Quantity.TURN);
    }

    private void messages() {
        builder.add(
                "4",
                "The time taken by the callback function to send messages to the main function is almost equal to 1-2 milliseconds.",
                "delay of a message",
                "the middle of a run's messages, with changes of state: 1000 to 2000 us",
                ClaimsBuilder.has(CALLBACK),
                in -> {
                    double[] delays = in.both(MeasurementKind.SWITCHES, CALLBACK, Quantity.DELAY);
                    return delays.length == 0
                            ? new Finding(in.cores(), "no message was sent", ClaimVerdict.CANNOT_BE_TOLD)
                            : new Finding(
                                    in.cores(),
                                    CoreMeasurements.micros(delays) + ", 99 of 100 within "
                                            + CoreMeasurements.micros(
                                                    in.both(MeasurementKind.SWITCHES, CALLBACK, Quantity.DELAY_P99)),
                                    ClaimVerdict.within(delays, 1000, 2000));
                });
        perChange(
                PROMISE,
                "It sends a color only single time",
                "messages for a change of state: 1, or 2 where both robots wander and see something",
                each -> ClaimVerdict.within(each, 1, 2));
        perChange(
                CALLBACK,
                "a callback sends the color repeatedly till the service is switched off.",
                "messages for a change of state: more than 2",
                each -> ClaimVerdict.above(each, 2));
    }

    private void perChange(Mode mode, String words, String criterion, Function<double[], ClaimVerdict> verdict) {
        builder.add("3.6", words, "messages", criterion, ClaimsBuilder.has(mode), in -> {
            double[] messages = in.messagesPerChange(mode);
            return messages.length == 0
                    ? new Finding(in.cores(), "no state has changed", ClaimVerdict.CANNOT_BE_TOLD)
                    : new Finding(in.cores(), SampleStatistics.of(messages).text(1), verdict.apply(messages));
        });
    }
}
