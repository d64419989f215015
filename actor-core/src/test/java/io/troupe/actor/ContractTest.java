package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.Request;
import io.troupe.actor.internal.loop.Node;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.io.File;
import java.lang.StackWalker.Option;
import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.net.URL;
import java.net.URLClassLoader;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Points of the contract that have no other test; {@code docs/contract-actor-core.md} lists them all. */
class ContractTest {
    interface Desk {
        void note(List<String> where);

        Promise<Integer> ask(int number, String text);
    }

    static final class PlainDesk implements Desk {
        private int asked;

        @Override
        public void note(List<String> where) {
            where.add("noted");
        }

        @Override
        public Promise<Integer> ask(int number, String text) {
            if (number < 0) {
                throw new IllegalArgumentException(text);
            }
            asked += number;
            return Promise.of(asked);
        }
    }

    /** Reports the caller of a method. */
    interface Witness {
        Promise<List<String>> callers();
    }

    /** Does not know this library. */
    interface Door {
        void open(String who);
    }

    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** In a separate class loader, so that no other test can have used the global space before. */
    @Test
    @Tag("threads")
    @Timeout(60)
    void globalSpace_isADaemonThread_startedOnFirstUse() throws Exception {
        var path = new ArrayList<URL>();
        for (String entry : System.getProperty("java.class.path").split(File.pathSeparator)) {
            path.add(new File(entry).toURI().toURL());
        }
        try (var loader = new URLClassLoader(path.toArray(URL[]::new), ClassLoader.getPlatformClassLoader())) {
            Class<?> type = Class.forName("io.troupe.actor.ActorSpace", true, loader);
            assertThat(type).isNotSameAs(ActorSpace.class);
            var before = Thread.getAllStackTraces().keySet();
            Object global = type.getMethod("global").invoke(null);
            var threads = List.of(new CompletableFuture<Thread>(), new CompletableFuture<Thread>());
            for (var thread : threads) {
                Runnable task = () -> thread.complete(Thread.currentThread());
                type.getMethod("execute", Runnable.class).invoke(global, task);
            }
            Thread first = threads.getFirst().get(30, TimeUnit.SECONDS);
            assertThat(before).doesNotContain(first);
            assertThat(first.isDaemon()).isTrue();
            assertThat(threads.getLast().get(30, TimeUnit.SECONDS)).isSameAs(first);
            assertThat(type.getMethod("global").invoke(null)).isSameAs(global);
        }
    }

    @Test
    void spacesThatAreCreated_areIsolated() {
        try (var other = new TestSpace()) {
            Desk here = test.spawn(Desk.class, PlainDesk::new);
            Desk there = other.spawn(Desk.class, PlainDesk::new);
            test.space().execute(() -> {
                throw new IllegalStateException("here only");
            });
            here.note(log);
            other.crank();
            assertThat(log).isEmpty();
            assertThat(other.takeProblems()).isEmpty();
            test.crank();
            assertThat(test.takeProblems()).hasSize(1);
            test.space().stop(here);
            test.crank();
            assertThat(other.get(there.ask(2, ""))).isEqualTo(2);
        }
    }

    @Test
    void messageClasses_haveTypedFields_inThePackageOfTheActorType() {
        Desk desk = test.spawn(Desk.class, PlainDesk::new);
        Promise<Integer> request = desk.ask(1, "one");
        Class<?> message = request.getClass();
        assertThat(message.getPackage()).isSameAs(Desk.class.getPackage());
        assertThat(Arrays.stream(message.getDeclaredFields()).map(Field::getType))
                .containsExactly(int.class, String.class);
        assertThat(desk.getClass().getPackage()).isSameAs(Desk.class.getPackage());
        test.get(request);
    }

    @Test
    void request_isPromiseAndQueueEntryInOne() throws Exception {
        Desk desk = test.spawn(Desk.class, PlainDesk::new);
        Promise<Integer> answer = desk.ask(1, "one");
        assertThat(answer).isInstanceOf(Request.class).isInstanceOf(Node.class);
        assertThat(Modifier.isAbstract(Promise.class.getModifiers())).isTrue();
        assertThat(Modifier.isProtected(Promise.class.getDeclaredConstructor().getModifiers()))
                .isTrue();
        test.get(answer);
    }

    @Test
    void call_runsWithoutReflection() {
        Witness witness = test.spawn(Witness.class, () -> new Witness() {
            @Override
            public Promise<List<String>> callers() {
                return Promise.of(StackWalker.getInstance(Option.SHOW_HIDDEN_FRAMES)
                        .walk(frames -> frames.map(StackWalker.StackFrame::getClassName)
                                .takeWhile(name -> !name.equals(TestSpace.class.getName()))
                                .toList()));
            }
        });
        assertThat(test.get(witness.callers()))
                .hasSizeGreaterThan(2)
                .allMatch(name -> name.startsWith("io.troupe.actor"));
    }

