package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The code of a reader, on real threads: it runs only on its space, not under a lock, and its end is not lost. */
@Timeout(120)
class ReaderCodeTest {
    private static final Duration LIMIT = Duration.ofMinutes(1);
    /** Few: a sender without stack may not have woken the space, which then looks within a second. */
    private static final int ROUNDS = 3;

    interface Source {
        void stream(Callback<Integer> results);

        Promise<String> ping();
    }

    /** Keeps the callbacks that it was called with. */
    static class Kept extends Actor implements Source {
        private final List<Callback<Integer>> readers = new ArrayList<>();

        @Override
        public void stream(Callback<Integer> results) {
            readers.add(results);
            results.next(readers.size());
        }

        @Override
        public Promise<String> ping() {
            return Promise.of("pong");
        }
    }

    interface Listening {
        Promise<String> listenTo(Source source);
    }

    private final Queue<String> problems = new ConcurrentLinkedQueue<>();
    private final ActorSpace serving = space("serving");
    private final ActorSpace reading = space("reading");
    private final CompletableFuture<Callback.Stream<Integer>> streamed = new CompletableFuture<>();
    private final CompletableFuture<String> endedOn = new CompletableFuture<>();
    private final Listening listener = reading.spawn(Listening.class, () -> source -> {
        var stream = new Callback.Stream<Integer>(
                value -> {}, end -> endedOn.complete(Thread.currentThread().getName()));
        source.stream(stream);
        streamed.complete(stream);
        return Promise.of("listens");
    });

    private ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name)
                .withOnError((where, error) -> problems.add(name + ": " + error.getMessage())));
    }

    @AfterEach
    void close() {
        reading.close();
        serving.close();
    }

    /** A reader whose code determines whether it has cancelled. */
    private abstract static class Asked implements Callback<Integer> {
        final Queue<String> threads = new ConcurrentLinkedQueue<>();

        @Override
        public void accept(@Nullable Integer value, @Nullable Throwable error) {}

        @Override
        public final boolean isCancelled() {
            threads.add(Thread.currentThread().getName());
            return answer();
        }

        abstract boolean answer();
    }

    @Test
    void end_ofAStreamThatAnotherThreadCancels_isHeardOnTheSpaceOfTheReader() throws Exception {
        Source source = serving.spawn(Source.class, Kept::new);
        listener.listenTo(source).get(LIMIT);
        var stream = streamed.get(1, TimeUnit.MINUTES);
        stream.cancel();
        assertThat(stream.isCancelled()).as("at once").isTrue();
        assertThat(endedOn.get(1, TimeUnit.MINUTES)).contains("reading");
    }

    @Test
    void end_isNotHeardByAReaderThatHasStopped() throws Exception {
        Source source = serving.spawn(Source.class, Kept::new);
        listener.listenTo(source).get(LIMIT);
        var stream = streamed.get(1, TimeUnit.MINUTES);
        reading.stop(listener);
        reading.whenStopped(listener).get(LIMIT);
        stream.cancel();
        var after = new CompletableFuture<String>();
        reading.execute(() -> after.complete("next turn"));
        assertThat(after.get(1, TimeUnit.MINUTES)).isEqualTo("next turn");
        assertThat(endedOn).isNotDone();
    }

    @Test
    void isCancelled_ofAReader_runsOnItsSpaceOnly_andItsErrorIsTheReaders() throws Exception {
        Source source =
                serving.spawn(Source.class, Kept::new, ActorSettings.defaults().withSupervision(Supervision.STOP));
        var broken = new Asked() {
            @Override
            boolean answer() {
                throw new IllegalStateException("bug of a reader");
            }
        };
        var called = new CompletableFuture<@Nullable Void>();
        reading.execute(() -> {
            source.stream(broken);
            called.complete(null);
        });
        called.get(1, TimeUnit.MINUTES);
        assertThat(source.ping().get(LIMIT)).as("another caller").isEqualTo("pong");
        var after = new CompletableFuture<@Nullable Void>();
        reading.execute(() -> after.complete(null));
        after.get(1, TimeUnit.MINUTES);
        assertThat(broken.threads).isNotEmpty().allMatch(name -> name.contains("reading"));
        assertThat(problems).containsExactly("reading: bug of a reader");
    }

    /** The reader waits for a publisher, as with a lock of a model. */
    @Test
    void publishers_holdNoLockWhileCodeOfAUserRuns() throws Exception {
        var topic = Topic.<Integer>of(serving, "values");
        var published = new CountDownLatch(1);
        var waiting = new Asked() {
            @Override
            boolean answer() {
                try {
                    return !published.await(1, TimeUnit.MINUTES);
                } catch (InterruptedException interrupted) {
                    throw new AssertionError(interrupted);
                }
            }
        };
        var subscribed = new CompletableFuture<@Nullable Void>();
        reading.execute(() -> {
            topic.subscribe(waiting);
            subscribed.complete(null);
        });
        subscribed.get(1, TimeUnit.MINUTES);
        topic.publish(1);
        topic.publish(2); // not behind a lock that the reader holds meanwhile
        published.countDown();
        assertThat(topic.subscribers()).isOne();
    }

    /** Each attempt has some frames more than the one before. */
    @Test
    void end_thatIsSentNearTheEndOfAStack_isHeard_ifNotAtFirstThenAtTheNextAttempt() throws Exception {
        Source source = serving.spawn(Source.class, Kept::new);
        for (int round = 0; round < ROUNDS; round++) {
            var ends = new CountDownLatch(1);
            var stream = new Callback.Stream<Integer>(value -> {}, end -> ends.countDown());
            var handle = new CompletableFuture<Callback<Integer>>();
            serving
                    .spawn(Source.class, () -> new Kept() {
                        @Override
                        public void stream(Callback<Integer> results) {
                            handle.complete(results);
                        }
                    })
                    .stream(stream);
            Callback<Integer> sender = handle.get(1, TimeUnit.MINUTES);
            var small = new Thread(null, () -> finishAtTheEnd(sender, new boolean[1]), "small stack", 200_000L);
            small.start();
            small.join();
            assertThat(ends.await(30, TimeUnit.SECONDS))
                    .as("round %d: the end", round)
                    .isTrue();
        }
        assertThat(source.ping().get(LIMIT)).isEqualTo("pong");
    }

    /** Tries in each frame on the way back until one attempt succeeds. */
    private static void finishAtTheEnd(Callback<Integer> sender, boolean[] done) {
        try {
            finishAtTheEnd(sender, done);
        } catch (StackOverflowError deepest) {
            // attempts follow
        }
        if (!done[0]) {
            sender.finish();
            done[0] = true;
        }
    }
}
