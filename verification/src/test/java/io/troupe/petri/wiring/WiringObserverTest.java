package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.cancels;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.refuses;
import static io.troupe.petri.wiring.Protocol.rejects;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.sends;
import static java.util.Objects.requireNonNull;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CancellationException;
import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Actors that do what is declared, and others that do not. */
class WiringObserverTest {
    interface Client {
        void go();
    }

    interface Server {
        Promise<Integer> get();

        void put(int value);
    }

    private static Protocol server() {
        return Protocol.of("server", Server.class)
                .state("ready", provides("get").then("ready"))
                .build();
    }

    private static Wiring wiring(Branch... ofClient) {
        return Wiring.of("test")
                .component(Protocol.of("client").state("idle", ofClient).build())
                .component(server())
                .build();
    }

    private static class Serving extends Actor implements Server {
        @Override
        public Promise<Integer> get() {
            return Promise.of(1);
        }

        @Override
        public void put(int value) {}
    }

    private record Run(WiringMonitor monitor, List<String> events) {}

    /** Runs a client that calls its server, and returns what was reported of it. */
    private static Run run(Wiring wiring, String client, Function<Server, Object> step, Serving serving) {
        var monitor = WiringMonitor.of(wiring).keepingEvents();
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            Server server = test.spawn(Server.class, () -> serving);
            Client caller = test.spawn(Client.class, () -> () -> step.apply(server), ActorSettings.named(client));
            caller.go();
            test.runQueued();
            monitor.idle();
            test.takeProblems();
        }
        return new Run(
                monitor, monitor.events().stream().map(ProtocolEvent::toString).toList());
    }

    private static String problem(Run run) {
        return run.monitor().violation().orElseThrow().problem();
    }

    @Test
    void request_isAskedTakenAndAnswered_byActorsOfTheNamesOfComponents() {
        var run = run(wiring(requests("server.get").then("idle")), "client", Server::get, new Serving());
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client asks server.get", "server takes get from client", "server answers get to client");
    }

    interface Store {
        Promise<Integer> load();
    }

    /** A method that calls another actor before it answers: what it {@code provides} would be answered first. */
    @Test
    void methodThatCallsAnother_beforeItAnswers_acceptsTheCall() {
        var later = Protocol.of("server", Server.class)
                .state("ready", accepts("get").then("loading"))
                .state("loading", requests("store.load").then("loaded"))
                .state("loaded", answers("get").then("ready"))
                .build();
        nested(later).check();
        var atOnce = Protocol.of("server", Server.class)
                .state("ready", provides("get").then("loading"))
                .state("loading", requests("store.load").then("ready"))
                .build();
        assertThat(nested(atOnce).violation().orElseThrow().problem())
                .isEqualTo(
                        "server asks store.load is not allowed: server answers get to client, where it may answer get");
    }

    private static WiringMonitor nested(Protocol server) {
        var monitor = WiringMonitor.of(Wiring.of("nested")
                .component(Protocol.of("client")
                        .state("idle", requests("server.get").then("idle"))
                        .build())
                .component(server)
                .component(Protocol.of("store", Store.class)
                        .state("ready", provides("load").then("ready"))
                        .build())
                .build());
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            Store store = test.spawn(Store.class, () -> () -> Promise.of(1));
            Server serving = test.spawn(Server.class, () -> new Serving() {
                @Override
                public Promise<Integer> get() {
                    return store.load().thenApply(value -> value + 1);
                }
            });
            Client client = test.spawn(Client.class, () -> serving::get, ActorSettings.named("client"));
            client.go();
            test.runQueued();
            monitor.idle();
            test.takeProblems();
        }
        return monitor;
    }

    @Test
    void question_isAlsoTakenByItsCaller() {
        var wiring = Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", asks("server.get").then("waiting"))
                        .state("waiting", answered("server.get").then("idle"))
                        .build())
                .component(server())
                .build();
        var run = run(wiring, "client", Server::get, new Serving());
        run.monitor().check();
        assertThat(run.events()).endsWith("client gets the answer of server.get");
    }

    @Test
    void error_isARejection_ifOneIsDeclared() {
        class Failing extends Serving {
            @Override
            public Promise<Integer> get() {
                return Promise.failed(new IllegalStateException("no"));
            }
        }
        run(wiring(requests("server.get").then("idle")), "client", Server::get, new Failing())
                .monitor()
                .check();
        var wiring = Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", requests("server.get").then("idle").orRejected("idle"))
                        .build())
                .component(Protocol.of("server", Server.class)
                        .state(
                                "ready",
                                provides("get").then("ready"),
                                rejects("get").then("ready"))
                        .build())
                .build();
        var run = run(
                wiring,
                "client",
                server -> {
                    ActorSpace.of(server).stop(server);
                    return server.get();
                },
                new Serving());
        run.monitor().check();
        assertThat(run.events()).containsExactly("client asks server.get", "server rejects get of client");
    }

    @Test
    void requestThatIsCancelledInTheMailbox_isGivenUp() {
        var wiring = Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", asks("server.get").then("waiting"))
                        .state(
                                "waiting",
                                answered("server.get").then("idle"),
                                cancels("server.get").then("idle"))
                        .build())
                .component(server())
                .build();
        var run = run(wiring, "client", server -> server.get().cancel(), new Serving());
        run.monitor().check();
        assertThat(run.events()).containsExactly("client asks server.get", "client gives up server.get");
    }

    @Test
    void message_isSentAndReceived() {
        var wiring = Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", sends("server.put").then("idle"))
                        .build())
                .component(Protocol.of("server", Server.class)
                        .state("ready", receives("put").then("ready"))
                        .build())
                .mailbox("server", 2, Overflow.BLOCK)
                .build();
        var run = run(
                wiring,
                "client",
                server -> {
                    server.put(1);
                    server.put(2);
                    return server;
                },
                new Serving());
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client sends server.put",
                        "client sends server.put",
                        "server receives put",
                        "server receives put");
    }

    @Test
    void callOfAnActorThatTheWiringDoesNotHave_isAViolation() {
        var run = run(wiring(requests("server.get").then("idle")), "guest", Server::get, new Serving());
        assertThat(problem(run))
                .isEqualTo("guest asks server.get is not allowed: the wiring has no component guest; known: client,"
                        + " server");
    }

    @Test
    void callToAnActorThatTheWiringDoesNotHave_isAViolation() {
        var monitor = WiringMonitor.of(wiring(requests("server.get").then("idle")));
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            Server other = test.spawn(Server.class, Serving::new, ActorSettings.named("disk"));
            Client client = test.spawn(Client.class, () -> other::get);
            client.go();
            test.runQueued();
        }
        assertThat(monitor.violation().orElseThrow().problem())
                .startsWith("client asks disk.get is not allowed: the wiring has no component disk");
    }

    @Test
    void callFromOutside_isNotReported() {
        var monitor = WiringMonitor.of(wiring(requests("server.get").then("idle")));
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            Server server = test.spawn(Server.class, Serving::new);
            server.put(1);
            test.get(server.get());
        }
        monitor.check();
        assertThat(monitor.count()).isZero();
    }

    /** Of two unnamed actors of a type, the second is server2; a call of itself is a private step. */
    @Test
    void unnamedActors_areNumbered_andCallsOfThemselvesAreNotReported() {
        var called = new ArrayList<String>();
        var monitor = WiringMonitor.of(Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", requests("server2.get").then("idle"))
                        .build())
                .component("server2", server())
                .build());
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            Server first = test.spawn(Server.class, Serving::new);
            Server second = test.spawn(Server.class, () -> new Serving() {
                @Override
                public Promise<Integer> get() {
                    this.<Server>self().put(2);
                    return super.get();
                }

                @Override
                public void put(int value) {
                    called.add("put " + value);
                }
            });
            first.put(1); // seen first
            Client client = test.spawn(Client.class, () -> second::get);
            client.go();
            test.runQueued();
        }
        monitor.check();
        assertThat(monitor.count()).isEqualTo(3);
        assertThat(called).containsExactly("put 2");
    }

    /** A translation finds what the methods of the program are in the wiring. */
    @Test
    void translatedCall_isAnsweredWhenItBegins_andItsErrorIsHandedOn() {
        var errors = new ArrayList<String>();
        var monitor =
                WiringMonitor.of(wiring(requests("server.get").then("idle"))).keepingEvents();
        var observer = new WiringObserver(
                monitor,
                (from, to, call) -> call.method().equals("get")
                        ? Optional.of(new WiringObserver.Followed(
                                "client", "server.get", true, error -> errors.add(error.getMessage())))
                        : Optional.empty());
        try (var test = new TestSpace(observer)) {
            Server server = test.spawn(Server.class, () -> new Serving() {
                @Override
                public Promise<Integer> get() {
                    return Promise.failed(new IllegalStateException("late"));
                }
            });
            test.error(server.get());
        }
        monitor.check();
        assertThat(monitor.count()).isEqualTo(3);
        assertThat(errors).containsExactly("late");
    }

    // ---- calls that are given up

    private static Protocol later() {
        return Protocol.of("server", Server.class)
                .state("ready", accepts("get").then("working"))
                .state("working", answers("get").then("ready"))
                .build();
    }

    /** A client that gives up its first call when the server has begun it, and then makes another. */
    private static Run givingUp(Branch... ofClient) {
        var begun = new Deferred<Integer>();
        var late = new Deferred<Integer>();
        var client = Protocol.of("client").state("idle", ofClient[0]);
        if (ofClient.length > 1) {
            client.state("waiting", Arrays.copyOfRange(ofClient, 1, ofClient.length));
        }
        return run(
                Wiring.of("test").component(client.build()).component(later()).build(),
                "client",
                server -> {
                    var asked = server.get();
                    return begun.then(any -> {
                        asked.cancel();
                        late.resolve(1);
                        server.get();
                    });
                },
                new Serving() {
                    @Override
                    public Promise<Integer> get() {
                        return begun.resolve(1) ? late : Promise.of(2);
                    }
                });
    }

    @Test
    void questionThatIsCancelledWhileItIsServed_isGivenUp() {
        var run = givingUp(
                asks("server.get").then("waiting"),
                answered("server.get").then("idle"),
                cancels("server.get").then("idle"));
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client asks server.get",
                        "server takes get from client",
                        "client gives up server.get",
                        "client asks server.get",
                        "server takes get from client",
                        "server answers get to client",
                        "client gets the answer of server.get");
    }

    @Test
    void requestThatIsCancelledWhileItIsServed_isTimedOut_ifThatIsDeclared() {
        var run = givingUp(requests("server.get").then("idle").orTimeout("idle"));
        run.monitor().check();
        assertThat(run.events())
                .contains("client waits no longer for server.get")
                .hasSize(6);
        var undeclared = givingUp(requests("server.get").then("idle"));
        undeclared.monitor().check();
        assertThat(undeclared.events())
                .as("the cancellation is an error, and that is an answer")
                .startsWith("client asks server.get", "server takes get from client", "server answers get to client");
    }

    /** The server asks the store when its caller has given up, and answers after that. */
    @Test
    void callThatIsCancelled_isServedToItsEnd() {
        var server = Protocol.of("server", Server.class)
                .state("ready", accepts("get").then("working"))
                .state("working", requests("store.load").then("loaded"))
                .state("loaded", answers("get").then("ready"))
                .build();
        var wiring = Wiring.of("test")
                .component(Protocol.of("client")
                        .state("idle", asks("server.get").then("waiting"))
                        .state(
                                "waiting",
                                answered("server.get").then("idle"),
                                cancels("server.get").then("idle"))
                        .build())
                .component(server)
                .component(Protocol.of("store", Store.class)
                        .state("ready", provides("load").then("ready"))
                        .build())
                .build();
        var monitor = WiringMonitor.of(wiring);
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            var begun = new Deferred<Integer>();
            var go = new Deferred<Integer>();
            Store store = test.spawn(Store.class, () -> () -> Promise.of(1), ActorSettings.named("store"));
            Server serving = test.spawn(Server.class, () -> new Serving() {
                @Override
                public Promise<Integer> get() {
                    begun.resolve(1);
                    return go.thenCompose(any -> store.load());
                }
            });
            Client client = test.spawn(Client.class, () -> () -> {
                var asked = serving.get();
                begun.then(any -> {
                    asked.cancel();
                    go.resolve(1);
                });
            });
            client.go();
            test.runQueued();
            client.go();
            test.runQueued();
            monitor.idle();
            test.takeProblems();
        }
        monitor.check();
        assertThat(monitor.count())
                .as("six events, and the second call is cancelled in the mailbox")
                .isEqualTo(8);
    }

    // ---- errors

    /** Two calls, of which the second is made when the first is settled; of the results, null is an error. */
    private static Run twice(Protocol client, Protocol server, @Nullable Integer first, @Nullable Integer second) {
        var results = new ArrayDeque<>(Arrays.asList(Optional.ofNullable(first), Optional.ofNullable(second)));
        return run(
                Wiring.of("test").component(client).component(server).build(),
                "client",
                to -> to.get().exceptionally(error -> 0).thenCompose(any -> to.get()),
                new Serving() {
                    @Override
                    public Promise<Integer> get() {
                        return results.remove()
                                .map(Promise::of)
                                .orElseGet(() -> Promise.failed(new IllegalStateException("no")));
                    }
                });
    }

    private static Protocol client(String rejected) {
        return Protocol.of("client")
                .state("idle", requests("server.get").then("happy").orRejected(rejected))
                .state("happy", requests("server.get").then("happy").orRejected(rejected))
                .state("sad", requests("server.get").then("happy").orRejected("sad"))
                .build();
    }

    @Test
    void error_ofAComponentThatMayOnlyFail_isAnAnswer() {
        var server = Protocol.of("server", Server.class)
                .state("ready", provides("get").then("ready"))
                .state("down", does("start").then("ready"))
                .failsTo("down")
                .build();
        var run = twice(client("sad"), server, null, 1);
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client asks server.get",
                        "server takes get from client",
                        "server answers get to client",
                        "client asks server.get",
                        "server takes get from client",
                        "server answers get to client");
    }

    @Test
    void error_inAStateThatRejectsTheCall_isARejection_andAResultIsNotAllowed() {
        var server = Protocol.of("server", Server.class)
                .state("ready", provides("get").then("down"))
                .state("down", rejects("get").then("down"))
                .build();
        var run = twice(client("sad"), server, 1, null);
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client asks server.get",
                        "server takes get from client",
                        "server answers get to client",
                        "client asks server.get",
                        "server rejects get of client");
        assertThat(problem(twice(client("sad"), server, 1, 1)))
                .isEqualTo(
                        "server takes get from client is not allowed: server is in \"down\", where it may reject get");
    }

    /** The caller goes where the error leads it, also if the state provides the call, too. */
    @Test
    void error_inAStateThatMayDoEither_isARejection() {
        var server = Protocol.of("server", Server.class)
                .state("ready", provides("get").then("ready"), rejects("get").then("ready"))
                .build();
        var run = twice(client("sad"), server, null, 1);
        run.monitor().check();
        assertThat(run.events())
                .containsExactly(
                        "client asks server.get",
                        "server rejects get of client",
                        "client asks server.get",
                        "server takes get from client",
                        "server answers get to client");
        assertThat(run.monitor().describe("client")).isEqualTo("client is in \"happy\"");
    }

    @Test
    void error_ofACallThatMayBeRefused_isARejection() {
        var server = Protocol.of("server", Server.class)
                .state("ready", accepts("get").then("working"))
                .state("working", answers("get").then("ready"), refuses("get").then("ready"))
                .build();
        var run = twice(client("sad"), server, null, 1);
        run.monitor().check();
        assertThat(run.events())
                .startsWith("client asks server.get", "server takes get from client", "server rejects get of client");
    }

    @Test
    void callThatIsAnsweredWhenItBegins_isNotReportedAgain() {
        var server = Protocol.of("server", Server.class)
                .state("ready", provides("get").then("ready"), rejects("get").then("ready"))
                .build();
        var monitor = WiringMonitor.of(Wiring.of("test")
                        .component(client("sad"))
                        .component(server)
                        .build())
                .keepingEvents();
        var observer = new WiringObserver(
                monitor,
                (from, to, call) -> Optional.of(new WiringObserver.Followed("client", "server.get", true, null)));
        var result = new Deferred<Integer>();
        try (var test = new TestSpace(observer)) {
            Server serving = test.spawn(Server.class, () -> new Serving() {
                @Override
                public Promise<Integer> get() {
                    return result;
                }
            });
            var got = serving.get();
            test.runQueued();
            result.reject(new IllegalStateException("no"));
            test.error(got);
        }
        monitor.check();
        assertThat(monitor.count()).isEqualTo(3);
    }

    // ---- calls from outside

    @Test
    void ownSteps_areNotTakenForCallsFromOutside() {
        var client = Protocol.of("client")
                .state(
                        "idle",
                        does("go from outside").then("going"),
                        does("answers the phone").then("idle"),
                        does("answers get").then("idle"),
                        does("learns it from outside").then("idle"))
                .state("going", does("answers go").then("idle"))
                .build();
        assertThat(WiringObserver.stepsFromOutside(
                        Wiring.of("test").component(client).build()))
                .containsExactlyInAnyOrder("go from outside", "answers go");
    }

    // ---- events of other threads, and of calls that never begin

    private record Named(String space, String name, int number) implements CallObserver.Party {}

    private static final CallObserver.Party CLIENT = new Named("space", "client", 0);
    private static final CallObserver.Party SERVER = new Named("space", "server", 0);

    private static final class OneCall implements CallObserver.Call {
        private final String method;
        private final boolean isRequest;
        private @Nullable Consumer<@Nullable Throwable> listener;

        OneCall(String method, boolean isRequest) {
            this.method = method;
            this.isRequest = isRequest;
        }

        @Override
        public Class<?> type() {
            return Server.class;
        }

        @Override
        public String method() {
            return method;
        }

        @Override
        public List<@Nullable Object> arguments() {
            return List.of();
        }

        @Override
        public boolean isRequest() {
            return isRequest;
        }

        @Override
        public boolean isPassedOn() {
            return false;
        }

        @Override
        public void whenSettled(Consumer<@Nullable Throwable> callback) {
            listener = callback;
        }

        void cancel() {
            requireNonNull(listener).accept(new CancellationException("test"));
        }
    }

    /** The server's thread is about to report that the call begins, while that of its caller cancels it. */
    @Test
    void cancellationWhileTheCallBegins_isReportedBeforeItOrAfterIt() throws InterruptedException {
        var monitor = WiringMonitor.of(Wiring.of("test")
                        .component(Protocol.of("client")
                                .state("idle", asks("server.get").then("waiting"))
                                .state(
                                        "waiting",
                                        answered("server.get").then("idle"),
                                        cancels("server.get").then("idle"))
                                .build())
                        .component(server())
                        .build())
                .keepingEvents();
        var observer = new WiringObserver(monitor);
        var call = new OneCall("get", true);
        observer.called(CLIENT, SERVER, call);
        var begins = new Thread(() -> observer.begun(SERVER, call));
        synchronized (monitor) {
            begins.start();
            while (begins.getState() != Thread.State.BLOCKED) {
                Thread.onSpinWait();
            }
            call.cancel();
        }
        begins.join();
        monitor.check();
        assertThat(monitor.events()).hasToString("[client asks server.get, client gives up server.get]");
    }

    @Test
    void messageThatWasDropped_isForgotten() {
        var monitor = WiringMonitor.of(Wiring.of("test")
                        .component(Protocol.of("client")
                                .state("idle", sends("server.put").then("idle"))
                                .build())
                        .component(Protocol.of("server", Server.class)
                                .state("ready", receives("put").then("ready"))
                                .build())
                        .mailbox("server", 2, Overflow.BLOCK)
                        .build())
                .keepingEvents();
        var observer = new WiringObserver(monitor);
        var call = new OneCall("put", false);
        observer.called(CLIENT, SERVER, call);
        observer.dropped(SERVER, call);
        observer.begun(SERVER, call);
        assertThat(monitor.events()).hasToString("[client sends server.put]");
    }
}
