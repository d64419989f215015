package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/**
 * Order of two entries when the first comes from another thread, and the second from the space's own thread a moment
 * later.
 */
class OrderAcrossThreadsTest {
    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    /** Sends results from the thread that the test chooses. */
    public interface Source {
        void send(Callback<Integer> results);
    }

    private static void elsewhere(Runnable action) {
        Thread thread = Thread.ofPlatform().start(action);
        try {
            thread.join();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
    }

    @Test
    void listeners_secondRegisteredAfterAnotherThreadHasSettled_runInOrderOfRegistration() {
        test.run(() -> {
            var promise = new Deferred<Integer>();
            promise.thenRun(() -> log.add("first"));
            elsewhere(() -> promise.resolve(1));
            promise.thenRun(() -> log.add("second"));
        });
        assertThat(log).containsExactly("first", "second");
    }

    /** Answers. */
    public interface Answerer {
        Promise<Integer> ask();
    }

    @Test
    void listeners_ofARequestToAnotherSpace_runInOrderOfRegistration() {
        var other = new TestSpace();
        Answerer answerer = other.spawn(Answerer.class, () -> () -> Promise.of(1));
        test.run(() -> {
            Promise<Integer> answer = answerer.ask();
            answer.thenRun(() -> log.add("first"));
            elsewhere(other::crank);
            answer.thenRun(() -> log.add("second"));
        });
        other.close();
        assertThat(log).containsExactly("first", "second");
    }

    @Test
    void callback_resultsFromAnotherThreadAndThenTheEnd_arriveInTheOrderInWhichTheyWereSent() {
        Source source = test.spawn(Source.class, () -> results -> {
            elsewhere(() -> results.next(1));
            results.next(2);
            results.finish();
        });
        var stream = new Callback.Stream<Integer>(
                value -> log.add("value " + value), (@Nullable Throwable end) -> log.add("end " + end));
        test.run(() -> source.send(stream));
        assertThat(log).containsExactly("value 1", "value 2", "end null");
    }
}
