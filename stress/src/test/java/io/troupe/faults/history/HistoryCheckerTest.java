package io.troupe.faults.history;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.faults.history.Event.CallKind;
import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Closed;
import io.troupe.faults.history.Event.Delivered;
import io.troupe.faults.history.Event.Executed;
import io.troupe.faults.history.Event.FirstArrival;
import io.troupe.faults.history.Event.Lost;
import io.troupe.faults.history.Event.Memory;
import io.troupe.faults.history.Event.Moved;
import io.troupe.faults.history.Event.Opened;
import io.troupe.faults.history.Event.Paused;
import io.troupe.faults.history.Event.Published;
import io.troupe.faults.history.Event.Reason;
import io.troupe.faults.history.Event.Sent;
import io.troupe.faults.history.Event.Settled;
import io.troupe.faults.history.Event.StreamEnded;
import io.troupe.faults.history.Event.StreamItem;
import io.troupe.faults.history.Event.StreamOpened;
import io.troupe.faults.history.Event.Surprise;
import io.troupe.faults.history.Event.Unsent;
import io.troupe.faults.history.History.Entry;
import io.troupe.faults.history.Violation.Rule;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Each violation is planted in a good history, and found. */
class HistoryCheckerTest {
    private final List<Entry> entries = new ArrayList<>();

    private HistoryCheckerTest at(long millis, String process, Event event) {
        entries.add(new Entry(millis * 1_000_000, process, event));
        return this;
    }

    private void assertBroken(Rule... rules) {
        assertThat(HistoryChecker.check(new History(entries)))
                .extracting(Violation::rule)
                .containsExactlyInAnyOrder(rules);
    }

    private HistoryCheckerTest call(CallKind kind) {
        return at(1_000, "a-1", new Called("a-1.1", "tool-b", kind, 700, 4_000));
    }

    private static Settled answered() {
        return new Settled("a-1.1", true, true, "answered");
    }

    private static Settled failed(boolean mayBeSent) {
        return new Settled("a-1.1", false, mayBeSent, "failed");
    }

    // ---- calls

    @Test
    void calls_thatKeepTheRules() {
        call(CallKind.SHORT).at(1_001, "b-1", new Executed("a-1.1")).at(1_002, "a-1", answered());
        at(1_003, "a-1", new Called("a-1.2", "tool-b", CallKind.ONE_WAY, 700, 4_000));
        at(1_004, "a-1", new Called("a-1.3", "tool-b", CallKind.LONG, 700, 4_000));
        at(1_704, "a-1", new Settled("a-1.3", false, true, "timeout"));
        at(1_705, "c-1", new Called("c-1.1", "tool-b", CallKind.LONG, 700, 4_000)); // its process is killed
        at(9_000, "a-1", new Memory(1 << 20));
        assertBroken();
    }

    @Test
    void callThatIsSettledTwice() {
        call(CallKind.SHORT).at(1_001, "b-1", new Executed("a-1.1"));
        at(1_002, "a-1", answered()).at(1_003, "a-1", failed(true));
        assertBroken(Rule.SETTLED_ONCE);
    }

    @Test
    void callThatIsNeverSettled_whileItsProcessLivesOn() {
        call(CallKind.SHORT).at(2_100, "a-1", new Memory(1));
        assertBroken();
        at(2_300, "a-1", new Memory(1));
        assertBroken(Rule.SETTLED_ONCE);
    }

    @Test
    void callThatIsSettledTooLate_unlessItsProcessDidNotRun() {
        call(CallKind.SHORT).at(2_300, "a-1", failed(true));
        assertBroken(Rule.SETTLED_IN_TIME);
        at(2_200, "a-1", new Paused(600_000_000));
        assertBroken();
    }

    @Test
    void callThatIsExecutedTwice() {
        call(CallKind.ONE_WAY).at(1_001, "b-1", new Executed("a-1.1")).at(1_002, "c-1", new Executed("a-1.1"));
        assertBroken(Rule.EXECUTED_ONCE);
    }

    @Test
    void callThatIsExecuted_althoughItWasNotSent() {
        call(CallKind.SHORT).at(1_002, "a-1", failed(false)).at(1_003, "b-1", new Executed("a-1.1"));
        assertBroken(Rule.NOT_SENT);
    }

    @Test
    void callThatIsAnswered_butWasNotExecuted() {
        call(CallKind.SHORT).at(1_002, "a-1", answered());
        assertBroken(Rule.ANSWERED);
    }