    @Test
    void callbacks_runAtMost256InARow_beforeAMessage() {
        Desk desk = test.spawn(Desk.class, PlainDesk::new);
        test.run(() -> {
            desk.note(log);
            for (int count = 0; count < 1_000; count++) {
                Promise.of(count).then(value -> {
                    log.add("callback");
                });
            }
        });
        assertThat(log).hasSize(1_001);
        assertThat(log.indexOf("noted")).isEqualTo(256);
    }

    @Test
    void endlessMessages_doNotStarveTheCallbacks() {
        var spins = new int[1];
        var spinner = new Door[1];
        var answered = new Deferred<Integer>();
        spinner[0] = test.spawn(Door.class, () -> who -> {
            if (spins[0]++ == 0) {
                answered.then(value -> {
                    log.add("answered after " + spins[0]);
                });
                answered.resolve(1);
            }
            if (spins[0] < 10_000) {
                spinner[0].open(who);
            }
        });
        spinner[0].open("me");
        test.crank();
        assertThat(log).containsExactly("answered after 1");
        assertThat(spins[0]).isEqualTo(10_000);
    }

    @Test
    void hotActor_doesNotStarveTheOthers() {
        var spins = new int[1];
        var hot = new Door[1];
        hot[0] = test.spawn(Door.class, () -> who -> {
            if (spins[0]++ < 10_000) {
                hot[0].open(who);
            }
        });
        Door quiet = test.spawn(Door.class, () -> who -> log.add("served after " + spins[0]));
        test.run(() -> {
            hot[0].open("me");
            quiet.open("me");
        });
        assertThat(log).containsExactly("served after 1");
    }

    interface Source {
        void sendNullAndFinish(Callback<Object> results);
    }

    @Test
    void finish_isNotANullResult() {
        Source source = test.spawn(Source.class, () -> results -> {
            results.accept(null, null);
            results.finish();
        });
        source.sendNullAndFinish(new Callback.Stream<>(
                result -> log.add("result " + result), end -> log.add(end == null ? "finished" : "failed")));
        test.crank();
        assertThat(log).containsExactly("result null", "finished");
    }

    @Test
    void testSpace_hasNoThread_theTestServes() {
        Door door = test.spawn(Door.class, () -> who -> log.add(name()));
        door.open("me");
        assertThat(log).isEmpty();
        test.crank();
        assertThat(log).containsExactly(name());
    }

    private static String name() {
        return Thread.currentThread().threadId() + " " + Thread.currentThread().getName();
    }

    static final class Escaping extends Actor implements Door {
        @Override
        public void open(String who) {
            space();
        }

        void askForItsSpace() {
            space();
        }

        void setTimer() {
            after(Duration.ofSeconds(1), () -> {});
        }
    }

    @Test
    void actorOnlyMethods_ofASpawnedActor_throwOnAForeignThread() {
        var escaped = new Escaping();
        Door door = test.spawn(Door.class, () -> escaped);
        door.open("on its own thread");
        test.crank();
        assertThatThrownBy(escaped::askForItsSpace)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("space()");
        assertThatThrownBy(escaped::setTimer)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("after(..)");
    }

    @Test
    void plainObject_behindAnInterfaceThatKnowsNothingOfThisLibrary_isAnActor() {
        Door plain = who -> log.add("hello " + who);
        Door actor = test.spawn(Door.class, () -> plain);
        for (Door door : List.of(plain, actor)) {
            door.open("Ann");
        }
        assertThat(log).containsExactly("hello Ann");
        test.crank();
        assertThat(log).containsExactly("hello Ann", "hello Ann");
    }

    @Test
    void caller_receivesAnException_beforeAnyTimeHasPassed() {
        Desk desk = test.spawn(Desk.class, PlainDesk::new);
        Throwable error = test.error(desk.ask(-1, "no such number").orTimeout(Duration.ofSeconds(30)));
        assertThat(error).isExactlyInstanceOf(IllegalArgumentException.class).hasMessage("no such number");
        assertThat(test.clock().nanos()).isZero();
    }

    @Test
    void argumentsAndAnswers_areTheObjectsThemselves() {
        interface Echo {
            Promise<Object> same(Object value);
        }
        Echo echo = test.spawn(Echo.class, () -> Promise::of);
        Object unserializable = new Object();
        assertThat(test.get(echo.same(unserializable))).isSameAs(unserializable);
    }

    @Test
    void cancel_ofWhatFollowsARequest_leavesTheRequestAlone() {
        Desk desk = test.spawn(Desk.class, PlainDesk::new);
        Promise<Integer> follower = desk.ask(5, "").thenApply(sum -> sum + 1);
        follower.cancel();
        assertThat(test.get(desk.ask(0, ""))).isEqualTo(5);
        assertThat(follower.isCancelled()).isTrue();
    }
}
