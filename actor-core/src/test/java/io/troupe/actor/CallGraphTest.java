package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.stream.Collectors;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Who calls whom, in spaces without threads and on a clock that only the actors move: each count is worked out. */
class CallGraphTest {
    private static final Duration STALL = Duration.ofMillis(50);

    private final ManualClock machine = new ManualClock();
    private final CallGraph graph = new CallGraph(machine);
    private final List<String> log = new ArrayList<>();
    private final ActorSpace space = ActorSpace.create(settings("shop"));

    private SpaceSettings settings(String name) {
        return SpaceSettings.named(name)
                .withoutThread()
                .withOnError((where, error) -> log.add(where + " " + error.getMessage()))
                .withOnDeadLetter(letter -> log.add("dead " + letter.message()))
                .withOnStall(STALL, stall -> {})
                .withCallObserver(graph);
    }

    @AfterEach
    void close() {
        space.close();
    }

    interface Store {
        void take(int millis);

        Promise<Integer> ask(int millis);

        void watch(int results, Callback<Integer> callback);
    }

    private class PlainStore implements Store {
        @Override
        public void take(int millis) {
            machine.advance(Duration.ofMillis(millis));
        }

        @Override
        public Promise<Integer> ask(int millis) {
            take(millis);
            return Promise.of(millis);
        }

        @Override
        public void watch(int results, Callback<Integer> callback) {
            for (int i = 0; i < results; i++) {
                callback.next(i);
            }
            callback.finish();
        }
    }

    interface Sink {
        void accept(int number);
    }

    interface Clerk {
        void order(int calls, int millis);

        void watch(int results);
    }

    private Clerk clerk(Store store) {
        return space.spawn(
                Clerk.class,
                () -> new Clerk() {
                    @Override
                    public void order(int calls, int millis) {
                        for (int i = 0; i < calls; i++) {
                            store.ask(millis).then(taken -> machine.advance(Duration.ofMillis(1)));
                        }
                    }

                    @Override
                    public void watch(int results) {
                        store.watch(results, (value, error) -> {});
                    }
                },
                ActorSettings.named("clerk"));
    }

    private List<String> edges() {
        return graph.snapshot().edges().stream()
                .map(each -> each.from().name() + " -> " + each.to().name() + " " + each.calls() + " " + each.results())
                .toList();
    }

    private CallGraph.Node node(String name) {
        return graph.snapshot().nodes().stream()
                .filter(each -> each.name().equals(name))
                .findFirst()
                .orElseThrow();
    }

    @Test
    void calls_areCountedByCallerAndReceiver_andWaitUntilTheyBegin() {
        Store store = space.spawn(Store.class, PlainStore::new, ActorSettings.named("store"));
        Clerk clerk = clerk(store);
        clerk.order(3, 0);
        store.take(0);
        store.take(0);
        assertThat(edges()).containsExactly("outside -> clerk 1 0", "outside -> store 2 0");
        assertThat(node("clerk").waiting()).isEqualTo(1);
        assertThat(node("store").waiting()).isEqualTo(2);
        space.runQueued();
        assertThat(edges()).containsExactly("outside -> clerk 1 0", "outside -> store 2 0", "clerk -> store 3 0");
        assertThat(node("clerk").waiting()).isZero();
        assertThat(node("store").waiting()).isZero();
        assertThat(node("store").space()).isEqualTo("shop");
        assertThat(node(CallGraph.OUTSIDE).space()).isEmpty();
    }

