package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;
import org.jctools.queues.varhandle.MpscVarHandleArrayQueue;
import org.jspecify.annotations.Nullable;

/**
 * The floor: what an actor library must do at least, and nothing else. Every message is an object of a separate class,
 * with typed fields and one virtual method; a question and the promise of its answer are one object. There is a ring
 * for messages and one for callbacks, which run first, and a handler for the exceptions of each turn. The floor has no
 * proxies, no mailboxes, no life cycle, no supervision, no counters and no sleep.
 */
final class FloorContender implements Contender {
    private static final int SLOTS = 1 << 16;
    private static final int SPINS_BEFORE_YIELD = 20;

    private final CompletionLatch finish = new CompletionLatch();
    private final Loop loop = new Loop();
    private final Counter counter = new Counter(loop, finish);
    private final Counter other = new Counter(loop, finish);
    private final List<Counter> created = new ArrayList<>();
    private final Thread thread;

    FloorContender() {
        counter.partner = other;
        other.partner = counter;
        thread = Thread.ofPlatform().daemon().name("floor").start(loop);
    }

    /** A message or a callback: an entry of a queue of the loop. */
    public abstract static class Entry {
        /** Handles this entry; on the loop's thread. */
        public abstract void run() throws Exception;
    }

    /** The receiving thread and its queues: one for other threads, and two rings for itself. */
    static final class Loop implements Runnable {
        private static final int RENEWAL = (1 << 10) - 1;

        private final MpscVarHandleArrayQueue<Entry> inbox = new MpscVarHandleArrayQueue<>(SLOTS);
        private final Ring messages = new Ring();
        private final Ring callbacks = new Ring();
        private volatile boolean resting;
        private volatile boolean over;

        /** Sends a message from another thread. */
        void send(Entry message) {
            while (!inbox.offer(message)) {
                Thread.yield();
            }
        }

        @Override
        public void run() {
            int passes = 0;
            int spins = 0;
            while (!over) {
                boolean worked = drain();
                if ((++passes & RENEWAL) == 0) {
                    messages.renew();
                    callbacks.renew();
                }
                spins = worked ? 0 : (spins + 1) & Integer.MAX_VALUE;
                if (worked) {
                    continue;
                }
                if (resting) {
                    LockSupport.park();
                } else if (spins % SPINS_BEFORE_YIELD == SPINS_BEFORE_YIELD - 1) {
                    Thread.yield();
                } else {
                    Thread.onSpinWait();
                }
            }
        }

        /** Runs up to a thousand entries; false if there was none. */
        private boolean drain() {
            for (int count = 0; count < RENEWAL; count++) {
                Entry entry = callbacks.poll();
                if (entry == null) {
                    entry = messages.poll();
                }
                if (entry == null) {
                    entry = inbox.poll();
                }
                if (entry == null) {
                    return count > 0;
                }
                try {
                    entry.run();
                } catch (Throwable thrown) {
                    var here = Thread.currentThread();
                    here.getUncaughtExceptionHandler().uncaughtException(here, thrown);
                }
            }
            return true;
        }
    }

    /** A growing ring of entries. */
    private static final class Ring {
        private static final int SMALL = 256;

        private @Nullable Entry[] entries = new Entry[SMALL];
        private int head;
        private int tail;

        void add(Entry entry) {
            if (tail - head == entries.length) {
                moveTo(new Entry[2 * entries.length]);
            }
            entries[tail++ & (entries.length - 1)] = entry;
        }

        @Nullable
        Entry poll() {
            if (head == tail) {
                return null;
            }
            int place = head++ & (entries.length - 1);
            Entry entry = entries[place];
            entries[place] = null;
            return entry;
        }

        /** Replaces the array: storing into an array that the collector has promoted is slower. */
        void renew() {
            if (tail - head < SMALL) {
                moveTo(new Entry[SMALL]);
            }
        }

        private void moveTo(@Nullable Entry[] fresh) {
            for (int place = head; place != tail; place++) {
                fresh[place & (fresh.length - 1)] = entries[place & (entries.length - 1)];
            }
            entries = fresh;
        }
    }

    /** A question: the message, and the promise of its answer with at most one listener. */
    private abstract static class Question<T> extends Entry {
        private final Loop loop;
        private @Nullable Object state; // a listener, then the answer

        Question(Loop loop) {
            this.loop = loop;
        }

        /** The answer. */
        abstract T answer();

        @Override
        public final void run() {
            T answer = answer();
            Object listener = state;
            state = answer;
            if (listener != null) {
                loop.callbacks.add((Entry) listener);
            }
        }

        /** Registers the listener; on the loop's thread. */
        final void then(Consumer<? super T> action) {
            state = new Listener<>(this, action);
        }

