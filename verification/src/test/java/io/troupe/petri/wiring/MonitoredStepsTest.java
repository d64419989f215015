package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/**
 * Programs of each kind of step that do what is declared, programs that were changed in one place, and declarations
 * from which one step was removed.
 */
class MonitoredStepsTest {
    private static ProtocolEvent e(Kind kind, String component, String what) {
        return new ProtocolEvent(kind, component, what);
    }

    private static List<ProtocolEvent> calls(String component, String target) {
        return List.of(
                e(Kind.ASKED, component, target),
                e(Kind.TAKEN, component, target),
                e(Kind.ANSWERED, component, target));
    }

    private static WiringMonitor follow(WiringBuilder wiring, List<ProtocolEvent> events) {
        var monitor = WiringMonitor.of(wiring.build());
        events.forEach(monitor::on);
        return monitor;
    }

    private static void requireAllowed(WiringBuilder wiring, List<ProtocolEvent> events) {
        var monitor = follow(wiring, events);
        monitor.idle();
        assertThat(monitor.violation()).isEmpty();
    }

    /** The problem after a change: the first violation must be at the last event. */
    private static String problem(WiringBuilder wiring, List<ProtocolEvent> events) {
        var monitor = follow(wiring, events);
        assertThat(monitor.count()).as("events before the one that is wrong").isEqualTo(events.size() - 1);
        return monitor.violation().orElseThrow().problem();
    }

    private static List<ProtocolEvent> with(List<ProtocolEvent> events, ProtocolEvent... more) {
        var all = new ArrayList<>(events);
        all.addAll(List.of(more));
        return all;
    }

    /** Each step of the declaration that these events need is missed if it is removed; the others are returned. */
    private static List<String> unused(WiringBuilder builder, List<ProtocolEvent> events) {
        var runs = new Conformance(builder.build(), Set.of());
        runs.add(events);
        assertThat(runs.problems()).isEmpty();
        assertThat(runs.used())
                .isNotEmpty()
                .allSatisfy(step ->
                        assertThat(runs.without(step)).as(step.toString()).isPresent());
        return runs.unused().stream().map(Object::toString).toList();
    }

    // ---- mailboxes

    private static final ProtocolEvent NOTE_1 = e(Kind.SENT, "node1", "node2.note");
    private static final ProtocolEvent NOTE_2 = e(Kind.SENT, "node2", "node1.note");
    private static final ProtocolEvent READ_1 = e(Kind.RECEIVED, "node1", "note");
    private static final ProtocolEvent READ_2 = e(Kind.RECEIVED, "node2", "note");

    @Test
    void messages_intoAMailboxThatBlocks() {
        var all = List.of(NOTE_1, NOTE_2, NOTE_1, NOTE_2, READ_1, READ_1, READ_2, READ_2);
        requireAllowed(DeclarationsTest.mail(2, Overflow.BLOCK), all);
        assertThat(unused(DeclarationsTest.mail(2, Overflow.BLOCK), all)).isEmpty();
        assertThat(problem(DeclarationsTest.mail(1, Overflow.BLOCK), List.of(NOTE_1, NOTE_1)))
                .isEqualTo("node1 sends node2.note is not allowed: node2's mailbox [note]");
        assertThat(problem(DeclarationsTest.mail(2, Overflow.BLOCK), List.of(NOTE_1, READ_2)))
                .as("received before all are sent")
                .contains("node2 is in \"first\", where it may send node1.note");
    }

    @Test
    void messages_intoAMailboxThatRejects() {
        var lost = e(Kind.REFUSED, "node1", "node2.note");
        var mail = DeclarationsTest.mail(1, Overflow.REJECT);
        assertThat(follow(mail, List.of(NOTE_1, lost)).violation()).isEmpty();
        assertThat(problem(mail, List.of(NOTE_1, NOTE_1))).contains("node2's mailbox [note]");
        assertThat(problem(mail, List.of(lost))).contains("node1 sends node2.note, which is rejected is not allowed");
    }

    @Test
    void messages_intoAMailboxThatDropsTheOldest() {
        var mail = DeclarationsTest.mail(1, Overflow.DROP_OLDEST);
        var once = List.of(NOTE_1, NOTE_1, NOTE_2, NOTE_2, READ_2);
        assertThat(follow(mail, once).violation()).isEmpty();
        assertThat(problem(mail, with(once, READ_2)))
                .as("the first message was dropped")
                .isEqualTo("node2 receives note is not allowed: node2's mailbox []");
    }