    @Test
    void turns_ofCallsListenersAndStarts_areCountedAndTimed_andStallsAmongThem() {
        Store store = space.spawn(Store.class, PlainStore::new, ActorSettings.named("store"));
        Clerk clerk = clerk(store);
        clerk.order(3, 7);
        store.take(50);
        store.take(51);
        space.runQueued();
        CallGraph.Node stored = node("store");
        assertThat(stored.turns()).as("the start and five calls").isEqualTo(6);
        assertThat(stored.busy()).isEqualTo(Duration.ofMillis(3 * 7 + 50 + 51));
        assertThat(stored.longest()).isEqualTo(Duration.ofMillis(51));
        assertThat(stored.stalls()).as("turns longer than 50 ms").isEqualTo(1);
        assertThat(stored.current()).isZero();
        CallGraph.Node clerks = node("clerk");
        assertThat(clerks.turns()).as("the start, a call and three listeners").isEqualTo(5);
        assertThat(clerks.busy()).isEqualTo(Duration.ofMillis(3));
    }

    @Test
    void turnThatIsRunning_isSeenFromOutside() {
        List<Duration> seen = new ArrayList<>();
        space.spawn(Sink.class, () -> millis -> {
                    machine.advance(Duration.ofMillis(millis));
                    seen.add(node("Sink").current());
                })
                .accept(20);
        space.runQueued();
        assertThat(seen).containsExactly(Duration.ofMillis(20));
    }

    @Test
    void resultsOfACallback_areCountedFromTheirSender() {
        Clerk clerk = clerk(space.spawn(Store.class, PlainStore::new, ActorSettings.named("store")));
        clerk.watch(4);
        space.runQueued();
        assertThat(edges()).containsExactly("outside -> clerk 1 0", "clerk -> store 1 0", "store -> clerk 0 4");
        assertThat(node("clerk").turns())
                .as("the start, a call, four results and the end")
                .isEqualTo(7);
    }

    @Test
    void messagesThatAreNoCalls_canBeNoted() {
        graph.note("bus", "sonar", "follower");
        graph.note("bus", "sonar", "follower");
        assertThat(edges()).containsExactly("sonar -> follower 2 0");
        assertThat(node("follower").space()).isEqualTo("bus");
        assertThat(node("follower").waiting()).isZero();
    }

    @Test
    void unnamedActorsOfAType_areOneNode_andTasksOfTheSpaceAnother() {
        Store first = space.spawn(Store.class, PlainStore::new);
        Store second = space.spawn(Store.class, PlainStore::new);
        space.execute(() -> {
            first.take(0);
            second.take(0);
        });
        space.runQueued();
        assertThat(edges()).containsExactly("tasks -> Store 2 0");
        assertThat(node(CallGraph.TASKS).space()).isEqualTo("shop");
    }

