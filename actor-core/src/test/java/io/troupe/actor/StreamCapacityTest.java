package io.troupe.actor;

import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onAnotherThread;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** What a slow subscriber receives, what it skips, and how much it costs. */
class StreamCapacityTest extends InTestSpace {
    private static final int MANY = 100_000;
    private static final int PUBLISHERS = 3;
    private static final int EACH = 20_000;

    private final Topic<Integer> topic = Topic.of(test.space(), "range");

    /** Stores the callback of its caller. */
    interface Sensor {
        void readings(Callback<Integer> readings);
    }

    record Frame(int number) {}

    private Callback.Stream<Integer> stream(int capacity) {
        return new Callback.Stream<>(capacity, value -> log.add("got " + value), end -> log.add("end " + end));
    }

    @Test
    void newest_skipsWhatWasReplacedBeforeItWasReceived_andCountsIt() {
        var newest = topic.subscribe(1, value -> log.add("newest " + value));
        topic.subscribe(value -> log.add("all " + value));
        topic.publish(1);
        topic.publish(2);
        assertThat(topic.publish(3)).isEqualTo(2);
        test.runQueued();
        assertThat(log).containsExactly("newest 3", "all 1", "all 2", "all 3");
        assertThat(newest.dropped()).isEqualTo(2);
        topic.publish(4);
        test.runQueued();
        assertThat(log).endsWith("newest 4", "all 4");
        assertThat(newest.dropped()).isEqualTo(2);
    }

    @Test
    void newestFew_areKeptInOrder_andTheEndFollowsThem() {
        var few = stream(3);
        topic.subscribe(few);
        for (int value = 1; value <= 10; value++) {
            topic.publish(value);
        }
        topic.finish();
        test.runQueued();
        assertThat(log).containsExactly("got 8", "got 9", "got 10", "end null");
        assertThat(few.dropped()).isEqualTo(7);
    }

    @Test
    void callbackArgument_choosesAsATopicsSubscriberDoes_alsoIfOtherThreadsSend() {
        var readings = new AtomicReference<@Nullable Callback<Integer>>();
        Sensor sensor = test.spawn(Sensor.class, () -> readings::set);
        var newest = stream(2);
        sensor.readings(newest);
        test.runQueued();
        test.run(() -> {
            Callback<Integer> to = readings.get();
            to.next(1);
            onAnotherThread(() -> to.next(2));
            to.next(3);
            onAnotherThread(() -> to.next(4));
            to.fail(new IllegalStateException("unplugged"));
        });
        assertThat(log).containsExactly("got 3", "got 4", "end java.lang.IllegalStateException: unplugged");
        assertThat(newest.dropped()).isEqualTo(2);
    }

    @Test
    void capacityOfNothing_isRejected() {
        assertThatThrownBy(() -> topic.subscribe(0, value -> {})).hasMessage("capacity is 0, expected 1 or more");
    }

    /** Between two runs a subscriber that keeps n values receives the last n of those published. */
    @Test
    void randomBursts_leaveTheNewestOfEach() {
        long seed = System.nanoTime();
        var random = new Random(seed);
        int most = 1 + random.nextInt(8);
        List<Integer> expected = new ArrayList<>();
        List<Integer> received = new ArrayList<>();
        var some = topic.subscribe(most, received::add);
        int published = 0;
        for (int round = 0; round < 500; round++) {
            int burst = random.nextInt(2 * most + 2);
            for (int value = 0; value < burst; value++) {
                int next = published++;
                if (random.nextInt(50) == 0) {
                    onAnotherThread(() -> topic.publish(next));
                } else {
                    topic.publish(next);
                }
                if (burst - value <= most) {
                    expected.add(next);
                }
            }
            test.runQueued();
        }
        assertThat(received).as("seed %s", seed).isEqualTo(expected);
        assertThat(some.dropped()).as("seed %s", seed).isEqualTo(published - expected.size());
    }

