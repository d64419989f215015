package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatNullPointerException;

import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.Flow;
import java.util.concurrent.SubmissionPublisher;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import org.reactivestreams.tck.TestEnvironment;
import org.reactivestreams.tck.flow.FlowPublisherVerification;
import org.testng.TestListenerAdapter;
import org.testng.TestNG;

/** Topics and callbacks as publishers of reactive streams; and the kit that these publish for such publishers. */
@Execution(ExecutionMode.CONCURRENT)
class PublisherTest extends InTestSpace {
    private final Topic<Integer> topic = Topic.of(test.space(), "range");

    /** Logs what it receives. */
    private class Reader implements Flow.Subscriber<Integer> {
        private Flow.@Nullable Subscription subscription;

        Flow.Subscription subscription() {
            return Objects.requireNonNull(subscription);
        }

        @Override
        public void onSubscribe(Flow.Subscription fresh) {
            subscription = fresh;
        }

        @Override
        public void onNext(Integer value) {
            log.add("got " + value);
        }

        @Override
        public void onError(Throwable error) {
            log.add("failed: " + error.getMessage());
        }

        @Override
        public void onComplete() {
            log.add("complete");
        }
    }

    private Reader subscribe(int capacity) {
        var reader = new Reader();
        test.space().<Integer>publisher(capacity, topic::subscribe).subscribe(reader);
        test.runQueued();
        return reader;
    }

    private void publish(int from, int to) {
        IntStream.rangeClosed(from, to).forEach(topic::publish);
        test.runQueued();
    }

    private void request(Reader reader, long count) {
        reader.subscription().request(count);
        test.runQueued();
    }

    @Test
    void subscriber_receivesWhatItRequests_andThenTheEnd() {
        Reader reader = subscribe(Integer.MAX_VALUE);
        publish(1, 3);
        assertThat(log).isEmpty();
        request(reader, 2);
        assertThat(log).containsExactly("got 1", "got 2");
        topic.finish();
        test.runQueued();
        assertThat(log).hasSize(2);
        request(reader, 1);
        assertThat(log).containsExactly("got 1", "got 2", "got 3", "complete");
    }

    @Test
    void subscriberThatRequestsTooLittle_dropsWhatHasNoRoom() {
        Reader reader = subscribe(2);
        publish(1, 3);
        publish(4, 4);
        assertThat(reader.subscription()).asString().endsWith("stream, dropped 2");
        request(reader, Long.MAX_VALUE);
        request(reader, Long.MAX_VALUE);
        publish(5, 5);
        topic.fail(new IllegalStateException("unplugged"));
        test.runQueued();
        assertThat(log).containsExactly("got 3", "got 4", "got 5", "failed: unplugged");
    }

    @Test
    void longQueue_leavesTimeForOthers() {
        Reader reader = subscribe(Integer.MAX_VALUE);
        publish(1, 200);
        test.run(() -> {
            reader.subscription().request(200);
            Promise.done().thenRun(() -> log.add("other"));
        });
        assertThat(log).hasSize(201);
        assertThat(log.indexOf("other")).isEqualTo(64);
    }

    @Test
    void cancelledSubscriber_isForgottenByItsTopic() {
        Reader reader = subscribe(Integer.MAX_VALUE);
        request(reader, 10);
        publish(1, 1);
        topic.publish(2);
        reader.subscription().cancel();
        test.runQueued();
        assertThat(log).containsExactly("got 1");
        assertThat(topic.publish(3)).isZero();
        assertThat(topic.subscribers()).isZero();
    }

    @Test
    void subscriberThatThrows_isCancelled_andItsActorFails() {
        class Broken extends Actor {
            @Override
            protected void started() {
                context().space().<Integer>publisher(topic::subscribe).subscribe(new Reader() {
                    @Override
                    public void onNext(Integer value) {
                        throw new IllegalStateException("cannot use " + value);
                    }

                    @Override
                    public void onSubscribe(Flow.Subscription fresh) {
                        fresh.request(9);
                    }
                });
            }
        }
        test.spawn(Broken.class, Broken::new);
        test.runQueued();
        publish(1, 2);
        assertThat(test.takeProblems()).singleElement().satisfies(problem -> {
            assertThat(problem.where()).isEqualTo("a listener of Broken#1");
            assertThat(problem.error()).hasMessage("cannot use 1");
        });
        assertThat(topic.subscribers()).isZero();
    }