    @Test
    void spacesWithOneGraph_areOneGraph_andOneWithoutIsKnownAsACaller() {
        var settings = SpaceSettings.named("street").withoutThread();
        try (var other = ActorSpace.create(settings("house"));
                var uncounted = ActorSpace.create(settings)) {
            Store store = other.spawn(Store.class, PlainStore::new, ActorSettings.named("store"));
            clerk(store).order(2, 0);
            uncounted.spawn(Sink.class, () -> store::take).accept(0);
            space.runQueued();
            uncounted.runQueued();
            assertThat(edges()).containsExactly("outside -> clerk 1 0", "clerk -> store 2 0", "Sink -> store 1 0");
            assertThat(node("store").waiting()).isEqualTo(3);
            other.runQueued();
            assertThat(node("store").waiting()).isZero();
            assertThat(graph.snapshot().nodes().stream().map(CallGraph.Node::space))
                    .containsExactly("", "shop", "house", "street");
        }
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void callsThatAreNotBegun_doNotWaitForEver(boolean dropOldest) {
        var overflow = dropOldest ? Overflow.DROP_OLDEST : Overflow.REJECT;
        Store store = space.spawn(
                Store.class, PlainStore::new, ActorSettings.named("store").withMailbox(2, overflow));
        for (int i = 0; i < 5; i++) {
            store.take(0);
        }
        assertThat(edges()).containsExactly("outside -> store 5 0");
        assertThat(node("store").waiting()).isEqualTo(2);
        space.runQueued();
        assertThat(log).as("dead letters").hasSize(3);
        assertThat(node("store").waiting()).isZero();
        space.stop(store);
        space.runQueued();
        store.take(0);
        store.ask(0).cancel();
        store.take(0);
        assertThat(node("store").waiting()).isEqualTo(2);
        space.runQueued();
        assertThat(node("store").waiting()).isZero();
    }

    @Test
    void callsThatAClosingSpaceRejects_doNotWaitForEver() {
        var other = ActorSpace.create(settings("house"));
        Store store = other.spawn(Store.class, PlainStore::new, ActorSettings.named("store"));
        other.execute(other::close);
        store.take(0);
        store.take(0);
        other.runQueued();
        other.close();
        assertThat(node("store").waiting()).isZero();
    }

    @Test
    void nodesBeyondTheLargestNumber_areOneNodeOfTheirSpace() {
        for (int i = 0; i < CallGraph.MOST_NODES + 5; i++) {
            space.spawn(Sink.class, () -> number -> {}, ActorSettings.named("actor " + i))
                    .accept(1);
        }
        space.runQueued();
        CallGraph.Snapshot snapshot = graph.snapshot();
        assertThat(snapshot.nodes()).hasSize(CallGraph.MOST_NODES + 1);
        long calls = snapshot.edges().stream().mapToLong(CallGraph.Edge::calls).sum();
        assertThat(calls).isEqualTo(CallGraph.MOST_NODES + 5);
        assertThat(node(CallGraph.OTHERS).space()).isEqualTo("shop");
    }

    @Test
    void contextOfACaller_isCarriedInACountedSpace_too() {
        List<String> users = new ArrayList<>();
        ThreadLocal<String> user = new ThreadLocal<>();
        var hook = new TurnContext<String>() {
            @Override
            public String capture() {
                return user.get();
            }

            @Override
            public Runnable restore(String captured) {
                user.set(captured);
                return user::remove;
            }
        };
        try (var other = ActorSpace.create(settings("house").withContext(hook))) {
            Store store = other.spawn(Store.class, () -> new PlainStore() {
                @Override
                public void take(int millis) {
                    users.add(user.get());
                }
            });
            user.set("Ada");
            store.ask(0).then(taken -> users.add(user.get() + " again"));
            user.remove();
            other.runQueued();
            assertThat(users).containsExactly("Ada", "Ada again");
        }
        assertThat(edges()).containsExactly("outside -> Store 1 0");
    }

    @Test
    void callsOfManyThreads_toASpaceWithAThread_areAllCounted() throws Exception {
        var settings = SpaceSettings.named("threads").withCallObserver(graph);
        int threads = 4;
        int calls = 2_000;
        try (var busy = ActorSpace.create(settings)) {
            var arrived = new CountDownLatch(threads * calls);
            Sink sink = busy.spawn(Sink.class, () -> number -> arrived.countDown(), ActorSettings.named("sink"));
            Sink relay = busy.spawn(Sink.class, () -> sink::accept, ActorSettings.named("relay"));
            for (int i = 0; i < threads; i++) {
                Thread.ofPlatform().start(() -> {
                    for (int call = 0; call < calls; call++) {
                        relay.accept(call);
                    }
                });
            }
            arrived.await();
        }
        assertThat(edges()).containsExactlyInAnyOrder("outside -> relay 8000 0", "relay -> sink 8000 0");
        assertThat(graph.snapshot().nodes().stream()
                        .filter(each -> !each.name().equals(CallGraph.OUTSIDE))
                        .collect(Collectors.toMap(CallGraph.Node::name, CallGraph.Node::turns)))
                .containsEntry("sink", 8_001L)
                .containsEntry("relay", 8_001L);
    }

    @Test
    void spaceWithoutAGraph_countsNothing() {
        try (var plain = ActorSpace.create(SpaceSettings.named("plain").withoutThread())) {
            plain.spawn(Store.class, PlainStore::new).take(1);
            plain.runQueued();
        }
        assertThat(graph.snapshot()).isEqualTo(new CallGraph.Snapshot(List.of(), List.of()));
    }
}
