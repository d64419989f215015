package io.troupe.petri.wiring;

import static io.troupe.petri.Nets.refusals;
import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.cancels;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.emits;
import static io.troupe.petri.wiring.Protocol.ends;
import static io.troupe.petri.wiring.Protocol.finished;
import static io.troupe.petri.wiring.Protocol.finishes;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.refuses;
import static io.troupe.petri.wiring.Protocol.rejected;
import static io.troupe.petri.wiring.Protocol.rejects;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.sends;
import static io.troupe.petri.wiring.Protocol.stops;
import static io.troupe.petri.wiring.Protocol.streams;
import static io.troupe.petri.wiring.Protocol.tries;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

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

    // ---- a call that is answered later

    /** Two that help each other: {@code b} needs the state of {@code a} to help it. */
    static WiringBuilder help(boolean answersFirst) {
        var a = Protocol.of("a")
                .state("idle", does("work").then("helping"))
                .state("helping", requests("b.help").then("helped"))
                .state("helped", provides("state").then("idle"));
        var b = Protocol.of("b");
        if (answersFirst) {
            b.state("idle", provides("help").then("asking"))
                    .state("asking", requests("a.state").then("idle"));
        } else {
            b = helper();
        }
        return Wiring.of("help").component(a.build()).component(b.build());
    }

    private static ProtocolBuilder helper() {
        var b = Protocol.of("b")
                .state("idle", accepts("help").then("asking"))
                .state("asking", requests("a.state").then("knowing"))
                .state("knowing", answers("help").then("idle"));
        return b;
    }

    /** The sample of {@link Protocol#accepts}. */
    @Test
    void cache_thatAsksItsServer_answersLater() {
        var cache = Protocol.of("cache")
                .state("idle", accepts("get").then("looking"))
                .state(
                        "looking",
                        does("find it").then("found"),
                        requests("server.get").then("found"))
                .state("found", answers("get").then("idle"))
                .build();
        var client = Protocol.of("client").state("idle", requests("cache.get").then("idle"));
        var server = Protocol.of("server").state("ready", provides("get").then("ready"));
        requireProved(
                Wiring.of("caching").component(client.build()).component(cache).component(server.build()));
    }

    @Test
    void call_thatIsAnsweredAfterACallOfItsOwn_deadlocks_oneThatIsAnsweredAtOnceDoesNot() {
        assertThat(story(help(false))).isEqualTo("a waits for b.help; b waits for a.state: all ask and none answers");
        requireProved(help(true));
    }

    /** Each asks the next one while it serves a call: in a ring, or from a first one to a last one. */
    private static WiringBuilder nested(int nodes, boolean isRing) {
        var first = Protocol.of("node")
                .state("idle", does("want something").then("asking"))
                .state("asking", requests("next.help").then("idle"))
                .build();
        var node = Protocol.of("node");
        if (isRing) {
            node.state(
                            "idle",
                            does("want something").then("asking"),
                            accepts("help").then("asked"))
                    .state("asking", requests("next.help").then("idle"));
        } else {
            node.state("idle", accepts("help").then("asked"));
        }
        node.state("asked", requests("next.help").then("helped"))
                .state("helped", answers("help").then("idle"));
        var last =
                Protocol.of("node").state("idle", provides("help").then("idle")).build();
        return nodes(nodes, isRing, first, node.build(), last);
    }

    /** The same by messages: a request is one, and so is its answer. */
    private static WiringBuilder nestedByMessages(int nodes, boolean isRing) {
        var first = Protocol.of("node")
                .state("idle", does("want something").then("sending"))
                .state("sending", sends("next.help").then("asking"))
                .state("asking", receives("answer").then("idle"))
                .build();
        var node = Protocol.of("node");
        if (isRing) {
            node.state(
                            "idle",
                            does("want something").then("sending"),
                            receives("help").then("asked"))
                    .state("sending", sends("next.help").then("asking"))
                    .state("asking", receives("answer").then("idle"));
        } else {
            node.state("idle", receives("help").then("asked"));
        }
        node.state("asked", sends("next.help").then("waiting"))
                .state("waiting", receives("answer").then("helped"))
                .state("helped", sends("before.answer").then("idle"));
        var last = Protocol.of("node")
                .state("idle", receives("help").then("helped"))
                .state("helped", sends("before.answer").then("idle"))
                .build();
        var wiring = nodes(nodes, isRing, first, node.build(), last);
        for (var i = 1; i <= nodes; i++) {
            wiring.mailbox("node" + i, 2, Overflow.BLOCK);
            if (isRing || i > 1) {
                wiring.bind("node" + i, "before", "node" + (i == 1 ? nodes : i - 1));
            }
        }
        return wiring;
    }

    private static WiringBuilder nodes(int nodes, boolean isRing, Protocol first, Protocol node, Protocol last) {
        var wiring = Wiring.of(nodes + " nodes");
        for (var i = 1; i <= nodes; i++) {
            wiring.component("node" + i, isRing ? node : i == 1 ? first : i == nodes ? last : node);
            if (isRing || i < nodes) {
                wiring.bind("node" + i, "next", "node" + (i % nodes + 1));
            }
        }
        return wiring;
    }

    @ParameterizedTest
    @CsvSource({"2, true", "3, true", "4, true", "2, false", "3, false"})
    void nestedCalls_inARing_deadlock_asTheirMessagesDo(int nodes, boolean isRing) {
        var byCalls = WiringCheck.check(nested(nodes, isRing).build());
        var byMessages = WiringCheck.check(nestedByMessages(nodes, isRing).build());
        assertThat(byCalls).isInstanceOf(isRing ? Deadlock.class : Proved.class).hasSameClassAs(byMessages);
        if (byCalls instanceof Deadlock deadlock) {
            assertThat(deadlock.counterexample().circle()).hasSize(nodes);
            assertThat(deadlock.counterexample().sentence()).endsWith("all ask and none answers");
        }
    }

    /** A call that is accepted and refused, by a component that others may ask meanwhile. */
    static WiringBuilder desk(boolean takesOthers) {
        var desk = Protocol.of("desk")
                .state(
                        "free",
                        accepts("order").then("looking"),
                        provides("hours").then("free"));
        var looks = does("look").then("decided");
        if (takesOthers) {
            desk.state(
                            "looking",
                            looks,
                            accepts("order").then("two"),
                            provides("hours").then("looking"))
                    .state("two", answers("order").then("looking"));
        } else {
            desk.state("looking", looks);
        }
        desk.state("decided", answers("order").then("free"), refuses("order").then("free"));
        var client = Protocol.of("client")
                .state(
                        "idle",
                        requests("desk.order")
                                .then("idle")
                                .orRejected("refused")
                                .orTimeout("idle"))
                .state("refused", requests("desk.hours").then("idle"));
        return Wiring.of("desk").components("client", 2, client.build()).component(desk.build());
    }

    @Test
    void calls_thatAreAccepted_areRefused_givenUp_andAnsweredInAnyOrder() {
        requireProved(desk(false));
        requireProved(desk(true));
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

    // ---- steps that wait: a component that has chosen one stays with it, unless it tries

    /** Each of two workers holds one of two tools, and may want the other one, or put its own back. */
    static WiringBuilder tools(boolean tries) {
        var more = acquires("tool");
        var worker = Protocol.of("worker")
                .state("idle", acquires("tool").then("one"))
                .state(
                        "one",
                        (tries ? tries(more) : more).then("two"),
                        releases("tool").then("idle"))
                .state("two", releases("tool").then("one"))
                .build();
        return Wiring.of("tools").components("worker", 2, worker).resource("tool", 2);
    }

    @Test
    void resource_thatIsChosenBesideAnotherStep_isWaitedFor_unlessItIsTried() {
        assertThat(story(tools(false)))
                .isEqualTo("worker1 waits for tool, which worker2 holds; worker2 waits for tool, which worker1 holds");
        assertThat(((Deadlock) WiringCheck.check(tools(false).build()))
                        .counterexample()
                        .firings())
                .containsExactly(
                        "worker1 takes tool (in idle)",
                        "worker1 decides to take tool (in one)",
                        "worker2 takes tool (in idle)",
                        "worker2 decides to take tool (in one)");
        requireProved(tools(true));
    }

    static WiringBuilder gossip(boolean tries) {
        var tells = sends("other.news");
        var node = Protocol.of("node")
                .state(
                        "run",
                        (tries ? tries(tells) : tells).then("run"),
                        receives("news").then("run"))
                .build();
        return Wiring.of("gossip")
                .components("node", 2, node)
                .bindEach("node", "other", i -> "node" + (3 - i))
                .mailbox("node1", 1, Overflow.BLOCK)
                .mailbox("node2", 1, Overflow.BLOCK);
    }

    @Test
    void message_thatIsChosenBesideAnotherStep_waitsForRoom_unlessItIsTried() {
        assertThat(story(gossip(false)))
                .isEqualTo("node1 waits for room to send news to node2, which has not taken [news]; node2 waits for"
                        + " room to send news to node1, which has not taken [news]");
        requireProved(gossip(true));
    }

    static WiringBuilder live(boolean tries) {
        var shows = emits("frames");
        var camera = Protocol.of("camera")
                .state("off", streams("frames").then("on"))
                .state(
                        "on",
                        (tries ? tries(shows) : shows).then("on"),
                        provides("adjust").then("on"));
        var viewer = Protocol.of("viewer")
                .state("dark", asks("camera.frames").then("watching"))
                .state("watching", answered("camera.frames").then("adjusting"))
                .state("adjusting", requests("camera.adjust").then("watching"));
        return Wiring.of("live").component(camera.build()).component(viewer.build());
    }

    @Test
    void item_thatIsChosenBesideAnotherStep_waitsForTheWindow_unlessItIsTried() {
        assertThat(story(live(false)))
                .isEqualTo("camera waits for room to send frames to viewer, which has not taken [frames]; viewer waits"
                        + " for camera.adjust, which no component will answer");
        requireProved(live(true));
    }

    /** The second question waits for the answer to the first, which only another state takes. */
    static WiringBuilder again(boolean tries) {
        var asksAgain = asks("planner.plan");
        var client = Protocol.of("client")
                .state("idle", asks("planner.plan").then("waiting"))
                .state(
                        "waiting",
                        answered("planner.plan").then("idle"),
                        (tries ? tries(asksAgain) : asksAgain).then("waiting"));
        var planner = Protocol.of("planner").state("ready", provides("plan").then("ready"));
        return Wiring.of("again").component(client.build()).component(planner.build());
    }

    @Test
    void question_thatIsAskedAgainBesideAnotherStep_waitsForItsAnswer_unlessItIsTried() {
        assertThat(story(again(false)))
                .isEqualTo("client waits for planner.plan, which no component will answer; planner (ready) waits to be"
                        + " called: plan by client, which no component will do");
        requireProved(again(true));
    }

    /** Nothing is added where a step cannot have to wait, or is the only one. */
    @Test
    void choice_isNoStepOfItsOwn_whereNothingHasToBeWaitedFor() {
        assertThat(gossip(false).build().net().transitions()).hasSize(6);
        var node = Protocol.of("node")
                .state("run", sends("other.news").then("run"), receives("news").then("run"))
                .build();
        var dropping = Wiring.of("gossip")
                .components("node", 2, node)
                .bindEach("node", "other", i -> "node" + (3 - i))
                .mailbox("node1", 1, Overflow.DROP_OLDEST)
                .mailbox("node2", 1, Overflow.DROP_OLDEST)
                .build();
        assertThat(dropping.net().transitions())
                .hasSize(6)
                .noneMatch(transition -> transition.name().contains("decides"));
        assertThat(pictures(false).build().net().transitions())
                .as("a question that is asked once")
                .noneMatch(transition -> transition.name().contains("decides"));
    }

    // ---- components that end

    /** A client that makes two calls and ends; the server calls a store, which only it calls. */
    static WiringBuilder session(boolean looksAfter) {
        var client = Protocol.of("client")
                .state("new", requests("server.login").then("known"))
                .state("known", requests("server.logout").then("over"))
                .state("over", ends());
        var server = Protocol.of("server")
                .state("idle", provides("login").then("open"))
                .state("open", accepts("logout").then("saving"));
        if (looksAfter) {
            server.state("saving", requests("store.save").then("saved"));
        } else {
            server.state("saving", requests("store.save").then("asking"))
                    .state("asking", requests("client.why").then("saved"));
        }
        server.state("saved", answers("logout").then("idle"));
        if (!looksAfter) {
            client = Protocol.of("client")
                    .state("new", requests("server.login").then("known"))
                    .state("known", requests("server.logout").then("why"))
                    .state("why", provides("why").then("over"))
                    .state("over", ends());
        }
        var store = Protocol.of("store").state("ready", provides("save").then("ready"));
        return Wiring.of("session")
                .component(client.build())
                .component(server.build())
                .component(store.build());
    }

    @Test
    void componentsThatEnd_andThoseThatOnlyTheyCall_areNoBlock() {
        requireProved(session(true));
        assertThat(story(session(false)))
                .isEqualTo("client waits for server.logout; server waits for client.why: all ask and none answers");
    }

    /** In more ways than there is room for, but nothing calls them that ends. */
    @Test
    void manyServersThatCallEachOther_areNotLeft_ifNoneOfTheirCallersEnds() {
        var node = Protocol.of("node")
                .state(
                        "idle",
                        provides("ping").then("hit"),
                        requests("next.ping").then("idle"))
                .state("hit", provides("ping").then("idle"))
                .build();
        var once = Protocol.of("once")
                .state("new", does("begin").then("over"))
                .state("over", ends())
                .build();
        var wiring = Wiring.of("ring")
                .components("node", 10, node)
                .bindEach("node", "next", i -> "node" + (i % 10 + 1))
                .component(once)
                .build();
        assertThat(WiringCheck.check(wiring, 1_000)).isInstanceOf(Deadlock.class);
    }

    /** Servers that call each other are left together; with another client, or one that never ends, they go on. */
    @Test
    void serversThatCallEachOther_areLeftWhenTheirClientsHaveEnded() {
        var client = Protocol.of("client")
                .state("new", requests("a.get").then("over"))
                .state("over", ends())
                .build();
        var busy = Protocol.of("busy").state("on", requests("b.put").then("on")).build();
        var a = Protocol.of("a")
                .state("idle", accepts("get").then("asked"), receives("full").then("idle"))
                .state("asked", requests("b.put").then("put"))
                .state("put", answers("get").then("idle"))
                .build();
        var b = Protocol.of("b")
                .state("idle", provides("put").then("telling"))
                .state("telling", sends("a.full").then("idle"))
                .build();
        requireProved(Wiring.of("servers")
                .components("client", 2, client)
                .component(a)
                .component(b)
                .mailbox("a", 1, Overflow.DROP_OLDEST));
        var closed =
                Protocol.of("b").state("idle", provides("put").then("idle")).build();
        var alone = Protocol.of("a")
                .state("idle", accepts("get").then("asked"))
                .state("asked", requests("b.put").then("put"))
                .state("put", answers("get").then("idle"))
                .build();
        requireProved(Wiring.of("closed")
                .components("client", 2, client)
                .component(alone)
                .component(closed));
        requireProved(Wiring.of("busy")
                .component(client)
                .component(busy)
                .component(alone)
                .component(closed));
    }

    /**
     * One that waits for another that has ended waits for ever; so does one that two others have left in the middle.
     */
    @Test
    void componentThatWaitsForOneThatHasEnded_isADeadlock() {
        var early = Protocol.of("worker")
                .state("idle", provides("work").then("tired"))
                .state("tired", does("go home").then("home"), provides("work").then("tired"))
                .state("home", ends());
        var boss = Protocol.of("boss")
                .state("new", requests("worker.work").then("more"))
                .state("more", requests("worker.work").then("over"))
                .state("over", ends());
        assertThat(story(Wiring.of("work").component(early.build()).component(boss.build())))
                .isEqualTo("boss waits for worker.work, which no component will answer");
        var half = Protocol.of("server")
                .state("free", provides("begin").then("busy"))
                .state("busy", does("wait").then("stuck"))
                .state("stuck", acquires("lock").then("held"))
                .state("held", releases("lock").then("free"));
        var keeper = Protocol.of("keeper")
                .state("a", acquires("lock").then("b"))
                .state("b", provides("ask").then("c"))
                .state("c", releases("lock").then("a"));
        var client = Protocol.of("client")
                .state("new", requests("server.begin").then("ask"))
                .state("ask", requests("keeper.ask").then("over"))
                .state("over", ends());
        assertThat(story(Wiring.of("half")
                        .component(client.build())
                        .component(half.build())
                        .component(keeper.build())
                        .resource("lock", 1)))
                .contains("server waits for lock, which keeper holds");
    }

    /**
     * The client has ended, but a message of it waits, or the server may do something else: then it gives back the lock
     * that another waits for.
     */
    @ParameterizedTest
    @ValueSource(strings = {"message", "private step", "open call"})
    void server_thatMayStillDoSomething_isNotLeft(String what) {
        var client = Protocol.of("client")
                .state(
                        "new",
                        what.equals("message")
                                ? sends("server.job").then("over")
                                : requests("server.get").then("over"))
                .state("over", ends());
        var server = Protocol.of("server").state("new", acquires("lock").then("idle"));
        switch (what) {
            case "message" -> server.state("idle", receives("job").then("tidying"));
            case "private step" ->
                server.state("idle", provides("get").then("idle"), does("tidy").then("tidying"));
            default ->
                server.state(
                        "idle", provides("get").then("idle"), provides("tidy").then("tidying"));
        }
        server.state("tidying", releases("lock").then("rest"));
        if (what.equals("message")) {
            server.state("rest", receives("job").then("rest"));
        } else {
            server.state("rest", provides("get").then("rest"));
        }
        var other = Protocol.of("other")
                .state("new", acquires("lock").then("working"))
                .state("working", releases("lock").then("over"))
                .state("over", ends());
        var wiring = Wiring.of("lock")
                .component(client.build())
                .component(server.build())
                .component(other.build())
                .resource("lock", 1);
        switch (what) {
            case "message" -> wiring.mailbox("server", 1, Overflow.BLOCK);
            case "open call" -> wiring.open("server.tidy");
            default -> {}
        }
        requireProved(wiring);
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

    /** Both calls that a server has accepted are rejected when it fails; one of them was given up before. */
    @Test
    void failure_rejectsTheCallsThatWereAccepted() {
        var server = Protocol.of("server")
                .state("idle", accepts("get").then("one"))
                .state("one", accepts("get").then("two"), answers("get").then("idle"))
                .state("two", answers("get").then("one"))
                .state("down", does("restart").then("idle"))
                .failsTo("down")
                .build();
        var client = Protocol.of("client")
                .state("idle", requests("server.get").then("idle").orRejected("idle"))
                .build();
        var hasty = Protocol.of("hasty")
                .state("idle", asks("server.get").then("waiting"))
                .state(
                        "waiting",
                        answered("server.get").then("idle"),
                        rejected("server.get").then("idle"),
                        cancels("server.get").then("idle"))
                .build();
        requireProved(Wiring.of("accepted").component(server).component(client).component(hasty));
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
                        () -> p("a", does("x").then("b"), ends()),
                        p("a", acquires("arm").then("b")).state("b", ends())::build,
                        p("a", accepts("x").then("b"))
                                .state("b", does("y").then("c"), answers("x").then("a"))
                                .state("c", ends())::build,
                        p("a", answers("x").then("a"))::build,
                        p("a", accepts("x").then("b")).state("b", does("y").then("b"))::build,
                        p("a", accepts("x").then("b"))
                                .state("b", answers("x").then("a"), does("y").then("a"))::build,
                        p("a", accepts("x").then("b")).state("b", answers("x").then("a"), stops())::build,
                        () -> p("a", does("x").then("a")).failsTo("a").failsTo("a"),
                        () -> p("a", sends("note").then("a"))))
                .isEqualTo("""
                protocol p: state a is reached holding [arm] and holding []; expected the same on every way there
                protocol p: state a releases arm, but it holds [] there; expected a resource that it acquired before
                protocol p: state b stops holding [arm]; expected releases before the stop
                protocol p: state a takes or cancels an answer of q.call, which is never asked; there are none
                protocol p: state a emits or finishes news, which is no stream; expected streams("news") in a state
                protocol p: call x is answered once in state b and is a stream elsewhere; expected one of the two
                protocol p: a failure leads to state down, which is not declared; known: a
                protocol p: state a ends and has other ways out; expected ends() alone
                protocol p: state b ends holding [arm]; expected releases before the end
                protocol p: state c ends owing the answers of [x]; expected answers before the end
                protocol p: state a answers x, but it owes the answers of [] there; expected accepts("x") before
                protocol p: state a accepts x, which no state answers or refuses; expected answers("x") in a later state
                protocol p: state a is reached owing the answers of [x] and owing the answers of []; expected the same \
                on every way there
                protocol p: state b stops owing the answers of [x]; expected answers before the stop
                protocol p: failsTo is declared twice, expected one state
                protocol p: state a sends note, expected component.message""");
        assertThatThrownBy(() -> does("x").then("a").orTimeout("b"))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("\"does x\" never times out; expected a step of [requests]");
        assertThatThrownBy(() -> tries(requests("q.call")))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage(
                        "\"requests q.call\" never waits and can be tried; expected a step of [acquires, asks, emits,"
                                + " sends]");
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
                        Wiring.of("w")
                                .component(p(
                                                "a",
                                                asks("q.x").then("over"),
                                                does("y").then("b"))
                                        .state("b", answered("q.x").then("a"))
                                        .state("over", ends())
                                        .build())
                                .component(Protocol.of("q")
                                        .state("a", provides("x").then("a"))
                                        .build())::build,
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
                wiring w: p ends in state over, where its questions [q.x] may be open; expected to take what comes back, \
                or cancels(..), before
                wiring w: resource arm has 0 units, expected 1 or more
                wiring w: there is no component phil1; expected components("phil", ..) before""");
    }
}
