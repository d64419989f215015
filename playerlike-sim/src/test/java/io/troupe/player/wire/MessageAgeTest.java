package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Ages that are worked out by hand; the sender's clock began at another time than the receiver's. */
class MessageAgeTest {
    private static final double CYCLE_SECONDS = 0.1;
    private static final Offset<Double> ROUNDING = within(1e-6);

    private final MessageAge ages = new MessageAge(-5_000_000_000L);
    private double clocksDifferBySeconds = -12_345;
    private double sentSeconds;

    /** A message that is sent one cycle after the last one. */
    private double next(double transitSeconds) {
        sentSeconds += CYCLE_SECONDS;
        return received(sentSeconds, transitSeconds);
    }

    /** @param atSeconds on the receiver's clock */
    private double received(double atSeconds, double transitSeconds) {
        return ages.seconds(atSeconds - clocksDifferBySeconds, Math.round((atSeconds + transitSeconds) * 1e9));
    }

    @Test
    void message_isOlderThanTheFastestByItsLongerTransit() {
        assertThat(next(0.002)).isCloseTo(0, ROUNDING);
        assertThat(next(0.302)).isCloseTo(0.3, ROUNDING);
        assertThat(next(0.001)).isCloseTo(0, ROUNDING);
        assertThat(next(0.302)).isCloseTo(0.301, ROUNDING);
    }

    /** The transit of the fastest message cannot be seen; what is later is measured from there. */
    @Test
    void connectionThatBeginsLate_countsFromItsFirstMessage_untilOneIsFaster() {
        assertThat(next(1.5)).isCloseTo(0, ROUNDING);
        assertThat(next(1.6)).isCloseTo(0.1, ROUNDING);
        assertThat(next(0.01)).isCloseTo(0, ROUNDING);
        assertThat(next(1.5)).isCloseTo(1.49, ROUNDING);
    }

    @ParameterizedTest
    @ValueSource(doubles = {0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY})
    void messageWithoutATimeStamp_hasNoAge_andChangesNoOther(double stamp) {
        assertThat(next(0.01)).isCloseTo(0, ROUNDING);
        assertThat(ages.seconds(stamp, 1)).isEqualTo(Double.POSITIVE_INFINITY);
        assertThat(next(0.02)).isCloseTo(0.01, ROUNDING);
    }

    @ParameterizedTest
    @ValueSource(doubles = {1e-4, -1e-4})
    void clocksThatDriftForTenHours_addTwelveMillisecondsAtMost(double drift) {
        for (int cycle = 0; cycle < 360_000; cycle++) {
            clocksDifferBySeconds += CYCLE_SECONDS * drift;
            assertThat(next(0.002)).isBetween(-1e-6, 0.0121);
        }
    }

    @ParameterizedTest
    @ValueSource(ints = {1, 30, 90, 100_000})
    void messagesOfACut_areAsOldAsTheyAre_howeverLongItWas(int cutSeconds) {
        for (int cycle = 0; cycle < 3_000; cycle++) {
            next(0.002);
        }
        double beganSeconds = sentSeconds;
        double healedSeconds = beganSeconds + cutSeconds;
        while (sentSeconds + CYCLE_SECONDS < Math.min(healedSeconds, beganSeconds + 60)) {
            double age = healedSeconds - (sentSeconds + CYCLE_SECONDS);
            assertThat(next(age + 0.002)).isCloseTo(age, ROUNDING);
        }
        sentSeconds = healedSeconds;
        assertThat(next(0.002)).isCloseTo(0, ROUNDING);
    }

    @Test
    void connectionThatStaysSlow_isTheNormAfterTwoMinutes_andNotBeforeOne() {
        next(0.002);
        for (int cycle = 0; cycle < 590; cycle++) {
            assertThat(next(0.502)).isCloseTo(0.5, ROUNDING);
        }
        for (int cycle = 590; cycle < 1_200; cycle++) {
            next(0.502);
        }
        assertThat(next(0.502)).isCloseTo(0, ROUNDING);
    }
}
