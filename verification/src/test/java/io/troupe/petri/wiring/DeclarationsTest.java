package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refusals;
import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.cancels;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.emits;
import static io.troupe.petri.wiring.Protocol.finished;
import static io.troupe.petri.wiring.Protocol.finishes;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.rejected;
import static io.troupe.petri.wiring.Protocol.rejects;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.sends;
import static io.troupe.petri.wiring.Protocol.stops;
import static io.troupe.petri.wiring.Protocol.streams;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import org.junit.jupiter.api.Test;

/** For each kind of declaration a wiring that deadlocks, with its story, and the change that prevents it. */
class DeclarationsTest {
    private static String story(WiringBuilder wiring) {
        var result = WiringCheck.check(wiring.build());
        assertThat(result).isInstanceOf(Deadlock.class);
        return ((Deadlock) result).counterexample().sentence();
    }

    private static void requireProved(WiringBuilder wiring) {
        assertThat(WiringCheck.check(wiring.build())).isInstanceOf(Proved.class);
    }

    // ---- a call that is offered in several states

    private static WiringBuilder server(boolean answersWhileBusy) {
        var server = Protocol.of("server")
                .state(
                        "ready",
                        provides("start").then("busy"),
                        provides("status").then("ready"));
        if (answersWhileBusy) {
            server.state(
                    "busy", provides("done").then("ready"), provides("status").then("busy"));
        } else {
            server.state("busy", provides("done").then("ready"));
        }
        var worker = Protocol.of("worker")
                .state("idle", requests("server.start").then("working"))
                .state("working", requests("server.status").then("finishing"))
                .state("finishing", requests("server.done").then("idle"));
        return Wiring.of("status").component(server.build()).component(worker.build());
    }

    @Test
    void call_thatIsOfferedInOneState_deadlocks_inSeveralItDoesNot() {
        assertThat(story(server(false)))
                .isEqualTo(
                        "server (busy) waits to be called: done by worker, which no component will do; worker waits for"
                                + " server.status, which no component will answer");
        requireProved(server(true));
    }

    // ---- a call whose caller goes on

    private static WiringBuilder pictures(boolean waits) {
        var camera = Protocol.of("camera")
                .state(
                        "idle",
                        does("take a picture").then("holding"),
                        provides("pause").then("idle"));
        if (waits) {
            camera.state("holding", requests("store.keep").then("idle"));
        } else {
            camera.state(
                            "holding",
                            asks("store.keep").then("waiting"),
                            provides("pause").then("holding"))
                    .state(
                            "waiting",
                            answered("store.keep").then("idle"),
                            provides("pause").then("waiting"));
        }
        var store = Protocol.of("store")
                .state("open", provides("keep").then("checking"))
                .state(
                        "checking",
                        does("find room").then("open"),
                        does("find none").then("full"))
                .state("full", requests("camera.pause").then("open"));
        return Wiring.of("pictures").component(camera.build()).component(store.build());
    }

    @Test
    void callerThatWaits_deadlocks_oneThatGoesOnAnswersOthersMeanwhile() {
        assertThat(story(pictures(true)))
                .isEqualTo("camera waits for store.keep; store waits for camera.pause: all ask and none answers");
        requireProved(pictures(false));
    }

    // ---- time-outs and late answers

    private static WiringBuilder ring(boolean timesOut) {
        var patient = Protocol.of("node")
                .state(
                        "idle",
                        requests("next.take").then("idle"),
                        provides("take").then("idle"))
                .build();
        var impatient = Protocol.of("node")
                .state(
                        "idle",
                        requests("next.take").then("idle").orTimeout("idle"),
                        provides("take").then("idle"))
                .build();
        return Wiring.of("ring")
                .components("node", 3, timesOut ? impatient : patient)
                .bindEach("node", "next", i -> "node" + (i % 3 + 1));
    }

    @Test
    void ring_thatDeadlocks_goesOnAfterATimeOut() {
        assertThat(story(ring(false))).contains("node3 waits for node1.take: all ask and none answers");
        requireProved(ring(true));
    }

    static WiringBuilder late(boolean givesUp) {
        var forgetful = Protocol.of("client")
                .state("idle", asks("planner.plan").then("waiting"))
                .state(
                        "waiting",
                        answered("planner.plan").then("idle"),
                        does("time out").then("idle"))
                .build();
        var tidy = Protocol.of("client")
                .state("idle", asks("planner.plan").then("waiting"))
                .state(
                        "waiting",
                        answered("planner.plan").then("idle"),
                        cancels("planner.plan").then("idle"))
                .build();
        var planner = Protocol.of("planner").state("ready", provides("plan").then("ready"));
        return Wiring.of("late").component(givesUp ? tidy : forgetful).component(planner.build());
    }

