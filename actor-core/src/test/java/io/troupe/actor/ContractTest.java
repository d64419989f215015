package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.loop.QueueEntry;
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
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;

/** Points of the contract that have no other test; {@code docs/contract-actor-core.md} lists them all. */
@Isolated("looks at all threads")
class ContractTest extends InTestSpace {
    /** Does not know this library. */
    interface Door {
        void open(String who);
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
            Doer here = test.spawn(Doer.class, Doer::new);
            Doer there = other.spawn(Doer.class, Doer::new);
            test.space().execute(() -> {
                throw new IllegalStateException("here only");
            });
            here.run(me -> log.add("noted"));
            other.runQueued();
            assertThat(log).isEmpty();
            assertThat(other.takeProblems()).isEmpty();
            test.runQueued();
            assertThat(test.takeProblems()).hasSize(1);
            test.space().stop(here);
            test.runQueued();
            there.run(me -> log.add("still there"));
            other.runQueued();
            assertThat(log).containsExactly("noted", "still there");
        }
    }

    interface Desk {
        Promise<Integer> ask(int number, String text);
    }

    @Test
    void request_isPromiseAndQueueEntryInOne_withTypedFields_inThePackageOfItsActorType() throws Exception {
        Desk desk = test.spawn(Desk.class, () -> (number, text) -> Promise.of(number));
        Promise<Integer> request = desk.ask(1, "one");
        Class<?> type = request.getClass();
        assertThat(request).isInstanceOf(Request.class).isInstanceOf(QueueEntry.class);
        assertThat(Modifier.isAbstract(Promise.class.getModifiers())).isTrue();
        int access = Modifier.PUBLIC | Modifier.PROTECTED;
        assertThat(Promise.class.getDeclaredConstructor().getModifiers() & access)
                .as("access of users to the constructor of Promise")
                .isZero();
        assertThat(Arrays.stream(type.getDeclaredFields()).map(Field::getType))
                .containsExactly(int.class, String.class);
        assertThat(List.of(type.getPackage(), desk.getClass().getPackage())).containsOnly(Desk.class.getPackage());
        test.get(request);
    }

    /** Reports the caller of a method. */
    interface Witness {
        Promise<List<String>> callers();
    }

    @Test
    void call_runsWithoutReflection() {
        Witness witness = test.spawn(
                Witness.class,
                () -> () -> Promise.of(StackWalker.getInstance(Option.SHOW_HIDDEN_FRAMES)
                        .walk(frames -> frames.map(StackWalker.StackFrame::getClassName)
                                .takeWhile(name -> !name.equals(TestSpace.class.getName()))
                                .toList())));
        assertThat(test.get(witness.callers()))
                .hasSizeGreaterThan(2)
                .allMatch(name -> name.startsWith("io.troupe.actor"));
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
        test.runQueued();
        assertThat(log).containsExactly("result null", "finished");
    }

    @Test
    void actorOnlyMethods_ofASpawnedActor_throwOnAForeignThread() {
        var escaped = new Doer();
        test.spawn(Doer.class, () -> escaped)
                .run(me -> log.add("on its own thread in " + me.context().space()));
        test.runQueued();
        assertThat(log).containsExactly("on its own thread in test-space");
        assertThatThrownBy(() -> escaped.context().space())
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("space()");
        assertThatThrownBy(() -> escaped.context().after(Duration.ofSeconds(1), () -> {}))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("after(..)");
    }

    @Test
    void plainObject_behindAnInterfaceThatKnowsNothingOfThisLibrary_isAnActor_thatTheTestsThreadServes() {
        Door plain = who -> log.add("hello " + who + " on " + Thread.currentThread());
        Door actor = test.spawn(Door.class, () -> plain);
        String greeting = "hello Ann on " + Thread.currentThread();
        for (Door door : List.of(plain, actor)) {
            door.open("Ann");
        }
        assertThat(log).containsExactly(greeting);
        test.runQueued();
        assertThat(log).containsExactly(greeting, greeting);
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
        Desk desk = test.spawn(Desk.class, () -> (number, text) -> {
            log.add(text);
            return Promise.of(number);
        });
        Promise<Integer> follower = desk.ask(5, "asked").thenApply(sum -> sum + 1);
        follower.cancel();
        test.runQueued();
        assertThat(log).containsExactly("asked");
        assertThat(follower.isCancelled()).isTrue();
    }
}
