package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Topic;
import io.troupe.actor.promise.Deferred;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;

/** Topics and callbacks with several publishers, while subscribers are added and removed. */
final class StreamRaces {
    private static final int PUBLISHERS = 3;
    private static final int VALUES = 200;

    private StreamRaces() {}

    record Value(int publisher, int number) {}

    interface Source {
        /** Lets all threads of the round send to the callback. */
        void hold(Callback<Value> callback);

        void send(int publisher, int count, Callback<Value> callback);
    }

    private static final class Sending implements Source {
        private final Deferred<Callback<Value>> held;

        Sending(Deferred<Callback<Value>> held) {
            this.held = held;
        }

        @Override
        public void hold(Callback<Value> callback) {
            held.resolve(callback);
        }

        @Override
        public void send(int publisher, int count, Callback<Value> callback) {
            for (int number = 0; number < count; number++) {
                callback.next(new Value(publisher, number));
            }
            callback.finish();
        }
    }

    /** What one subscriber received; on its space. */
    private static final class Got {
        final List<Value> values = new ArrayList<>();
        final AtomicInteger ends = new AtomicInteger();
        final Callback.Stream<Value> stream = new Callback.Stream<>(values::add, end -> ends.incrementAndGet());

        void check(int publishers) {
            assertThat(values).hasSize(publishers * VALUES);
            checkOrder();
            assertThat(ends.get()).as("ends").isEqualTo(1);
        }

        void checkOrder() {
            var last = new int[PUBLISHERS];
            java.util.Arrays.fill(last, -1);
            for (var value : values) {
                int before = last[value.publisher];
                assertThat(before < 0 || value.number == before + 1)
                        .as("%s after number %d", value, before)
                        .isTrue();
                last[value.publisher] = value.number;
            }
        }
    }

    static void play(Round round) throws Exception {
        var home = round.space("home");
        var other = round.space("other");
        var holding = new Deferred<Callback<Value>>();
        Source source = home.spawn(Source.class, () -> new Sending(holding));
        var topic = Topic.<Value>of(home, "values");
        var outside = new Got();
        topic.subscribe(outside.stream);
        var inside = new Got();
        Round.get(other.sequential(() -> {
            topic.subscribe(inside.stream);
            return true;
        }));
        var shared = new Got();
        if (round.random.nextBoolean()) {
            source.hold(shared.stream);
        } else {
            other.execute(() -> source.hold(shared.stream));
        }
        Callback<Value> held = Round.get(holding);
        var single = new Got();
        source.send(0, VALUES, single.stream);
        var singleInside = new Got();
        other.execute(() -> source.send(0, VALUES, singleInside.stream));
        var coming = new ArrayList<Temporary>();
        var spaces = List.of(home, other);
        boolean fromSpaces = round.random.nextBoolean();
        round.start(PUBLISHERS + 1, (number, random) -> {
            if (number == PUBLISHERS) {
                for (int i = 0; i < 30; i++) {
                    coming.add(Temporary.comeAndGo(topic, spaces.get(i % 2), random));
                }
            } else if (fromSpaces && number < 2) { // and the third from outside
                spaces.get(number).execute(() -> publish(number, topic, held, random));
            } else {
                publish(number, topic, held, random);
            }
        });
        round.join();
        for (var space : spaces) {
            assertThat(Round.get(space.sequential(() -> true))).isTrue();
        }
        assertThat(topic.subscribers()).isEqualTo(2);
        assertThat(topic.finish()).isTrue();
        held.finish();
        for (var got : List.of(outside, shared, inside, single, singleInside)) {
            Round.until("a stream has ended", () -> got.ends.get() == 1);
        }
        round.end();
        outside.check(PUBLISHERS);
        inside.check(PUBLISHERS);
        shared.check(PUBLISHERS);
        single.check(1);
        singleInside.check(1);
        assertThat(inside.values).as("the order of both subscribers").isEqualTo(outside.values);
        for (var each : coming) {
            each.check();
        }
        assertThat(round.errors).isEmpty();
    }

    private static void publish(int number, Topic<Value> topic, Callback<Value> held, SplittableRandom random) {
        for (int i = 0; i < VALUES; i++) {
            var value = new Value(number, i);
            topic.publish(value);
            held.next(value);
            if (i % 32 == 0) {
                Round.pause(random);
            }
        }
    }

    /** Subscribes in a space and cancels there: afterwards it receives nothing. */
    private static final class Temporary {
        private final Got got = new Got();
        private @Nullable Integer whenCancelled;

        static Temporary comeAndGo(Topic<Value> topic, ActorSpace space, SplittableRandom random) throws Exception {
            var temporary = new Temporary();
            var subscribed = new Deferred<Boolean>();
            space.execute(() -> {
                topic.subscribe(temporary.got.stream);
                subscribed.resolve(true);
            });
            Round.get(subscribed);
            Round.pause(random);
            space.execute(() -> {
                temporary.got.stream.cancel();
                temporary.whenCancelled = temporary.got.values.size();
            });
            return temporary;
        }

        void check() {
            assertThat(whenCancelled).as("values when it was cancelled").isEqualTo(got.values.size());
            assertThat(got.ends.get()).isEqualTo(1);
            got.checkOrder();
        }
    }
}