    @Test
    void slowSubscriber_costsBoundedMemory_howeverMuchIsPublished() {
        Topic<Frame> frames = Topic.of(test.space(), "frames");
        var few = frames.subscribe(5, frame -> log.add("frame " + frame.number));
        for (int number = 0; number < MANY; number++) {
            frames.publish(new Frame(number));
        }
        assertThat(test.space().metrics().waiting()).isEqualTo(5);
        assertThat(Reachable.from(test.space()))
                .filteredOn(Frame.class::isInstance)
                .hasSize(5);
        test.runQueued();
        assertThat(log).containsExactly("frame 99995", "frame 99996", "frame 99997", "frame 99998", "frame 99999");
        assertThat(few.dropped()).isEqualTo(MANY - 5);
    }

    @Test
    void subscriberThatHasStopped_receivesNothing_andIsForgotten() {
        class Reader extends Actor {
            @Override
            protected void started() {
                topic.subscribe(1, value -> log.add("got " + value));
            }
        }
        Reader reader = test.spawn(Reader.class, Reader::new);
        test.runQueued();
        topic.publish(1);
        topic.publish(2);
        test.space().stop(reader); // queued behind the values, which are callbacks
        test.runQueued();
        assertThat(log).containsExactly("got 2");
        assertThat(topic.publish(3)).isZero();
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void publishersOnSeveralThreads_areReceivedOrCounted_inTheOrderOfEach() throws Exception {
        try (var slow = ActorSpace.create(SpaceSettings.named("slow"))) {
            Topic<List<Integer>> numbers = Topic.of(slow, "numbers");
            List<List<Integer>> received = new ArrayList<>();
            var end = new CountDownLatch(1);
            var few = new Callback.Stream<List<Integer>>(4, received::add, error -> end.countDown());
            numbers.subscribe(few);
            onThreads(
                    PUBLISHERS,
                    publisher ->
                            IntStream.range(0, EACH).forEach(number -> numbers.publish(List.of(publisher, number))));
            numbers.finish();
            await(end);
            assertThat(received.size() + few.dropped()).isEqualTo((long) PUBLISHERS * EACH);
            for (int publisher = 0; publisher < PUBLISHERS; publisher++) {
                int mine = publisher;
                assertThat(received.stream()
                                .filter(value -> value.get(0) == mine)
                                .map(value -> value.get(1)))
                        .isSorted();
            }
        }
    }

    /** The value that was queued without a ticket is taken back, so that the subscriber does not starve. */
    @Test
    @Tag("threads")
    @Timeout(60)
    void publishing_atTheEndOfThePublishersStack_leavesTheSubscriberReceiving() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep"))) {
            Topic<Integer> values = Topic.of(space, "values");
            var last = new CountDownLatch(1);
            values.subscribe(1, value -> {
                if (value == Integer.MAX_VALUE) {
                    last.countDown();
                }
            });
            for (int call = 0; call < 3; call++) {
                values.publish(call); // the JVM never links what is first used where the stack is exhausted
            }
            for (int round = 0; round < 20; round++) {
                Thread deep = Thread.ofPlatform().start(() -> atTheEnd(() -> values.publish(7)));
                deep.join();
            }
            values.publish(Integer.MAX_VALUE);
            await(last);
        }
    }

    /** Every result that was stored is received before the end, though some had no ticket for a while. */
    @Test
    @Tag("threads")
    @Timeout(60)
    void sending_atTheEndOfTheSendersStack_leavesNoResultBehind() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("deep"))) {
            var ends = new CountDownLatch(20);
            var received = new ArrayList<Integer>();
            for (int round = 0; round < 20; round++) {
                var last = new int[] {-1};
                Callback<Integer> results = ReturningCallback.to(
                        new Callback.Stream<>(value -> last[0] = value, error -> {
                            received.add(last[0]);
                            ends.countDown();
                        }),
                        space.home);
                for (int call = 0; call < 3; call++) {
                    results.next(call); // the JVM never links what is first used where the stack is exhausted
                }
                int depth = round;
                Thread deep = Thread.ofPlatform().start(() -> atTheEnd(() -> results.next(100 + depth)));
                deep.join();
                results.next(1_000 + round);
                results.finish();
            }
            await(ends);
            assertThat(received).isEqualTo(IntStream.range(1_000, 1_020).boxed().toList());
        }
    }

    private static void atTheEnd(Runnable call) {
        try {
            atTheEnd(call);
        } catch (StackOverflowError end) {
            call.run(); // overflows again, somewhere, until enough of the stack is free
        }
    }
}
