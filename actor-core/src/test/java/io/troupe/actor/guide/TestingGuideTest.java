package io.troupe.actor.guide;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Actor;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeoutException;
import org.junit.jupiter.api.Test;

/** The samples of the guide's page on testing that the other pages do not have. */
class TestingGuideTest {
    interface Queue {
        void add(String job);

        Promise<Integer> length();

        Promise<String> slowest();
    }

    static final class JobQueue extends Actor implements Queue {
        private final List<String> jobs = new ArrayList<>();

        @Override
        public void add(String job) {
            if (job.isEmpty()) {
                throw new IllegalArgumentException("a job without a name");
            }
            jobs.add(job);
        }

        @Override
        public Promise<Integer> length() {
            return Promise.of(jobs.size());
        }

        @Override
        public Promise<String> slowest() {
            return jobs.isEmpty() ? Promise.failed(new IOException("no job")) : new Deferred<>();
        }
    }

    @Test
    void failures_thatAreExpected_areTaken() {
        try (var test = new TestSpace()) {
            Queue queue = test.spawn(Queue.class, JobQueue::new);
            assertThat(test.error(queue.slowest())).hasMessage("no job"); // of a request: the error of its promise

            queue.add(""); // a message without an answer: its error goes to the space
            test.runQueued();
            assertThat(test.takeProblems())
                    .singleElement()
                    .satisfies(problem -> assertThat(problem.error()).hasMessage("a job without a name"));

            test.space().stop(queue);
            queue.add("paint");
            test.runQueued();
            assertThat(test.takeDeadLetters()).hasSize(1);
        } // without take..() this would fail, and name the method to call
    }

    @Test
    void time_isMovedByTheTest() {
        try (var test = new TestSpace()) {
            Queue queue = test.spawn(Queue.class, JobQueue::new);
            queue.add("paint");
            Promise<String> slowest = queue.slowest().orTimeout(Duration.ofHours(2));
            test.advance(Duration.ofHours(1));
            assertThat(slowest.isDone()).isFalse();
            test.advance(Duration.ofHours(1));
            assertThat(test.error(slowest)).isInstanceOf(TimeoutException.class);
        }
    }

    @Test
    void valueThatNothingWillBring_isAnErrorAtOnce() {
        try (var test = new TestSpace()) {
            Queue queue = test.spawn(Queue.class, JobQueue::new);
            queue.add("paint");
            Promise<String> slowest = queue.slowest();
            assertThatThrownBy(() -> test.get(slowest))
                    .isInstanceOf(AssertionError.class)
                    .hasMessageStartingWith("nothing is left to do, and ")
                    .hasMessageContaining("still pending");
        }
    }
}