    @Test
    void lateAnswer_thatNoStateTakes_blocksTheNextQuestion_unlessItIsGivenUp() {
        assertThat(story(late(false)))
                .isEqualTo(
                        "client waits for planner.plan, which no component will answer; planner (ready) waits to be called:"
                                + " plan by client, which no component will do");
        requireProved(late(true));
    }

    // ---- one-way messages into bounded mailboxes

    static WiringBuilder mail(int capacity, Overflow overflow) {
        var node = Protocol.of("node")
                .state("first", sends("other.note").then("second"))
                .state("second", sends("other.note").then("reading"))
                .state("reading", receives("note").then("reading on"))
                .state("reading on", receives("note").then("first"))
                .build();
        return Wiring.of("mail")
                .components("node", 2, node)
                .bindEach("node", "other", i -> "node" + (3 - i))
                .mailbox("node1", capacity, overflow)
                .mailbox("node2", capacity, overflow);
    }

    @Test
    void mailboxes_thatAreTooSmall_deadlockInEachWay_largerOnesDoNot() {
        assertThat(story(mail(1, Overflow.BLOCK)))
                .isEqualTo(
                        "node1 waits for room to send note to node2, which has not taken [note]; node2 waits for room"
                                + " to send note to node1, which has not taken [note]");
        for (var losing : new Overflow[] {Overflow.REJECT, Overflow.DROP_OLDEST}) {
            assertThat(story(mail(1, losing)))
                    .contains("node1 (reading on) waits for the message note from node2, its mailbox holds []");
        }
        for (var overflow : Overflow.values()) {
            requireProved(mail(2, overflow));
        }
    }

    private static WiringBuilder orders(boolean ignoresStop) {
        var boss = Protocol.of("boss")
                .state(
                        "calm",
                        sends("worker.go").then("waiting"),
                        sends("worker.stop").then("calm"))
                .state("waiting", receives("done").then("calm"));
        var worker = Protocol.of("worker");
        if (ignoresStop) {
            worker.state(
                    "idle", receives("go").then("working"), receives("stop").then("idle"));
        } else {
            worker.state("idle", receives("go").then("working"));
        }
        worker.state("working", does("drive").then("driving"), receives("stop").then("idle"))
                .state("driving", sends("boss.done").then("idle"));
        return Wiring.of("orders")
                .component(boss.build())
                .component(worker.build())
                .mailbox("boss", 1, Overflow.BLOCK)
                .mailbox("worker", 2, Overflow.BLOCK);
    }

    @Test
    void message_thatTheStateDoesNotReceive_holdsUpTheMailbox() {
        assertThat(story(orders(false)))
                .isEqualTo(
                        "boss (waiting) waits for the message done from worker, its mailbox holds []; worker (idle) waits"
                                + " for the message go from boss, its mailbox holds [stop, go]");
        requireProved(orders(true));
    }

    // ---- callbacks as streams

    static WiringBuilder frames(int window) {
        var camera = Protocol.of("camera")
                .state("idle", streams("frames").then("one"), provides("adjust").then("idle"))
                .state("one", emits("frames").then("two"))
                .state("two", emits("frames").then("three"))
                .state("three", emits("frames").then("over"))
                .state("over", finishes("frames").then("idle"));
        var viewer = Protocol.of("viewer")
                .state("dark", asks("camera.frames").then("watching"))
                .state(
                        "watching",
                        answered("camera.frames").then("adjusting"),
                        finished("camera.frames").then("dark"))
                .state("adjusting", requests("camera.adjust").then("watching"));
        return Wiring.of("frames")
                .component(viewer.build())
                .component(camera.build())
                .window("camera.frames", window);
    }

    @Test
    void stream_whoseSubscriberCallsItsProvider_deadlocksWhenTheWindowIsFull() {
        assertThat(story(frames(1)))
                .isEqualTo(
                        "viewer waits for camera.adjust, which no component will answer; camera waits for room to send"
                                + " frames to viewer, which has not taken [frames]");
        requireProved(frames(2));
    }

    /** What a subscriber that leaves has not taken is dropped, and the next subscriber gets the stream. */
    @Test
    void stream_thatIsCancelled_isFreeForTheNext() {
        var camera = Protocol.of("camera")
                .state("idle", streams("frames").then("on"))
                .state("on", emits("frames").then("on"), finishes("frames").then("idle"));
        var viewer = Protocol.of("viewer")
                .state("dark", asks("camera.frames").then("watching"))
                .state(
                        "watching",
                        answered("camera.frames").then("watching"),
                        finished("camera.frames").then("dark"),
                        cancels("camera.frames").then("dark"));
        requireProved(Wiring.of("zapping")
                .components("viewer", 2, viewer.build())
                .component(camera.build())
                .window("camera.frames", 2));
    }

