package io.troupe.demo.evaluate;

import static io.troupe.services.subsumption.Mode.CALLBACK;
import static io.troupe.services.subsumption.Mode.PROMISE;
import static io.troupe.services.subsumption.Mode.SYNC;

import io.troupe.demo.evaluate.Claim.Finding;
import io.troupe.services.subsumption.Mode;
import java.util.List;
import java.util.function.Function;

/** What sections 3.4 to 4 of the paper say about time and messages, and the numbers that decide it. */
final class Claims {
    private final ClaimSheet sheet;

    private Claims(ClaimSheet sheet) {
        this.sheet = sheet;
    }

    /**
     * All claims for which something was measured.
     *
     * @param modes that were measured
     */
    static List<Claim> of(Measurements measurements, List<Mode> modes, List<Integer> cores, boolean realTime) {
        Mode alone = Plan.modeAlone(modes);
        var claims = new Claims(new ClaimSheet(
                cores.stream()
                        .map(count -> new Findings(measurements, alone, count))
                        .toList(),
                realTime));
        claims.timeOfModes();
        claims.timeOfPromise();
        claims.timeOfServices();
        claims.computing();
        claims.messages();
        return claims.sheet.claims();
    }

    private static double[] time(Findings in, Mode mode) {
        return in.both(Part.LOOPS, mode, Quantity.TIME);
    }

    private void timeOfModes() {
        sheet.add(
                "3.4, Figure 15",
                "The total time taken is equal to a sum of the time taken by both the services.",
                sheet.elapsed(),
                "synchronous within 2 % or a cycle of the sum of both by themselves",
                ClaimSheet.has(SYNC),
                in -> {
                    double[] follower = in.aloneMs(Findings.FOLLOWER);
                    double[] wanderer = in.aloneMs(Findings.WANDERER);
                    return new Finding(
                            in.cores(),
                            Findings.seconds(time(in, SYNC)) + ", the services by themselves "
                                    + Findings.seconds(follower) + " and " + Findings.seconds(wanderer),
                            ClaimSheet.same(time(in, SYNC), Findings.sum(follower, wanderer)));
                });
        for (Mode mode : Findings.asynchronous()) {
            sheet.add(
                    mode == CALLBACK ? "3.5, Figure 18" : "3.6, Figure 21",
                    "(both services run at once, so that " + mode + " takes as long as the longer one)",
                    sheet.elapsed(),
                    "within 2 % or a cycle of the longer one by itself",
                    ClaimSheet.has(mode),
                    in -> {
                        double[] longer = Findings.longer(in.aloneMs(Findings.FOLLOWER), in.aloneMs(Findings.WANDERER));
                        return new Finding(
                                in.cores(),
                                Findings.seconds(time(in, mode)) + ", the longer one by itself "
                                        + Findings.seconds(longer),
                                ClaimSheet.same(time(in, mode), longer));
                    });
        }
        sheet.ratio(
                "3.5",
                "It [callback] is faster than the synchronous model.",
                sheet.elapsed(),
                SYNC,
                CALLBACK,
                Quantity.TIME,
                1);
        sheet.ratio(
                "4, Figure 23",
                "The time taken in running services synchronously takes much time than the other because both the services run one after the other.",
                sheet.elapsed(),
                SYNC,
                PROMISE,
                Quantity.TIME,
                ClaimSheet.MUCH);
    }

    private void timeOfPromise() {
        sheet.ratio(
                "3.6, Figure 21",
                "It [promise] is faster than synchronous and actor with callback.",
                sheet.elapsed(),
                CALLBACK,
                PROMISE,
                Quantity.TIME,
                1);
        sheet.close(sheet.elapsed(), Quantity.TIME);
    }

    private void timeOfServices() {
        String words =
                "Space Wanderer service takes very less time than Wall Follower in covering 1000 loops of the service.";
        sheet.services(words, sheet.elapsed(), PROMISE, Quantity.TIME);
        sheet.services(words, "computing time", PROMISE, Quantity.CYCLE);
        sheet.add(
                "3.4",
                "The switching [from one service to the other] is fast (200-300 milliseconds)",
                sheet.elapsed(),
                "from one cycle of a service to its next: 200 to 300 ms",
                ClaimSheet.has(SYNC),
                in -> {
                    double[] interval = in.service(SYNC, Findings.WANDERER, Quantity.INTERVAL);
                    return new Finding(
                            in.cores(),
                            Spread.of(interval).text(0) + " ms",
                            Verdict.within(interval, 200 - 1, 300 + 1));
                });
    }

    private void computing() {
        sheet.ratio(
                "4, Figure 23",
                "running services synchronously takes much time than the other",
                "processor time",
                SYNC,
                PROMISE,
                Quantity.PROCESSOR,
                ClaimSheet.MUCH);
        sheet.ratio(
                "3.6, Figure 21",
                "services running on promise takes less time than callback.",
                "computing time with messages",
                CALLBACK,
                PROMISE,
                Quantity.TURN,
                1);
        sheet.close("computing time with messages", Quantity.TURN);
    }

    private void messages() {
        sheet.add(
                "4",
                "The time taken by the callback function to send messages to the main function is almost equal to 1-2 milliseconds.",
                "delay of a message",
                "the middle of a run's messages, with changes of state: 1000 to 2000 us",
                ClaimSheet.has(CALLBACK),
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
        sheet.add("3.6", words, "messages", criterion, ClaimSheet.has(mode), in -> {
            double[] messages = in.messagesPerChange(mode);
            return messages.length == 0
                    ? new Finding(in.cores(), "no state has changed", Verdict.CANNOT_BE_TOLD)
                    : new Finding(in.cores(), Spread.of(messages).text(1), verdict.apply(messages));
        });
    }
}
