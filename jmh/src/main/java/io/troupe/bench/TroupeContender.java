package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;

/** Troupe: typed calls into one space. */
final class TroupeContender implements Contender {
    private static final Duration LONG = Duration.ofSeconds(30);

    private final CompletionLatch finish = new CompletionLatch();
    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("bench"));
    private final Counter counter = space.spawn(Counter.class, () -> new PlainCounter(finish));
    private final Counter other = space.spawn(Counter.class, () -> new PlainCounter(finish));
    private final List<Counter> created = new ArrayList<>();

    TroupeContender() {
        counter.meet(other);
        other.meet(counter);
    }

    /** The actor. */
    public interface Counter {
        void expect(int messages);

        void add(int amount);

        void meet(Counter partner);

        void ping(int hops);

        void begin(AtomicInteger beginners);

        Promise<Integer> sum();

        void askPartner(int asks);
    }

    private static final class PlainCounter implements Counter {
        private final CompletionLatch finish;
        private Counter partner = this;
        private int sum;
        private int left;

        PlainCounter(CompletionLatch finish) {
            this.finish = finish;
        }

        @Override
        public void expect(int messages) {
            left = messages;
        }

        @Override
        public void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        @Override
        public void meet(Counter newPartner) {
            partner = newPartner;
        }

        @Override
        public void ping(int hops) {
            if (hops == 0) {
                finish.reach();
            } else {
                partner.ping(hops - 1);
            }
        }

        @Override
        public void begin(AtomicInteger beginners) {
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }

        @Override
        public Promise<Integer> sum() {
            return Promise.of(sum);
        }

        @Override
        public void askPartner(int asks) {
            partner.sum().then(answer -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(asks - 1);
                }
            });
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        counter.expect(messages);
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                counter.add(i);
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(TroupeFamily.class, space, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.ping(hops);
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.sum().then(answer -> {
                if (left.decrementAndGet() == 0) {
                    finish.reach();
                }
            });
        }
        finish.await();
    }

    @Override
    public void askChain(int asks) {
        finish.reset();
        counter.askPartner(asks);
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            counter.sum().get(LONG);
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = space.spawn(Counter.class, () -> new PlainCounter(finish));
            created.add(newcomer);
            newcomer.begin(beginners);
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.forEach(space::stop);
        created.clear();
    }

    @Override
    public void close() {
        space.close();
    }
}