    // ---- holders of resources

    static WiringBuilder hands(String first, String second) {
        var robot = Protocol.of("robot")
                .state("idle", acquires("arm").then("armed"))
                .state("armed", acquires("camera").then("working"))
                .state("working", releases("camera").then("done"))
                .state("done", releases("arm").then("idle"));
        var other = Protocol.of("other")
                .state("idle", acquires(first).then("begun"))
                .state("begun", acquires(second).then("working"))
                .state("working", releases(first).then("done"))
                .state("done", releases(second).then("idle"));
        return Wiring.of("hands")
                .component(robot.build())
                .component(other.build())
                .resource("arm", 1)
                .resource("camera", 1);
    }

    @Test
    void resources_inTwoOrders_deadlock_inOneOrderTheyDoNot() {
        assertThat(story(hands("camera", "arm")))
                .isEqualTo("robot waits for camera, which other holds; other waits for arm, which robot holds");
        requireProved(hands("arm", "camera"));
    }

    // ---- equal components

    static WiringBuilder table(int seats, boolean isLastLeftHanded) {
        var philosopher = Protocol.of("phil")
                .state("thinking", acquires("left").then("hungry"))
                .state("hungry", acquires("right").then("eating"))
                .state("eating", releases("left").then("full"))
                .state("full", releases("right").then("thinking"))
                .build();
        return Wiring.of("table")
                .components("phil", seats, philosopher)
                .resources("fork", seats)
                .bindEach("phil", "left", i -> "fork" + (isLastLeftHanded && i == seats ? 1 : i))
                .bindEach("phil", "right", i -> "fork" + (isLastLeftHanded && i == seats ? i : i % seats + 1));
    }

    @Test
    void equalComponents_inACircle_deadlock_oneThatDiffersPreventsIt() {
        var circle = ((Deadlock) WiringCheck.check(table(7, false).build())).counterexample();
        assertThat(circle.circle()).hasSize(7).allMatch(Wait.Resource.class::isInstance);
        assertThat(circle.sentence())
                .startsWith("phil1 waits for fork2, which phil2 holds; phil2 waits for fork3, which phil3 holds;");
        requireProved(table(7, true));
    }

    // ---- failures and restarts

    static WiringBuilder work(boolean isPatient) {
        var boss = Protocol.of("boss").state("calm", sends("worker.go").then("waiting"));
        if (isPatient) {
            boss.state("waiting", receives("done").then("calm"));
        } else {
            boss.state(
                    "waiting", receives("done").then("calm"), does("time out").then("calm"));
        }
        var worker = Protocol.of("worker")
                .state("idle", receives("go").then("working"))
                .state("working", sends("boss.done").then("idle"))
                .state("down", does("restart").then("idle"))
                .failsTo("down");
        return Wiring.of("work")
                .component(boss.build())
                .component(worker.build())
                .mailbox("boss", 1, Overflow.DROP_OLDEST)
                .mailbox("worker", 1, Overflow.DROP_OLDEST);
    }

    /** The failure after the message was taken loses it: the worker comes up again, but never answers. */
    @Test
    void failure_thatLosesAMessage_blocksTheOneThatWaitsForItsAnswer() {
        var blocked = (WiringResult.Blocked) WiringCheck.check(work(true).build());
        assertThat(blocked.counterexample().toString())
                .contains("boss (waiting) waits for the message done from worker, its mailbox holds []")
                .contains("worker fails (in working)");
        requireProved(work(false));
    }

    static WiringBuilder plans(boolean takesRejection) {
        var planner = Protocol.of("planner")
                .state("ready", acquires("map").then("reading"))
                .state("reading", provides("plan").then("read"))
                .state("read", releases("map").then("ready"))
                .state("down", rejects("plan").then("down"), does("restart").then("ready"))
                .failsTo("down");
        var client = Protocol.of("client")
                .state("idle", requests("planner.plan").then("idle").orRejected("idle"));
        if (!takesRejection) {
            client =
                    Protocol.of("client").state("idle", requests("planner.plan").then("idle"));
        }
        return Wiring.of("plans")
                .component(planner.build())
                .component(client.build())
                .resource("map", 1);
    }

    /** The failure rejects the request and releases the map, so that the restarted planner can read it again. */
    @Test
    void failure_rejectsTheRequestAndReleasesWhatIsHeld() {
        requireProved(plans(true));
        assertThatThrownBy(() -> plans(false).build())
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(
                        "wiring plans: client requests planner.plan in state idle, which planner may reject; expected"
                                + " orRejected(STATE)");
    }