    @Test
    void subscriberThatHasStopped_receivesNothing() {
        class Stopping extends Actor {
            @Override
            protected void started() {
                var reader = new Reader();
                context().space().<Integer>publisher(topic::subscribe).subscribe(reader);
                context().after(Duration.ZERO, () -> reader.subscription().request(9));
            }
        }
        Stopping actor = test.spawn(Stopping.class, Stopping::new);
        test.runQueued();
        publish(1, 1);
        stop(actor);
        publish(2, 2);
        assertThat(log).containsExactly("got 1");
        assertThat(topic.subscribers()).isZero();
    }

    @Test
    void sourceThatThrows_orANullResult_isTheFailureOfTheStream() {
        Flow.Publisher<Integer> broken = test.space().publisher(callback -> {
            throw new IllegalStateException("no source");
        });
        broken.subscribe(new Reader());
        Flow.Publisher<Integer> empty = test.space().publisher(callback -> callback.accept(null, null));
        empty.subscribe(new Reader());
        test.runQueued();
        assertThat(log)
                .containsExactly("failed: no source", "failed: a result is null, which a publisher cannot pass on");
        assertThatNullPointerException()
                .isThrownBy(() -> broken.subscribe(null))
                .withMessage("subscriber");
    }

    @Test
    void subscriptionOnAClosedSpace_fails() {
        var closed = new TestSpace();
        Flow.Publisher<Integer> publisher = closed.space().publisher(topic::subscribe);
        closed.close();
        publisher.subscribe(new Reader());
        assertThat(log).singleElement().asString().startsWith("failed: subscribe(..) came too late");
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void otherLibraries_canSubscribe() throws Exception {
        List<Integer> received = new ArrayList<>();
        var processor = new SubmissionPublisher<Integer>(); // the subscriber closes it
        try (var space = ActorSpace.create(SpaceSettings.named("published"))) {
            Flow.Publisher<Integer> publisher = space.publisher(callback -> {
                IntStream.range(0, 1_000).forEach(callback::next);
                callback.finish();
            });
            var all = processor.consume(received::add);
            publisher.subscribe(new Flow.Subscriber<>() {
                @Override
                public void onSubscribe(Flow.Subscription subscription) {
                    subscription.request(Long.MAX_VALUE);
                }

                @Override
                public void onNext(Integer value) {
                    processor.submit(value);
                }

                @Override
                public void onError(Throwable error) {
                    processor.closeExceptionally(error);
                }

                @Override
                public void onComplete() {
                    processor.close();
                }
            });
            all.get(30, TimeUnit.SECONDS);
        }
        assertThat(received).isEqualTo(IntStream.range(0, 1_000).boxed().toList());
    }

    // ---- the kit

    /** Run by TestNG: a space, and publishers of it whose source is another thread. */
    public static class Verification extends FlowPublisherVerification<Integer> {
        private static final long TIMEOUT_MILLIS = 3_000; // for what has to happen; four of its tests take that long
        private static final long SILENCE_MILLIS = 50; // for what must not happen

        private final ActorSpace space = ActorSpace.create(SpaceSettings.named("verified"));

        public Verification() {
            super(new TestEnvironment(TIMEOUT_MILLIS, SILENCE_MILLIS), TIMEOUT_MILLIS);
        }

        @Override
        public Flow.Publisher<Integer> createFlowPublisher(long elements) {
            return space.publisher(
                    1_024,
                    callback -> Thread.ofVirtual().start(() -> {
                        for (int number = 0; number < elements && !callback.isCancelled(); number++) {
                            callback.next(number);
                        }
                        if (!callback.isCancelled()) {
                            callback.finish();
                        }
                    }));
        }

        @Override
        public Flow.Publisher<Integer> createFailedFlowPublisher() {
            return space.publisher(callback -> callback.fail(new IllegalStateException("expected by the kit")));
        }
    }

    @Test
    @Tag("threads")
    @Timeout(300)
    void publisher_passesTheKitOfReactiveStreams() {
        var results = new TestListenerAdapter();
        var kit = new TestNG(false); // without reports
        kit.setVerbose(0);
        kit.setTestClasses(new Class<?>[] {Verification.class});
        kit.addListener(results);
        kit.run();
        assertThat(results.getFailedTests())
                .extracting(failed -> failed.getName() + ": " + failed.getThrowable())
                .isEmpty();
        assertThat(results.getPassedTests()).hasSizeGreaterThan(20);
        assertThat(results.getSkippedTests())
                .allSatisfy(skipped ->
                        assertThat(skipped.getName()).startsWith("untested_")); // no test of them is possible
    }
}