        @SuppressWarnings("unchecked") // called when the state is the answer
        private T answered() {
            return (T) Objects.requireNonNull(state);
        }
    }

    private static final class Listener<T> extends Entry {
        private final Question<T> question;
        private final Consumer<? super T> action;

        Listener(Question<T> question, Consumer<? super T> action) {
            this.question = question;
            this.action = action;
        }

        @Override
        public void run() {
            action.accept(question.answered());
        }
    }

    /** The actor. */
    private static final class Counter {
        private final Loop loop;
        private final CompletionLatch finish;
        private Counter partner = this;
        private int sum;
        private int left;

        Counter(Loop loop, CompletionLatch finish) {
            this.loop = loop;
            this.finish = finish;
        }

        void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        void ping(int hops) {
            if (hops == 0) {
                finish.reach();
            } else {
                loop.messages.add(new Ping(partner, hops - 1));
            }
        }

        void askPartner(int asks) {
            var question = new Sum(partner);
            loop.messages.add(question);
            question.then(answer -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(asks - 1);
                }
            });
        }
    }

    private static final class Expect extends Entry {
        private final Counter to;
        private final int messages;

        Expect(Counter to, int messages) {
            this.to = to;
            this.messages = messages;
        }

        @Override
        public void run() {
            to.left = messages;
        }
    }

    private static final class Add extends Entry {
        private final Counter to;
        private final int amount;

        Add(Counter to, int amount) {
            this.to = to;
            this.amount = amount;
        }

        @Override
        public void run() {
            to.add(amount);
        }
    }

    private static final class Ping extends Entry {
        private final Counter to;
        private final int hops;

        Ping(Counter to, int hops) {
            this.to = to;
            this.hops = hops;
        }

        @Override
        public void run() {
            to.ping(hops);
        }
    }

    private static final class AskPartner extends Entry {
        private final Counter to;
        private final int asks;

        AskPartner(Counter to, int asks) {
            this.to = to;
            this.asks = asks;
        }

        @Override
        public void run() {
            to.askPartner(asks);
        }
    }

    private static final class Sum extends Question<Integer> {
        private final Counter to;

        Sum(Counter to) {
            super(to.loop);
            this.to = to;
        }

        @Override
        Integer answer() {
            return to.sum;
        }
    }

    /** A question from outside: its listener runs on the loop's thread, in the turn of the question. */
    private static final class SumFromOutside extends Entry {
        private final Counter to;
        private final Consumer<Integer> listener;

        SumFromOutside(Counter to, Consumer<Integer> listener) {
            this.to = to;
            this.listener = listener;
        }

        @Override
        public void run() {
            listener.accept(to.sum);
        }
    }

    /** A question whose caller spins until it is answered. */
    private static final class SumAwaited extends Entry {
        private final Counter to;
        private volatile @Nullable Integer answer;

        SumAwaited(Counter to) {
            this.to = to;
        }

        @Override
        public void run() {
            answer = to.sum;
        }
    }

    private static final class Begin extends Entry {
        private final Counter to;
        private final AtomicInteger beginners;

        Begin(Counter to, AtomicInteger beginners) {
            this.to = to;
            this.beginners = beginners;
        }

        @Override
        public void run() {
            to.sum++;
            if (beginners.decrementAndGet() == 0) {
                to.finish.reach();
            }
        }
    }

    private void sendAndAwait(Entry message) {
        finish.reset();
        loop.send(message);
        finish.await();
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        loop.send(new Expect(counter, messages));
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                loop.send(new Add(counter, i));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(FloorFamily.class, (Consumer<Entry>) loop::send, tally);
    }

    @Override
    public void pingPong(int hops) {
        sendAndAwait(new Ping(counter, hops));
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            loop.send(new SumFromOutside(counter, answer -> {
                if (left.decrementAndGet() == 0) {
                    finish.reach();
                }
            }));
        }
        finish.await();
    }

    @Override
    public void askChain(int asks) {
        sendAndAwait(new AskPartner(counter, asks));
    }

    @Override
    public void askOnce(int asks) {
        for (int i = 0; i < asks; i++) {
            var question = new SumAwaited(counter);
            loop.send(question);
            for (int spins = 1; question.answer == null; spins++) {
                if (spins % SPINS_BEFORE_YIELD == 0) {
                    Thread.yield();
                } else {
                    Thread.onSpinWait();
                }
            }
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = new Counter(loop, finish);
            created.add(newcomer);
            loop.send(new Begin(newcomer, beginners));
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.clear();
    }

    @Override
    public void wake() {
        loop.resting = false;
        LockSupport.unpark(thread);
    }

    @Override
    public void rest() {
        loop.resting = true;
    }

    @Override
    public void close() {
        loop.over = true;
        wake();
    }
}