    @Test
    void callThatIsExecutedLongAfterItsLimit() {
        call(CallKind.SHORT).at(1_700, "a-1", failed(true)).at(5_600, "b-1", new Executed("a-1.1"));
        assertBroken(Rule.NOT_LATE);
    }

    @Test
    void callThatAFrozenProcessExecutesAfterItsLimit() {
        call(CallKind.SHORT).at(1_700, "a-1", failed(true)).at(6_000, "b-1", new Paused(5_500_000_000L));
        at(6_001, "b-1", new Executed("a-1.1"));
        assertBroken(Rule.NOT_LATE);
    }

    @Test
    void callThatWasAcceptedBeforeItsProcessWasFrozen_isNotLate() {
        call(CallKind.SHORT).at(1_700, "a-1", failed(true)).at(6_000, "b-1", new Paused(4_900_000_000L));
        at(6_001, "b-1", new Executed("a-1.1"));
        assertBroken();
    }

    @Test
    void ownCallOfAProcessThatIsFrozenRightAfterIt_isNotLate() {
        call(CallKind.SHORT).at(6_000, "a-1", new Paused(5_001_000_000L)).at(6_001, "a-1", new Executed("a-1.1"));
        at(6_002, "a-1", answered());
        assertBroken();
    }

    @Test
    void callThatNobodyMade() {
        at(1_000, "b-1", new Executed("a-1.1"));
        assertBroken(Rule.SETTLED_ONCE);
    }

    // ---- streams

    private HistoryCheckerTest stream() {
        return at(1_000, "a-1", new StreamOpened("s", "tool-b", 2)).at(1_001, "a-1", new StreamItem("s", 1));
    }

    @Test
    void streams_thatKeepTheRules() {
        stream().at(1_002, "a-1", new StreamItem("s", 2)).at(1_003, "a-1", new StreamEnded("s", true, ""));
        at(1_004, "a-1", new StreamOpened("t", "tool-b", 5)).at(1_005, "a-1", new StreamEnded("t", false, "cancelled"));
        at(1_006, "a-1", new Closed());
        assertBroken();
    }

    @Test
    void streamWithoutAnEnd() {
        stream();
        assertBroken();
        at(9_000, "a-1", new Closed());
        assertBroken(Rule.STREAM);
    }

    @Test
    void streamWithAGap_withTooFewItems_orWithTwoEnds() {
        stream().at(1_002, "a-1", new StreamItem("s", 3));
        assertBroken(Rule.STREAM);
        entries.clear();
        stream().at(1_002, "a-1", new StreamEnded("s", true, ""));
        assertBroken(Rule.STREAM);
        entries.clear();
        stream().at(1_002, "a-1", new StreamEnded("s", false, "")).at(1_003, "a-1", new StreamEnded("s", false, ""));
        assertBroken(Rule.STREAM);
    }

    // ---- publications

    /** Of ten values two were not sent, one was replaced, two were missed, and five were delivered. */
    private HistoryCheckerTest publications() {
        at(100, "b-1", new Opened("b")).at(200, "a-1", new Opened("a"));
        for (int i = 1; i <= 10; i++) {
            at(1_000 + i, "a-1", new Published("t", i));
        }
        at(1_003, "a-1", new Unsent("t", 3)).at(1_004, "a-1", new Unsent("t", 4));
        at(1_005, "b-1", new FirstArrival("t", "a-1", 1));
        at(1_006, "b-1", new Delivered("t", "a-1", 2, 2, 10));
        at(1_011, "b-1", new Lost("t", "a-1", Reason.MISSED, 2));
        at(1_012, "b-1", new Lost("t", "a-1", Reason.REPLACED, 1));
        return at(1_013, "b-1", new Delivered("t", "a-1", 10, 3, 10));
    }

    private HistoryCheckerTest closed() {
        return at(9_000, "a-1", new Closed()).at(9_000, "b-1", new Closed());
    }

    @Test
    void publications_thatAreAllAccountedFor() {
        publications().closed();
        assertBroken();
    }

    @Test
    void valueThatIsLostWithoutAReport() {
        publications().at(1_014, "a-1", new Published("t", 11));
        assertBroken(); // as if it was on its way when a process was killed
        closed();
        assertBroken(Rule.COUNTED);
    }

    @Test
    void valueThatIsDeliveredTwice_alsoIfItsPublisherWasKilled() {
        publications().at(1_014, "b-1", new Delivered("t", "a-1", 10, 1, 10));
        assertBroken(Rule.COUNTED);
    }

