package io.troupe.bench;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;
import org.jctools.queues.varhandle.MpscVarHandleArrayQueue;

/**
 * The limit that every other time is compared with: the least work for handing messages to one thread. A spinning
 * thread polls a bounded ring of JCTools, with a plain {@code ArrayDeque} for messages of that thread. It has no types,
 * no errors and no parking, and {@code tell} sends one object again and again.
 */
final class Limit implements Contender {
    private static final int SLOTS = 1 << 16;
    private static final int SPINS_BEFORE_YIELD = 20;
    private static final Object ADD = new Object();
    private static final Object END = new Object();

    private final CompletionLatch finish = new CompletionLatch();
    private final MpscVarHandleArrayQueue<Object> inbox = new MpscVarHandleArrayQueue<>(SLOTS);
    private final List<Counter> created = new ArrayList<>();
    private final Thread thread;
    private volatile boolean resting;
    private volatile int expected;
    private int sum;

    Limit() {
        thread = Thread.ofPlatform().daemon().name("limit").start(this::spin);
    }

    private static final class Counter {
        int received;
    }

    private record Ping(Counter to, Counter from, int hops) {}

    private record First(Counter to, AtomicInteger beginners) {}

    private record Chain(int asks) {}

    private static final class Ask {
        private final AtomicInteger left;
        private volatile int answer = -1;

        Ask(AtomicInteger left) {
            this.left = left;
        }
    }

    private record Question(Counter to, int asks) {}

    private record Answer(int sum, int asks) {}

    private void spin() {
        int received = 0;
        int spins = 0;
        while (true) {
            Object message = inbox.poll();
            spins = message == null ? (spins + 1) & Integer.MAX_VALUE : 0;
            if (message == ADD) {
                sum += received++;
                if (received == expected) {
                    received = 0;
                    finish.reach();
                }
            } else if (message == null) {
                pause(spins);
            } else if (message instanceof Task task) {
                task.run();
            } else if (message == END) {
                return;
            } else {
                handle(message);
            }
        }
    }

    private void pause(int spins) {
        if (resting) {
            LockSupport.park();
        } else {
            spinOrYield(spins);
        }
    }

    /**
     * Spins, and yields now and then: two threads that only spin on one core would wait for each other for whole time
     * slices.
     */
    private static void spinOrYield(int spins) {
        if (spins % SPINS_BEFORE_YIELD == SPINS_BEFORE_YIELD - 1) {
            Thread.yield();
        } else {
            Thread.onSpinWait();
        }
    }

    private void handle(Object message) {
        switch (message) {
            case Ask ask -> answer(ask);
            case First first -> begin(first);
            case Ping ping -> pingPongInside(ping);
            default -> askChainInside(((Chain) message).asks());
        }
    }

    private void answer(Ask ask) {
        ask.answer = sum & Integer.MAX_VALUE;
        if (ask.left.decrementAndGet() == 0) {
            finish.reach();
        }
    }

    private void begin(First first) {
        first.to().received++;
        if (first.beginners().decrementAndGet() == 0) {
            finish.reach();
        }
    }

    private void pingPongInside(Ping first) {
        var queue = new ArrayDeque<Ping>();
        queue.add(first);
        for (Ping ping = queue.poll(); ping != null; ping = queue.poll()) {
            ping.to().received++;
            if (ping.hops() > 0) {
                queue.add(new Ping(ping.from(), ping.to(), ping.hops() - 1));
            }
        }
        finish.reach();
    }

    private void askChainInside(int asks) {
        var counter = new Counter();
        var queue = new ArrayDeque<Object>();
        queue.add(new Question(counter, asks));
        for (Object each = queue.poll(); each != null; each = queue.poll()) {
            if (each instanceof Question question) {
                queue.add(new Answer(question.to().received++, question.asks()));
            } else if (each instanceof Answer answer && answer.asks() > 1) {
                queue.add(new Question(counter, answer.asks() - 1));
            }
        }
        finish.reach();
    }

    private void send(Object message) {
        while (!inbox.offer(message)) {
            Thread.yield();
        }
    }

    private void sendAndAwait(Object message) {
        finish.reset();
        send(message);
        finish.await();
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        expected = messages;
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                send(ADD);
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(LimitFamily.class, (Consumer<Object>) this::send, tally);
    }

    @Override
    public void pingPong(int hops) {
        sendAndAwait(new Ping(new Counter(), new Counter(), hops));
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            send(new Ask(left));
        }
        finish.await();
    }

    @Override
    public void askChain(int asks) {
        sendAndAwait(new Chain(asks));
    }

    @Override
    public void askOnce(int asks) {
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            var ask = new Ask(left);
            send(ask);
            for (int spins = 0; ask.answer < 0; spins++) {
                spinOrYield(spins);
            }
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var counter = new Counter();
            created.add(counter);
            send(new First(counter, beginners));
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.clear();
    }

    @Override
    public void wake() {
        resting = false;
        LockSupport.unpark(thread);
    }

    @Override
    public void rest() {
        resting = true;
    }

    @Override
    public void close() {
        wake();
        send(END);
    }

    /**
     * A message that the thread of the limit runs. A class and not an interface, because a virtual call is the cheapest
     * way to tell types apart.
     */
    public abstract static class Task {
        /** Handles this message. */
        public abstract void run();
    }
}
