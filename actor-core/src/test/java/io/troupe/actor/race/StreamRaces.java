package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Topic;
import java.util.ArrayList;
import java.util.Arrays;
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

    /** Passes its callbacks on to the test. */
    interface Source {
        void open(Callback<Value> callback);
    }

    private static void send(Callback<Value> callback) {
        for (int number = 0; number < VALUES; number++) {
            callback.next(new Value(0, number));
        }
        callback.finish();
    }

    /** What one subscriber received; on its space. */
    private static final class Got {
        final List<Value> values = new ArrayList<>();
        final AtomicInteger ends = new AtomicInteger();
        private @Nullable Integer whenCancelled;
        final Callback.Stream<Value> stream = new Callback.Stream<>(values::add, end -> ends.incrementAndGet());

        void check(int publishers) {
            assertThat(values).hasSize(publishers * VALUES);
            checkOrder();
            assertThat(ends.get()).as("ends").isEqualTo(1);
        }

        /** Subscribes in a space and cancels there: afterwards it receives nothing. */
        static Got comeAndGo(Topic<Value> topic, ActorSpace space, SplittableRandom random) throws Exception {
            var got = new Got();
            var subscribed = new Deferred<Boolean>();
            space.execute(() -> {
                topic.subscribe(got.stream);
                subscribed.resolve(true);
            });
            Round.get(subscribed);
            Round.pause(random);
            space.execute(() -> {
                got.stream.cancel();
                got.whenCancelled = got.values.size();
            });
            return got;
        }

        void checkCancelled() {
            assertThat(whenCancelled).as("values when it was cancelled").isEqualTo(values.size());
            assertThat(ends.get()).isEqualTo(1);
            checkOrder();
        }

        private void checkOrder() {
            var last = new int[PUBLISHERS];
            Arrays.fill(last, -1);
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
        Source holder = home.spawn(Source.class, () -> holding::resolve); // all threads of the round send to it
        Source sender = home.spawn(Source.class, () -> StreamRaces::send);
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
            holder.open(shared.stream);
        } else {
            other.execute(() -> holder.open(shared.stream));
        }
        Callback<Value> held = Round.get(holding);
        var single = new Got();
        sender.open(single.stream);
        var singleInside = new Got();
        other.execute(() -> sender.open(singleInside.stream));
        var coming = new ArrayList<Got>();
        var spaces = List.of(home, other);
        boolean fromSpaces = round.random.nextBoolean();
        round.run(PUBLISHERS + 1, (number, random) -> {
            if (number == PUBLISHERS) {
                for (int i = 0; i < 30; i++) {
                    coming.add(Got.comeAndGo(topic, spaces.get(i % 2), random));
                }
            } else if (fromSpaces && number < 2) { // and the third from outside
                spaces.get(number).execute(() -> publish(number, topic, held, random));
            } else {
                publish(number, topic, held, random);
            }
        });
        Round.drain(spaces);
        assertThat(topic.subscribers()).isEqualTo(2);
        assertThat(topic.finish()).isTrue();
        held.finish();
        for (var got : List.of(outside, shared, inside, single, singleInside)) {
            Round.until("a stream has ended", () -> got.ends.get() == 1);
        }
        round.end();
        List.of(outside, inside, shared).forEach(got -> got.check(PUBLISHERS));
        List.of(single, singleInside).forEach(got -> got.check(1));
        assertThat(inside.values).as("the order of both subscribers").isEqualTo(outside.values);
        coming.forEach(Got::checkCancelled);
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
}
