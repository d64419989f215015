package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** What is observed of each call, in a space without a thread. */
class CallObserverTest {
    private final List<String> log = new ArrayList<>();

    private class Observer implements CallObserver {
        private final String name;

        Observer(String name) {
            this.name = name;
        }

        @Override
        public void called(Party from, Party to, Call call) {
            log.add(name + from.name() + " calls " + to.name() + "." + call.method() + call.arguments());
            call.whenSettled(error -> log.add(name + call.method() + " is settled: " + error));
        }

        @Override
        public void begun(Party actor, Call call) {
            log.add(name + actor.name() + " begins " + call.method());
        }

        @Override
        public void dropped(Party actor, Call call) {
            log.add(name + actor.name() + " drops " + call.method());
        }
    }

    private ActorSpace space = space(new Observer(""));

    private ActorSpace space(CallObserver observer) {
        return ActorSpace.create(SpaceSettings.named("shop")
                .withoutThread()
                .withOnError((where, error) -> log.add(where + ": " + error.getMessage()))
                .withOnDeadLetter(letter -> log.add("dead letter"))
                .withCallObserver(observer));
    }

    @AfterEach
    void close() {
        space.close();
    }

    interface Store {
        void put(String what);

        Promise<Integer> count(String what);
    }

    private Store store(Promise<Integer> count, ActorSettings settings) {
        return space.spawn(
                Store.class,
                () -> new Store() {
                    @Override
                    public void put(String what) {}

                    @Override
                    public Promise<Integer> count(String what) {
                        return count;
                    }
                },
                settings);
    }

    @Test
    void call_isObservedWhenItIsSent_begins_andIsSettled_whichIsNoListener() {
        var later = new Deferred<Integer>();
        Store store = store(later, ActorSettings.named("store"));
        store.put("pen");
        store.count("pens");
        assertThat(log).containsExactly("outside calls store.put[pen]", "outside calls store.count[pens]");
        log.clear();
        space.runQueued();
        assertThat(log).containsExactly("store begins put", "store begins count");
        log.clear();
        space.execute(() -> later.reject(new IllegalStateException("empty")));
        space.runQueued();
        assertThat(log).first().isEqualTo("count is settled: java.lang.IllegalStateException: empty");
    }

    @Test
    void callThatIsNotBegun_isDropped() {
        Store full = store(Promise.of(1), ActorSettings.named("full").withMailbox(1, Overflow.REJECT));
        full.put("a");
        full.put("b");
        assertThat(log).contains("full drops put", "dead letter");
        log.clear();
        Store store = store(Promise.of(1), ActorSettings.named("store"));
        Promise<Integer> cancelled = store.count("pens");
        cancelled.cancel();
        space.runQueued();
        assertThat(log).contains("store drops count").doesNotContain("store begins count");
        log.clear();
        space.stop(store);
        space.runQueued();
        store.put("late");
        space.runQueued();
        assertThat(log).containsExactly("outside calls store.put[late]", "store drops put", "dead letter");
    }

    /** Throws from every method; an assertion that fails is an Error. */
    private static final class Broken implements CallObserver {
        @Override
        public void called(Party from, Party to, Call call) {
            throw new AssertionError("called " + call.method());
        }

        @Override
        public void begun(Party actor, Call call) {
            throw new AssertionError("begun " + call.method());
        }

        @Override
        public Turn turnBegun(Party party, Duration stallLimit) {
            throw new AssertionError("turn of " + party.name());
        }
    }

    @Test
    void whatAnObserverThrows_isReported_andTheCallIsMade() {
        space.close();
        log.clear();
        space = space(new Broken());
        Promise<Integer> count =
                store(Promise.of(1), ActorSettings.named("store")).count("pens");
        space.runQueued();
        assertThat(count.getNow()).isEqualTo(1);
        assertThat(log)
                .contains(
                        "the call observer of shop: called count",
                        "the call observer of shop: begun count",
                        "the call observer of shop: turn of store");
    }

