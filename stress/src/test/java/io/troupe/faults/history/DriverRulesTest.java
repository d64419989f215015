package io.troupe.faults.history;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.faults.history.Event.ArbitratorEnded;
import io.troupe.faults.history.Event.ArbitratorStarted;
import io.troupe.faults.history.Event.Broken;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.Connected;
import io.troupe.faults.history.Event.Disconnected;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.DriverFaultKind;
import io.troupe.faults.history.Event.FaultEnded;
import io.troupe.faults.history.Event.LeaseLost;
import io.troupe.faults.history.Event.Paused;
import io.troupe.faults.history.Event.Rolled;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Each violation of robot services is planted in a good history, and found. */
class DriverRulesTest {
    private static final String MISSING = "MissingServiceException";

    private final List<Entry> entries = new ArrayList<>();

    DriverRulesTest() {
        at(0, "m-1", new ArbitratorStarted());
    }

    private DriverRulesTest at(long millis, String process, Event event) {
        entries.add(new Entry(millis * 1_000_000, process, event));
        return this;
    }

    /** One service of a provider drives robot 0. */
    private DriverRulesTest drives(String process, int drive, long fromMillis, long toMillis) {
        for (long millis = fromMillis; millis <= toMillis; millis += 100) {
            command(millis, process, drive, true);
        }
        return this;
    }

    private DriverRulesTest command(long millis, String process, int drive, boolean moving) {
        return at(millis, process, new Commanded(0, drive, "wallFollower", moving));
    }

    private DriverRulesTest rolls(long fromMillis, long toMillis) {
        return ticks(fromMillis, toMillis, true);
    }

    private DriverRulesTest ticks(long fromMillis, long toMillis, boolean moving) {
        for (long millis = fromMillis; millis <= toMillis; millis += 100) {
            at(millis, "w-1", new Rolled(millis * 1_000, 0, moving));
        }
        return this;
    }

    private DriverRulesTest fault(DriverFaultKind kind, String target, long fromMillis, long toMillis) {
        at(fromMillis, "suite", new DriverFaultBegan(1, kind, target, ""));
        at(fromMillis + 1, "suite", new Broken(1));
        return at(toMillis, "suite", new FaultEnded(1));
    }

    private void assertBroken(Rule... rules) {
        assertThat(HistoryChecker.check(new History(entries)))
                .extracting(Violation::rule)
                .containsExactlyInAnyOrder(rules);
    }

    @Test
    void driverThatIsKilled_andFollowedByAnotherOne() {
        drives("a-1", 0, 1_010, 2_010).rolls(1_100, 2_500);
        ticks(2_600, 4_200, false);
        fault(DriverFaultKind.KILL_DRIVER, "a", 2_050, 4_000);
        drives("b-1", 0, 4_210, 5_010).rolls(4_300, 5_500);
        assertBroken();
        assertThat(HistoryChecker.worstStopMillis(new History(entries))).isEqualTo(500);
        assertThat(HistoryChecker.nextDriverMillis(new History(entries)))
                .containsEntry(DriverFaultKind.KILL_DRIVER, 2_200L);
    }

    @Test
    void robotThatDoesNotStop() {
        drives("a-1", 0, 1_010, 2_010).rolls(1_100, 2_700);
        assertBroken(Rule.STANDS);
    }

    @Test
    void robotThatDoesNotStop_unlessTheWorldWasPaused() {
        drives("a-1", 0, 1_010, 2_010).rolls(1_100, 2_700).at(2_400, "w-1", new Paused(150_000_000));
        assertBroken();
    }

    @Test
    void robotThatMovesWithoutAnyDriver() {
        rolls(1_100, 1_100);
        assertBroken(Rule.STANDS);
    }

    @Test
    void robotWithTwoDrivers() {
        drives("a-1", 0, 1_000, 2_000).drives("b-1", 0, 1_950, 2_500);
        assertBroken(Rule.ONE_DRIVER);
    }

    @Test
    void robotWithTwoDrivers_oneOfWhichWasFrozen_andSendsOnlyZero() {
        drives("a-1", 0, 1_000, 2_000).drives("b-1", 0, 4_500, 9_000).command(7_020, "a-1", 0, false);
        assertBroken(Rule.ONE_DRIVER);
    }