    @Test
    void firstValues_count_ifTheyArePublishedAfterTheSubscriberBegan() {
        at(100, "b-1", new Opened("b")).at(200, "a-1", new Opened("a")).at(300, "a-1", new Published("t", 9));
        at(301, "b-1", new FirstArrival("t", "a-1", 9)).at(301, "b-1", new Delivered("t", "a-1", 9, 1, 10));
        assertBroken(Rule.COUNTED);
        entries.removeFirst();
        at(250, "b-1", new Opened("b"));
        assertBroken(); // as if a process was killed before the mark arrived
        closed();
        assertBroken(Rule.COUNTED);
        at(2_000, "b-1", new Lost("t", "a-1", Reason.MISSED, 8));
        assertBroken();
        entries.removeLast();
        entries.removeIf(entry -> entry.event() instanceof Opened);
        at(350, "b-1", new Opened("b"));
        assertBroken();
    }

    @Test
    void velocityThatIsTooOld() {
        at(1_000, "a-1", new Published("fresh/t", 1)).at(1_500, "b-1", new FirstArrival("fresh/t", "a-1", 1));
        at(1_500, "b-1", new Delivered("fresh/t", "a-1", 1, 1, 401_000));
        assertBroken(Rule.FRESH);
        at(1_400, "a-1", new Paused(301_000_000)); // frozen before it could publish
        assertBroken();
    }

    // ---- robots

    private void ticks(int first, int last, double turnRadps) {
        for (int tick = first; tick <= last; tick++) {
            at(1_000 + tick * 100, "world-1", new Moved(tick * 100_000, 0, turnRadps));
        }
    }

    @Test
    void robotThatStopsInTime_andOneThatDoesNot() {
        at(1_050, "a-1", new Sent(0, 0.25));
        ticks(1, 5, 0.25);
        ticks(6, 30, 0);
        assertBroken();
        assertThat(HistoryChecker.worstKeptMillis(new History(entries))).isEqualTo(500);
        assertThat(HistoryChecker.commands(new History(entries))).isEqualTo(1);
        entries.clear();
        ticks(1, 6, 0.25);
        assertBroken(Rule.STOPPED);
    }

    @Test
    void speedThatReachesARobotLate() {
        at(1_000, "a-1", new Sent(0, 0.25));
        ticks(4, 4, 0.25);
        assertBroken();
        entries.clear();
        at(1_000, "a-1", new Sent(0, 0.25));
        ticks(6, 6, 0.25);
        assertBroken(Rule.FRESH);
    }

    // ---- the rest

    @Test
    void memoryThatGrows_andSurprises() {
        at(1_000, "a-1", new Memory(65L << 20)).at(2_000, "suite", new Surprise("a-1 has ended"));
        assertBroken(Rule.MEMORY, Rule.SURPRISE);
    }

    @Test
    void violation_showsItsLines_inTheirOrder_butNotTooMany() {
        call(CallKind.ONE_WAY);
        for (int i = 1; i <= 14; i++) {
            at(1_000 + i, "b-1", new Executed("a-1.1"));
        }
        assertThat(HistoryChecker.check(new History(entries)).getFirst().toString())
                .startsWith(
                        "nothing is executed twice: call a-1.1\n    a-1 1000000000 Called call=a-1.1 target=tool-b kind=ONE_WAY limitMillis=700 executionMillis=4000\n    b-1 1001000000 Executed")
                .endsWith("and 3 more lines");
    }

    // ---- files

    @Test
    void history_isReadAsItWasWritten_withoutALineThatWasCutOff(@TempDir Path folder) throws IOException {
        var events = List.<Event>of(
                new Called("a-1.1", "tool of \"b\" = 1", CallKind.LONG, 700, 4_000),
                new Settled("a-1.1", false, true, "broken\nline %"),
                new Moved(7, 1, -1e-9));
        try (var writer = new History.Writer(folder, "a-1")) {
            events.forEach(writer::add);
        }
        Path file = folder.resolve("a-1.history");
        Files.writeString(file, "123 Settled call=a-", StandardOpenOption.APPEND);
        assertThat(History.read(folder).entries()).extracting(Entry::event).isEqualTo(events);
        assertThat(History.read(folder).entries()).extracting(Entry::process).containsOnly("a-1");
        Files.writeString(file, "\n", StandardOpenOption.APPEND);
        assertThatThrownBy(() -> History.read(folder)).hasMessage("a-1: \"123 Settled call=a-\" is no event");
    }
}