    @Test
    void message_thatIsNeverReceived_isFoundWhenNothingHappensAnyMore() {
        var monitor = follow(DeclarationsTest.mail(2, Overflow.BLOCK), List.of(NOTE_1));
        monitor.idle();
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo("node2's mailbox [note], and nothing happens any more");
    }

    @Test
    void deadlock_isFoundAtTheEventThatLeadsIntoIt() {
        assertThat(problem(DeclarationsTest.mail(1, Overflow.BLOCK), List.of(NOTE_1, NOTE_2)))
                .isEqualTo("after this nothing is possible any more: node1 is in \"second\", node2 is in \"second\"");
    }

    // ---- time-outs and late answers

    private static WiringBuilder impatient() {
        var client = Protocol.of("client")
                .state("idle", requests("planner.plan").then("satisfied").orTimeout("disappointed"))
                .state("satisfied", requests("planner.praise").then("idle"))
                .state("disappointed", requests("planner.plan").then("idle"));
        var planner = Protocol.of("planner")
                .state(
                        "ready",
                        provides("plan").then("ready"),
                        provides("praise").then("ready"));
        return Wiring.of("impatient").component(client.build()).component(planner.build());
    }

    @Test
    void timeOuts_andLateAnswers() {
        var asks = e(Kind.ASKED, "client", "planner.plan");
        var takes = e(Kind.TAKEN, "client", "planner.plan");
        var gives = e(Kind.TIMED_OUT, "client", "planner.plan");
        var late = e(Kind.ANSWERED, "client", "planner.plan");
        var all = with(
                List.of(asks, takes, gives, late),
                calls("client", "planner.plan").toArray(ProtocolEvent[]::new));
        requireAllowed(impatient(), all);
        assertThat(unused(impatient(), all)).hasSize(2).allMatch(step -> step.contains("praise"));
        // no caller waits for the late answer, so it need not be seen
        requireAllowed(
                impatient(), with(List.of(asks, takes, gives), all.subList(4, 7).toArray(ProtocolEvent[]::new)));
        assertThat(problem(impatient(), List.of(asks, gives, takes)))
                .as("a request that was withdrawn is executed")
                .startsWith("planner takes plan from client is not allowed: client is in \"disappointed\"");
        assertThat(problem(impatient(), List.of(asks, takes, gives, late, late)))
                .as("answered twice")
                .isNotEmpty();
        assertThat(problem(impatient(), List.of(asks, takes, gives, late, e(Kind.ASKED, "client", "planner.praise"))))
                .as("a late answer is taken for one in time")
                .contains("client is in \"disappointed\", where it may ask planner.plan");
    }

    @Test
    void questions_thatAreGivenUp() {
        var asks = e(Kind.ASKED, "client", "planner.plan");
        var takes = e(Kind.TAKEN, "client", "planner.plan");
        var answers = e(Kind.ANSWERED, "client", "planner.plan");
        var gets = e(Kind.GOT_ANSWER, "client", "planner.plan");
        var givesUp = e(Kind.GAVE_UP, "client", "planner.plan");
        var all = List.of(asks, takes, answers, gets, asks, takes, givesUp, asks, takes, answers, gets);
        requireAllowed(DeclarationsTest.late(true), all);
        assertThat(unused(DeclarationsTest.late(true), all)).isEmpty();
        assertThat(problem(DeclarationsTest.late(true), List.of(asks, takes, gets)))
                .as("an answer before it was given")
                .isEqualTo("client gets the answer of planner.plan is not allowed: client's question planner.plan is"
                        + " served");
        assertThat(problem(DeclarationsTest.late(false), List.of(asks, takes, asks)))
                .as("a second question while the first is open")
                .contains("client's question planner.plan is served");
        var monitor = follow(DeclarationsTest.late(true), List.of(asks));
        monitor.idle();
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo("client's question planner.plan is not taken, and nothing happens any more");
    }

    // ---- calls that are answered later