    @Test
    void robotWithOneDriverAfterTheOther() {
        drives("a-1", 0, 1_000, 2_000).drives("b-1", 0, 2_100, 3_000).drives("a-1", 1, 3_100, 4_000);
        assertBroken();
    }

    @Test
    void robotThatHasNoDriverForTooLong() {
        drives("a-1", 0, 1_000, 2_000).drives("b-1", 0, 7_600, 8_000);
        assertBroken(Rule.DRIVEN_AGAIN);
    }

    @Test
    void robotThatHasNoDriverForTooLong_butWhoseProviderWasPaused() {
        drives("a-1", 0, 1_000, 2_000).drives("b-1", 0, 7_600, 8_000);
        at(4_000, "b-1", new Paused(200_000_000));
        assertBroken();
    }

    @Test
    void robotWhoseDriverIsCutOff_doesNotCountAsDriven() {
        drives("a-1", 0, 1_000, 4_000);
        fault(DriverFaultKind.CUT_DRIVER, "a", 2_050, 9_000);
        drives("b-1", 0, 7_700, 8_000);
        assertBroken(Rule.DRIVEN_AGAIN);
    }

    @Test
    void timeWithoutServer_doesNotCount() {
        drives("a-1", 0, 1_000, 4_000);
        fault(DriverFaultKind.FREEZE_SERVER, "s", 2_050, 7_050);
        at(5_000, "m-1", new Disconnected()).at(7_500, "m-1", new Connected());
        drives("b-1", 0, 12_900, 13_000);
        assertBroken();
        drives("a-1", 1, 18_700, 19_000);
        assertBroken(Rule.DRIVEN_AGAIN);
    }

    @Test
    void providerThatDrivesOn_withoutItsArbitrator() {
        drives("a-1", 0, 1_000, 4_200);
        fault(DriverFaultKind.FREEZE_ARBITRATOR, "m", 2_050, 7_050);
        assertBroken(Rule.LEASE);
    }

    @Test
    void providerThatDrivesOn_untilItsLeaseIsOver() {
        drives("a-1", 0, 1_000, 4_000);
        fault(DriverFaultKind.CUT_ARBITRATOR, "m", 2_050, 7_050);
        at(4_010, "a-1", new LeaseLost(0, 0)).command(4_011, "a-1", 0, false);
        assertBroken();
    }

    @Test
    void providerThatDrives_afterItsLeaseIsOver() {
        drives("a-1", 0, 1_000, 2_000).at(2_050, "a-1", new LeaseLost(0, 0)).command(2_100, "a-1", 0, true);
        assertBroken(Rule.LEASE);
    }

    @Test
    void providerThatSendsZero_longAfterItsLeaseIsOver() {
        drives("a-1", 0, 1_000, 2_000).at(2_050, "a-1", new LeaseLost(0, 0)).command(2_400, "a-1", 0, false);
        assertBroken(Rule.LEASE);
    }

    @Test
    void arbitratorThatEnds_whenThereIsNoProvider() {
        drives("a-1", 0, 1_000, 2_000);
        fault(DriverFaultKind.KILL_ALL_PROVIDERS, "a,b,c", 2_050, 12_000);
        at(7_500, "m-1", new ArbitratorEnded(MISSING, "no provider"));
        assertBroken();
    }

    @Test
    void arbitratorThatDoesNotEnd_althoughThereIsNoProvider() {
        drives("a-1", 0, 1_000, 2_000);
        fault(DriverFaultKind.KILL_ALL_PROVIDERS, "a,b,c", 2_050, 12_000);
        assertBroken(Rule.CLEAR_END);
    }

    @Test
    void arbitratorThatEnds_althoughThereAreProviders() {
        drives("a-1", 0, 1_000, 9_000);
        fault(DriverFaultKind.KILL_DRIVER, "a", 9_050, 12_000);
        at(9_500, "m-1", new ArbitratorEnded(MISSING, "no provider"));
        assertBroken(Rule.CLEAR_END);
    }

    @Test
    void arbitratorThatEnds_withAnErrorThatIsNotClear() {
        fault(DriverFaultKind.KILL_ALL_PROVIDERS, "a,b,c", 2_050, 12_000);
        at(7_500, "m-1", new ArbitratorEnded("NullPointerException", "null"));
        assertBroken(Rule.CLEAR_END);
    }
}
