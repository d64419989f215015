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
    static final String WANDERER_TAKES_LESS =
            "Space Wanderer service takes very less time than Wall Follower in covering 1000 loops of the service.";

    private final ClaimsBuilder sheet;

    private Claims(ClaimsBuilder sheet) {
        this.sheet = sheet;
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
        new TimeClaims(claims.sheet).add();
        claims.computing();
        claims.messages();
        return claims.sheet.claims();
    }

    /**
     * Claims about computing time. They exclude thread wake-up, whose cost depends on the operating system and is many
     * times larger than the rest.
     */
    private void computing() {
        sheet.services(WANDERER_TAKES_LESS, "computing time", PROMISE, Quantity.CYCLE);
        sheet.ratio(
                "4, Figure 23",
                "running services synchronously takes much time than the other",
                "computing time with messages",
                SYNC,
                PROMISE,
                Quantity.TURN,
                ClaimsBuilder.MUCH);
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
        sheet.add("3.6", words, "messages", criterion, ClaimsBuilder.has(mode), in -> {
            double[] messages = in.messagesPerChange(mode);
            return messages.length == 0
                    ? new Finding(in.cores(), "no state has changed", ClaimVerdict.CANNOT_BE_TOLD)
                    : new Finding(in.cores(), SampleStatistics.of(messages).text(1), verdict.apply(messages));
        });
    }
}
