package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Tests on real threads: with latches only, and long time limits. */
@Tag("threads")
@Timeout(60)
class TopicThreadTest {
    private static final Duration LONG = Duration.ofSeconds(30);
    private static final int PUBLISHERS = 3;
    private static final int EACH = 20_000;

    record Reading(int publisher, int number) {}

    interface Recorder {
        Promise<List<Reading>> heard();
    }

    public static class Listening extends Actor implements Recorder {
        private final Topic<Reading> topic;
        private final CountDownLatch all;
        private final List<Reading> heard = new ArrayList<>();

        Listening(Topic<Reading> topic, CountDownLatch all) {
            this.topic = topic;
            this.all = all;
        }

        @Override
        protected void started() {
            topic.subscribe(new Callback.Stream<>(heard::add, end -> all.countDown()));
        }

        @Override
        public Promise<List<Reading>> heard() {
            return Promise.of(heard);
        }
    }

    @Test
    void publishersOnSeveralThreads_reachAllSpaces_inOneOrder_whileOthersComeAndGo() throws Exception {
        try (var left = ActorSpace.create(SpaceSettings.named("left"));
                var right = ActorSpace.create(SpaceSettings.named("right"))) {
            Topic<Reading> topic = Topic.of(left, "readings");
            var all = new CountDownLatch(2);
            Recorder first = left.spawn(Recorder.class, () -> new Listening(topic, all));
            Recorder second = right.spawn(Recorder.class, () -> new Listening(topic, all));
            first.heard().get(LONG);
            second.heard().get(LONG);
            var publishing = new AtomicBoolean(true);
            var passing = new AtomicInteger();
            Thread passer = Thread.ofPlatform().start(() -> {
                while (publishing.get()) {
                    topic.subscribe(value -> {}).cancel();
                    passing.incrementAndGet();
                }
            });
            var publishers = new ArrayList<Thread>();
            var tooFew = new AtomicInteger();
            for (int publisher = 0; publisher < PUBLISHERS; publisher++) {
                int id = publisher;
                publishers.add(Thread.ofPlatform().start(() -> {
                    for (int number = 0; number < EACH; number++) {
                        if (topic.publish(new Reading(id, number)) < 2) {
                            tooFew.incrementAndGet();
                        }
                    }
                }));
            }
            for (var thread : publishers) {
                thread.join();
            }
            publishing.set(false);
            passer.join();
            topic.finish();
            assertThat(all.await(30, TimeUnit.SECONDS)).isTrue();

            var heard = first.heard().get(LONG);
            assertThat(heard)
                    .hasSize(PUBLISHERS * EACH)
                    .isEqualTo(second.heard().get(LONG));
            assertThat(tooFew).hasValue(0);
            assertThat(passing.get()).isPositive();
            for (int publisher = 0; publisher < PUBLISHERS; publisher++) {
                int id = publisher;
                assertThat(heard.stream()
                                .filter(reading -> reading.publisher == id)
                                .map(Reading::number))
                        .isSorted()
                        .hasSize(EACH)
                        .doesNotHaveDuplicates();
            }
        }
    }

    @Test
    void lateSubscriber_ofALatestTopic_missesNothingAndReceivesNothingTwice() throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("late"))) {
            Topic<Integer> topic = Topic.latest(space, "count");
            var subscribing = new CountDownLatch(1);
            Thread publisher = Thread.ofPlatform().start(() -> {
                for (int number = 0; number < EACH; number++) {
                    topic.publish(number);
                    if (number == EACH / 100) {
                        subscribing.countDown();
                    }
                }
                topic.finish();
            });
            assertThat(subscribing.await(30, TimeUnit.SECONDS)).isTrue();
            var rounds = new ArrayList<List<Integer>>();
            var ends = new ArrayList<CountDownLatch>();
            for (int round = 0; round < 50; round++) {
                var heard = new ArrayList<Integer>();
                var end = new CountDownLatch(1);
                topic.subscribe(new Callback.Stream<>(heard::add, error -> end.countDown()));
                rounds.add(heard);
                ends.add(end);
            }
            publisher.join();
            for (var end : ends) {
                assertThat(end.await(30, TimeUnit.SECONDS)).isTrue();
            }
            for (var heard : rounds) {
                for (int i = 1; i < heard.size(); i++) {
                    assertThat(heard.get(i)).isEqualTo(heard.get(i - 1) + 1);
                }
                if (!heard.isEmpty()) {
                    assertThat(heard.getLast()).isEqualTo(EACH - 1);
                }
            }
        }
    }

    @Test
    void slowSubscriber_holdsUpNeitherPublisherNorTheOthers() throws Exception {
        try (var slow = ActorSpace.create(SpaceSettings.named("slow"));
                var quick = ActorSpace.create(SpaceSettings.named("quick"))) {
            Topic<Integer> topic = Topic.of(quick, "count");
            var stuck = new CountDownLatch(1);
            var goOn = new CountDownLatch(1);
            var heardQuickly = new CountDownLatch(1_000);
            var heardSlowly = new CountDownLatch(1_000);
            var subscribed = new CountDownLatch(1);
            var interrupted = new AtomicReference<Throwable>();
            slow.execute(() -> {
                topic.subscribe(value -> {
                    stuck.countDown();
                    try {
                        goOn.await();
                    } catch (InterruptedException e) {
                        interrupted.set(e);
                    }
                    heardSlowly.countDown();
                });
                subscribed.countDown();
            });
            assertThat(subscribed.await(30, TimeUnit.SECONDS)).isTrue();
            topic.subscribe(value -> heardQuickly.countDown());
            topic.publish(0);
            assertThat(stuck.await(30, TimeUnit.SECONDS)).isTrue();
            for (int i = 1; i < 1_000; i++) {
                assertThat(topic.publish(i)).isEqualTo(2);
            }
            assertThat(heardQuickly.await(30, TimeUnit.SECONDS)).isTrue();
            assertThat(heardSlowly.getCount()).isEqualTo(1_000);
            goOn.countDown();
            assertThat(heardSlowly.await(30, TimeUnit.SECONDS)).isTrue();
            assertThat(interrupted).hasNullValue();
        }
    }
}