    @Test
    void calls_thatAreAnsweredAfterOthers() {
        var asks = e(Kind.ASKED, "a", "b.help");
        var takes = e(Kind.TAKEN, "a", "b.help");
        var nested = e(Kind.ASKED, "b", "a.state");
        assertThat(problem(DeclarationsTest.help(false), List.of(asks, takes, nested)))
                .isEqualTo("after this nothing is possible any more: a waits for the answer of b.help, b waits for"
                        + " a.state, which is not accepted yet");
        assertThat(problem(DeclarationsTest.help(true), List.of(asks, takes, nested)))
                .as("declared as answered at once")
                .isEqualTo("b asks a.state is not allowed: b answers help to a, where it may answer help");
        var desk = DeclarationsTest.desk(true);
        var one = e(Kind.ASKED, "client1", "desk.order");
        var two = e(Kind.ASKED, "client2", "desk.order");
        var takesOne = e(Kind.TAKEN, "client1", "desk.order");
        var takesTwo = e(Kind.TAKEN, "client2", "desk.order");
        var answersOne = e(Kind.ANSWERED, "client1", "desk.order");
        var refusesTwo = e(Kind.REJECTED, "client2", "desk.order");
        var all = with(
                List.of(one, two, takesOne, takesTwo, answersOne, refusesTwo),
                calls("client2", "desk.hours").toArray(ProtocolEvent[]::new));
        requireAllowed(desk, all);
        assertThat(unused(desk, all))
                .containsExactly(
                        "client1: \"refused\" requests desk.hours \"idle\"",
                        "desk: \"looking\" provides hours \"looking\"",
                        "desk: \"decided\" answers order \"free\"");
        assertThat(problem(DeclarationsTest.desk(false), List.of(one, two, takesOne, takesTwo)))
                .as("a second one is not accepted")
                .contains("desk is in \"decided\" or is in \"looking\"");
        assertThat(problem(desk, List.of(one, takesOne, answersOne, answersOne)))
                .as("answered twice")
                .isNotEmpty();
        var gives = e(Kind.TIMED_OUT, "client1", "desk.order");
        requireAllowed(desk, List.of(one, takesOne, gives, answersOne));
        requireAllowed(desk, List.of(one, takesOne, gives, one, takesOne, answersOne));
        assertThat(problem(desk, List.of(one, gives, takesOne)))
                .as("accepted after it was withdrawn")
                .isNotEmpty();
        var monitor = follow(desk, List.of(one, takesOne));
        monitor.idle();
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo("client1 waits for the answer of desk.order, and nothing happens any more");
    }

    // ---- callbacks as streams

    @Test
    void streams() {
        var opens = List.of(e(Kind.ASKED, "viewer", "camera.frames"), e(Kind.TAKEN, "viewer", "camera.frames"));
        var emits = e(Kind.EMITTED, "camera", "frames");
        var gets = e(Kind.GOT_ANSWER, "viewer", "camera.frames");
        var finishes = e(Kind.FINISHED, "camera", "frames");
        var ends = e(Kind.GOT_END, "viewer", "camera.frames");
        var frames = DeclarationsTest.frames(3);
        var adjusts = calls("viewer", "camera.adjust").toArray(ProtocolEvent[]::new);
        var shown = with(opens, emits, emits, emits, gets, finishes);
        var all = with(with(with(shown, adjusts), gets), adjusts);
        all = with(with(with(all, gets), adjusts), ends);
        requireAllowed(frames, all);
        assertThat(unused(frames, all)).isEmpty();
        assertThat(problem(frames, with(opens, emits, gets, e(Kind.ASKED, "viewer", "camera.adjust"), gets)))
                .as("an item that arrives twice")
                .contains("viewer waits for camera.adjust");
        assertThat(problem(frames, with(opens, gets)))
                .as("an item before it was sent")
                .contains("is a stream");
        assertThat(problem(frames, with(shown, ends)))
                .as("an end before the last items")
                .contains("viewer is in");
        assertThat(problem(DeclarationsTest.frames(1), with(opens, emits, emits)))
                .as("more items than the window")
                .contains("viewer's question camera.frames has an item");
    }

    // ---- holders of resources