    @Test
    void failureOfACaller_withdrawsItsQuestions_andRejectsItsStream() {
        var gateway = Protocol.of("gateway")
                .state(
                        "idle",
                        asks("planner.plan").then("asked"),
                        streams("news").then("idle"))
                .state("asked", answered("planner.plan").then("telling"))
                .state("telling", emits("news").then("idle"))
                .failsTo("idle");
        var reader = Protocol.of("reader")
                .state("out", asks("gateway.news").then("reading"))
                .state(
                        "reading",
                        answered("gateway.news").then("reading"),
                        rejected("gateway.news").then("out"));
        var planner = Protocol.of("planner").state("ready", provides("plan").then("ready"));
        requireProved(Wiring.of("gateway")
                .component(gateway.build())
                .component(reader.build())
                .component(planner.build()));
    }

    // ---- declarations that are refused

    private static ProtocolBuilder p(String state, Branch... branches) {
        return Protocol.of("p").state(state, branches);
    }

    @Test
    void protocols_thatMakeNoSense_areRefused() {
        assertThat(refusals(
                        p("a", acquires("arm").then("a"))::build,
                        p("a", releases("arm").then("a"))::build,
                        p("a", acquires("arm").then("b"))
                                .state("b", releases("arm").then("a"), stops())::build,
                        p("a", answered("q.call").then("a"))::build,
                        p("a", emits("news").then("a"))::build,
                        p("a", streams("x").then("b")).state("b", provides("x").then("a"))::build,
                        p("a", does("x").then("a")).failsTo("down")::build,
                        () -> p("a", does("x").then("a")).failsTo("a").failsTo("a"),
                        () -> p("a", sends("note").then("a"))))
                .isEqualTo("""
                protocol p: state a is reached holding [arm] and holding []; expected the same resources on every way \
                there
                protocol p: state a releases arm, but it holds [] there; expected a resource that it acquired before
                protocol p: state b stops holding [arm]; expected releases before the stop
                protocol p: state a takes or cancels an answer of q.call, which is never asked; there are none
                protocol p: state a emits or finishes news, which is no stream; expected streams("news") in a state
                protocol p: call x is answered once in state b and is a stream elsewhere; expected one of the two
                protocol p: a failure leads to state down, which is not declared; known: a
                protocol p: failsTo is declared twice, expected one state
                protocol p: state a sends note, expected component.message""");
        assertThatThrownBy(() -> does("x").then("a").orTimeout("b"))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("\"does x\" never times out; expected a step of [requests]");
    }

    @Test
    void wirings_thatMakeNoSense_areRefused() {
        var receiver = p("a", receives("note").then("a")).build();
        var taker = p("a", acquires("arm").then("b"))
                .state("b", releases("arm").then("a"))
                .build();
        var stream = Protocol.of("s")
                .state("a", streams("x").then("a"), finishes("x").then("a"))
                .build();
        var caller = p("a", asks("s.x").then("b"))
                .state("b", answered("s.x").then("a"))
                .build();
        assertThat(refusals(
                        Wiring.of("w").component(receiver).open("p.note")::build,
                        Wiring.of("w").component(receiver).mailbox("p", 1, Overflow.BLOCK)::build,
                        Wiring.of("w").component(receiver).open("p.note").mailbox("p", 1000, Overflow.BLOCK)::build,
                        Wiring.of("w").component(taker)::build,
                        Wiring.of("w").component(taker).resource("arm", 1).mailbox("p", 1, Overflow.BLOCK)::build,
                        Wiring.of("w").component(stream).component(caller)::build,
                        Wiring.of("w").component(stream).open("s.x").window("s.y", 2)::build,
                        () -> Wiring.of("w").resource("arm", 0),
                        () -> Wiring.of("w").bindEach("phil", "left", i -> "fork" + i)))
                .isEqualTo("""
                wiring w: p receives [note], but its mailbox has no capacity; expected mailbox("p", 1, Overflow.BLOCK) \
                or another one
                wiring w: p receives note, but no component sends it; send it, or declare p.note open
                wiring w: the mailbox of p with a capacity of 1000 for [note] has more than 1000 contents; expected a \
                smaller capacity
                wiring w: p acquires arm, but there is no resource arm; there are none
                wiring w: p has a mailbox, but receives nothing; expected a state that receives a message
                wiring w: p asks s.x in state a, but no state takes what may come back; expected finished("s.x")
                wiring w: window of s.y is not a stream; did you mean s.x? known: s.x
                wiring w: resource arm has 0 units, expected 1 or more
                wiring w: there is no component phil1; expected components("phil", ..) before""");
    }
}
