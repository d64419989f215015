package io.troupe.demo.evaluate;

import static io.troupe.services.subsumption.Mode.CALLBACK;
import static io.troupe.services.subsumption.Mode.PROMISE;
import static io.troupe.services.subsumption.Mode.SYNC;

import io.troupe.demo.evaluate.PaperClaim.Finding;
import io.troupe.services.subsumption.Mode;

/** The paper's claims about elapsed robot time. */
final class TimeClaims {
    private final ClaimsBuilder sheet;

    TimeClaims(ClaimsBuilder sheet) {
        this.sheet = sheet;
    }

    void add() {
        modes();
        promise();
        services();
    }

    private static double[] time(CoreMeasurements in, Mode mode) {
        return in.both(MeasurementKind.LOOPS, mode, Quantity.TIME);
    }

    private void modes() {
        sheet.add(
                "3.4, Figure 15",
                "The total time taken is equal to a sum of the time taken by both the services.",
                sheet.elapsed(),
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
            sheet.add(
                    mode == CALLBACK ? "3.5, Figure 18" : "3.6, Figure 21",
                    "(both services run at once, so that " + mode + " takes as long as the longer one)",
                    sheet.elapsed(),
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
                ClaimsBuilder.MUCH);
    }

    private void promise() {
        sheet.ratio(
                "3.6, Figure 21",
                "It [promise] is faster than synchronous [..]",
                sheet.elapsed(),
                SYNC,
                PROMISE,
                Quantity.TIME,
                1);
        sheet.ratio(
                "3.6, Figure 21",
                "It [promise] is faster than [..] actor with callback.",
                sheet.elapsed(),
                CALLBACK,
                PROMISE,
                Quantity.TIME,
                1);
        sheet.close(sheet.elapsed(), Quantity.TIME);
    }

    private void services() {
        sheet.services(Claims.WANDERER_TAKES_LESS, sheet.elapsed(), PROMISE, Quantity.TIME);
        sheet.add(
                "3.4",
                "The switching is fast (200-300 milliseconds)",
                sheet.elapsed(),
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
}