    @Test
    void holders() {
        var hands = DeclarationsTest.hands("arm", "camera");
        var takesArm = e(Kind.ACQUIRED, "robot", "arm");
        var takesCamera = e(Kind.ACQUIRED, "robot", "camera");
        var all = List.of(takesArm, takesCamera, e(Kind.RELEASED, "robot", "camera"), e(Kind.RELEASED, "robot", "arm"));
        requireAllowed(hands, all);
        assertThat(unused(hands, all)).as("those of the other component").hasSize(4);
        assertThat(problem(hands, List.of(takesArm, e(Kind.ACQUIRED, "other", "arm"))))
                .as("two hold the arm")
                .isEqualTo("other takes arm is not allowed: not: arm is free");
        assertThat(problem(hands, List.of(takesCamera)))
                .as("in the wrong order")
                .contains("robot is in \"idle\"");
        assertThat(problem(
                        DeclarationsTest.hands("camera", "arm"),
                        List.of(takesArm, e(Kind.ACQUIRED, "other", "camera"))))
                .as("a deadlock")
                .startsWith("after this nothing is possible any more");
    }

    // ---- components that wait

    /** The decision is no event; a program that reports it is found at once, and without it is not known to wait. */
    @Test
    void component_thatWaitsForAResource_isSeenWhenNothingHappensAnyMore() {
        var tools = DeclarationsTest.tools(false);
        var one = e(Kind.ACQUIRED, "worker1", "tool");
        var two = e(Kind.ACQUIRED, "worker2", "tool");
        var waits = e(Kind.WAITS, "worker1", "tool");
        requireAllowed(tools, List.of(one, two)); // each may put its tool back
        var monitor = follow(tools, List.of(one, two, waits));
        monitor.idle();
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo("worker1 waits for tool, which worker1 and worker2 hold, and nothing happens any more");
        assertThat(problem(tools, List.of(one, two, waits, e(Kind.WAITS, "worker2", "tool"))))
                .isEqualTo("after this nothing is possible any more: worker1 waits for tool, which worker1 and worker2"
                        + " hold, worker2 waits for tool, which worker1 and worker2 hold");
        assertThat(problem(tools, List.of(one, waits, e(Kind.RELEASED, "worker1", "tool"))))
                .as("something else after the decision")
                .contains("worker1 waits for tool, which worker1 holds, where it may take tool");
        var never = WiringMonitor.of(tools.build());
        never.never("both hold one", Map.of("worker1", Set.of("one"), "worker2", Set.of("one")));
        never.on(one);
        never.on(two);
        assertThat(never.violation().orElseThrow().problem())
                .startsWith("both hold one: worker1 is in \"one\" or waits");
        // one that can do nothing else waits without a report, and may report it
        var hands = DeclarationsTest.hands("arm", "camera");
        for (var more : List.of(List.<ProtocolEvent>of(), List.of(e(Kind.WAITS, "other", "arm")))) {
            var idle =
                    follow(hands, with(List.of(e(Kind.ACQUIRED, "robot", "arm")), more.toArray(ProtocolEvent[]::new)));
            idle.idle();
            assertThat(idle.violation().orElseThrow().problem())
                    .isEqualTo("other waits for arm, which robot holds, and nothing happens any more");
        }
    }

    @Test
    void component_thatWaitsForAMailboxAWindowOrAnAnswer_isSeenWhenNothingHappensAnyMore() {
        assertThat(idle(DeclarationsTest.mail(2, Overflow.BLOCK), List.of(NOTE_1, NOTE_1, NOTE_2, READ_1)))
                .as("a mailbox with room")
                .isEqualTo("node2's mailbox [note, note], and nothing happens any more");
        assertThat(idle(
                        DeclarationsTest.gossip(false),
                        List.of(e(Kind.SENT, "node1", "node2.news"), e(Kind.WAITS, "node1", "node2.news"))))
                .isEqualTo("node1 waits for room to send news to node2, whose mailbox holds [news], and nothing happens"
                        + " any more");
        var opens = List.of(e(Kind.ASKED, "viewer", "camera.frames"), e(Kind.TAKEN, "viewer", "camera.frames"));
        var emits = e(Kind.EMITTED, "camera", "frames");
        assertThat(idle(DeclarationsTest.frames(1), with(opens, emits)))
                .isEqualTo("camera waits for room to emit frames, and nothing happens any more");
        assertThat(idle(DeclarationsTest.live(false), with(opens, emits, e(Kind.WAITS, "camera", "frames"))))
                .isEqualTo("camera waits for room to emit frames, and nothing happens any more");
        assertThat(idle(
                        DeclarationsTest.again(false),
                        List.of(
                                e(Kind.ASKED, "client", "planner.plan"),
                                e(Kind.TAKEN, "client", "planner.plan"),
                                e(Kind.WAITS, "client", "planner.plan"))))
                .isEqualTo("client waits to ask planner.plan again, since its question is still open, and nothing"
                        + " happens any more");
    }

