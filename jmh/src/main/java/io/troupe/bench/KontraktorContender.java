package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.jspecify.annotations.Nullable;
import org.nustaq.kontraktor.Actor;
import org.nustaq.kontraktor.Actors;
import org.nustaq.kontraktor.IPromise;
import org.nustaq.kontraktor.impl.SimpleScheduler;

/** Kontraktor, the library of the paper, with its defaults: all actors on one scheduler thread. */
final class KontraktorContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final SimpleScheduler scheduler = new SimpleScheduler();
    private final Counter counter = spawn();
    private final Counter other = spawn();
    private final List<Counter> created = new ArrayList<>();

    KontraktorContender() {
        counter.meet(other, finish);
        other.meet(counter, finish);
    }

    private Counter spawn() {
        return Actors.AsActor(Counter.class, scheduler);
    }

    /** The actor; not final, since its proxy is a subclass. */
    @SuppressWarnings("serial") // Kontraktor's actors are serializable, but are never serialized here
    public static class Counter extends Actor<Counter> {
        private @Nullable Counter partner;
        private @Nullable CompletionLatch finish;
        private int sum;
        private int left;

        public void meet(Counter newPartner, CompletionLatch newFinish) {
            partner = newPartner;
            finish = newFinish;
        }

        public void expect(int messages) {
            left = messages;
        }

        public void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        public void hop(int hops) {
            if (hops == 0) {
                finish.reach();
            } else {
                partner.hop(hops - 1);
            }
        }

        public IPromise<Integer> sum() {
            return Actors.resolve(sum);
        }

        public void askPartner(int asks) {
            partner.sum().then((answer, error) -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(asks - 1);
                }
            });
        }

        public void begin(AtomicInteger beginners, CompletionLatch end) {
            if (beginners.decrementAndGet() == 0) {
                end.reach();
            }
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
        return Families.copy(KontraktorFamily.class, scheduler, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.hop(hops);
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.sum().then((answer, error) -> {
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

    /** Waits by a latch, which is faster than Kontraktor's polling {@code await()}. */
    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            var answered = new CountDownLatch(1);
            counter.sum().then((answer, error) -> answered.countDown());
            if (!answered.await(30, TimeUnit.SECONDS)) {
                throw new IllegalStateException("no answer");
            }
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = spawn();
            created.add(newcomer);
            newcomer.begin(beginners, finish);
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.forEach(Actor::stop);
        created.clear();
    }

    @Override
    public void close() {
        counter.stop();
        other.stop();
    }
}
