package io.troupe.actor;

import static io.troupe.actor.Concurrently.onAnotherThread;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import org.junit.jupiter.api.Test;

/**
 * Order of two entries when the first comes from another thread, and the second from the space's own thread a moment
 * later.
 */
class OrderAcrossThreadsTest extends InTestSpace {
    interface Source {
        void send(Callback<Integer> results);
    }

    interface Answerer {
        Promise<Integer> ask();
    }

    @Test
    void listeners_secondRegisteredAfterAnotherThreadHasSettled_runInOrderOfRegistration() {
        test.run(() -> {
            var promise = new Deferred<Integer>();
            promise.thenRun(() -> log.add("first"));
            onAnotherThread(() -> promise.resolve(1));
            promise.thenRun(() -> log.add("second"));
        });
        assertThat(log).containsExactly("first", "second");
    }

    @Test
    void listeners_ofARequestToAnotherSpace_runInOrderOfRegistration() {
        try (var other = new TestSpace()) {
            Answerer answerer = other.spawn(Answerer.class, () -> () -> Promise.of(1));
            test.run(() -> {
                Promise<Integer> answer = answerer.ask();
                answer.thenRun(() -> log.add("first"));
                onAnotherThread(other::runQueued);
                answer.thenRun(() -> log.add("second"));
            });
        }
        assertThat(log).containsExactly("first", "second");
    }

    @Test
    void callback_resultsFromAnotherThreadAndThenTheEnd_arriveInTheOrderInWhichTheyWereSent() {
        Source source = test.spawn(Source.class, () -> results -> {
            onAnotherThread(() -> results.next(1));
            results.next(2);
            results.finish();
        });
        test.run(() ->
                source.send(new Callback.Stream<>(value -> log.add("value " + value), end -> log.add("end " + end))));
        assertThat(log).containsExactly("value 1", "value 2", "end null");
    }
}