    private static String idle(WiringBuilder wiring, List<ProtocolEvent> events) {
        var monitor = follow(wiring, events);
        assertThat(monitor.violation()).isEmpty();
        monitor.idle();
        return monitor.violation().orElseThrow().problem();
    }

    // ---- components that end

    @Test
    void componentThatEnds_andItsServers_areIdle_andItDoesNothingMore() {
        var session = DeclarationsTest.session(true);
        var logsIn = calls("client", "server.login");
        var saves = calls("server", "store.save");
        var all = new ArrayList<>(logsIn);
        all.add(e(Kind.ASKED, "client", "server.logout"));
        all.add(e(Kind.TAKEN, "client", "server.logout"));
        all.addAll(saves);
        all.add(e(Kind.ANSWERED, "client", "server.logout"));
        requireAllowed(session, all);
        assertThat(unused(session, all)).isEmpty();
        assertThat(follow(session, all).describe("client")).isEqualTo("client has ended in \"over\" or is in \"over\"");
        assertThat(problem(session, with(all, e(Kind.ASKED, "client", "server.login"))))
                .as("something after the end")
                .contains("where it may do nothing");
    }

    // ---- failures and restarts

    @Test
    void failures_andRestarts() {
        var plans = DeclarationsTest.plans(true);
        var takesMap = e(Kind.ACQUIRED, "planner", "map");
        var asks = e(Kind.ASKED, "client", "planner.plan");
        var takes = e(Kind.TAKEN, "client", "planner.plan");
        var answers = e(Kind.ANSWERED, "client", "planner.plan");
        var fails = e(Kind.FAILED, "planner", "");
        var rejects = e(Kind.REJECTED, "client", "planner.plan");
        var givesBack = e(Kind.RELEASED, "planner", "map");
        var all = List.of(takesMap, asks, takes, fails, asks, rejects, asks, takesMap, takes, answers, givesBack);
        requireAllowed(plans, all);
        assertThat(unused(plans, all)).isEmpty();
        assertThat(problem(plans, List.of(takesMap, asks, takes, fails, answers)))
                .as("an answer after the failure")
                .isNotEmpty();
        assertThat(problem(plans, List.of(takesMap, fails, asks, takes)))
                .as("accepted without a restart, or without the map")
                .contains("planner takes plan from client is not allowed");
        assertThat(problem(plans, List.of(takesMap, asks, rejects)))
                .as("rejected without a failure")
                .isNotEmpty();
        assertThat(problem(plans, List.of(takesMap, fails, givesBack)))
                .as("what it holds is given back twice")
                .contains("planner is in \"down\"");
    }

    @Test
    void failure_ofAWorker_keepsItsMailbox() {
        var goes = e(Kind.SENT, "boss", "worker.go");
        var receives = e(Kind.RECEIVED, "worker", "go");
        var fails = e(Kind.FAILED, "worker", "");
        var work = DeclarationsTest.work(false);
        assertThat(follow(work, List.of(fails, goes, receives, e(Kind.SENT, "worker", "boss.done")))
                        .violation())
                .isEmpty();
        assertThat(problem(work, List.of(goes, receives, fails, e(Kind.SENT, "worker", "boss.done"))))
                .as("the message that it had taken is lost")
                .contains("worker is in \"down\" or is in \"idle\"");
    }

    @Test
    void openMessages_comeFromOutside() {
        var lamp = Protocol.of("lamp")
                .state("off", Protocol.receives("on").then("shining"))
                .state("shining", does("burn out").then("off"));
        var wiring = Wiring.of("lamp").component(lamp.build()).mailbox("lamp", 1, Overflow.BLOCK);
        wiring.open("lamp.on");
        var arrives = e(Kind.ARRIVED, "lamp", "on");
        requireAllowed(wiring, List.of(arrives, e(Kind.RECEIVED, "lamp", "on")));
        assertThat(problem(wiring, List.of(arrives, arrives))).contains("lamp's mailbox [on]");
    }
}