    private final class Turns implements CallObserver {
        @Override
        public Turn turnBegun(Party party, Duration stallLimit) {
            log.add(party.name() + " begins a turn");
            return () -> log.add("a turn ends");
        }
    }

    @Test
    void twoObservers_areBothNotified_whateverOneOfThemThrows() {
        for (var observer : List.of(
                new Broken().and(new Observer("")).and(new Turns()),
                new Observer("").and(new Turns()).and(new Broken()))) {
            space.close();
            log.clear();
            space = space(observer);
            Promise<Integer> count =
                    store(Promise.of(1), ActorSettings.named("store")).count("pens");
            space.runQueued();
            assertThat(count.getNow()).isEqualTo(1);
            assertThat(log)
                    .containsExactlyInAnyOrder(
                            "outside calls store.count[pens]",
                            "the call observer of shop: called count",
                            "store begins a turn", // of its start
                            "a turn ends",
                            "the call observer of shop: turn of store",
                            "store begins a turn",
                            "store begins count",
                            "the call observer of shop: begun count",
                            "count is settled: null",
                            "a turn ends",
                            "the call observer of shop: turn of store");
        }
    }

    @Test
    void twoObservers_areNotifiedInTheirOrder() {
        space.close();
        log.clear();
        space = space(new Observer("1 ").and(new Observer("2 ")));
        store(Promise.of(1), ActorSettings.named("store")).put("pen");
        assertThat(log).containsExactly("1 outside calls store.put[pen]", "2 outside calls store.put[pen]");
    }

    interface Reader {
        Promise<String> read(Store from);
    }

    /** The call that is served, where it is asked for: in the turn, a listener, a body, a timer, and after its end. */
    @Test
    void servedCall_isThatOfTheTurn_ofItsListenersAndBodies_andOfNoTimer() {
        var seen = new ArrayList<String>();
        Runnable note = () -> {
            var served = CallObserver.servedCall();
            seen.add(served == null ? "none" : served.method() + " " + served.isRequest());
        };
        Store store = store(Promise.of(1), ActorSettings.named("store"));
        class Reading extends Actor implements Reader {
            @Override
            public Promise<String> read(Store from) {
                note.run();
                context().after(Duration.ZERO, note);
                return from.count("pen").thenCompose(count -> {
                    note.run();
                    return space.sequential(() -> {
                        from.count("ink").await();
                        note.run();
                        return "both";
                    });
                });
            }
        }
        Reader reader = space.spawn(Reader.class, Reading::new);
        reader.read(store);
        space.runQueued();
        note.run();
        assertThat(seen).containsExactlyInAnyOrder("read true", "read true", "read true", "none", "none");
    }

    interface Door {
        void shut();

        void open();

        Promise<Integer> enter();
    }

    @Test
    void holdAndRelease_areObserved_eachOnce_alsoWhenTheActorStops() {
        space.close();
        space = space(new CallObserver() {
            @Override
            public void held(Party actor) {
                log.add(actor + " holds");
            }

            @Override
            public void released(Party actor) {
                log.add(actor + " takes calls");
            }
        });
        class Gate extends Actor implements Door {
            @Override
            public void shut() {
                context().hold();
                context().hold();
                context().after(Duration.ZERO, this::open);
            }

            @Override
            public void open() {
                context().release();
                context().release();
            }

            @Override
            public Promise<Integer> enter() {
                return Promise.of(1);
            }
        }
        Door door = space.spawn(Door.class, Gate::new);
        door.shut();
        space.runQueued();
        assertThat(log).containsExactly("Door#1 holds", "Door#1 takes calls");
        log.clear();
        Door other = space.spawn(Door.class, () -> new Gate() {
            @Override
            public void open() {}
        });
        other.shut();
        space.runQueued();
        space.stop(other);
        space.runQueued();
        assertThat(log).containsExactly("Door#2 holds", "Door#2 takes calls");
    }
}
