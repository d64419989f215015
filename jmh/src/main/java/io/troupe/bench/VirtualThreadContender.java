package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.LinkedTransferQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** One virtual thread and one {@code LinkedTransferQueue} for each actor; asking is blocking. */
final class VirtualThreadContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final Counter counter = new Counter();
    private final Counter other = new Counter();
    private final List<Counter> created = new ArrayList<>();

    private sealed interface Message {}

    private record Expect(int messages) implements Message {}

    private record Add(int amount) implements Message {}

    private record Ping(Counter from, int hops) implements Message {}

    private record Sum(CompletableFuture<Integer> answer) implements Message {}

    private record AskInTurn(Counter whom, int asks) implements Message {}

    private record Begin(AtomicInteger beginners) implements Message {}

    private record Stop() implements Message {}

    private final class Counter {
        private final LinkedTransferQueue<Message> mailbox = new LinkedTransferQueue<>();
        private int sum;
        private int left;

        Counter() {
            Thread.startVirtualThread(this::receive);
        }

        private void receive() {
            try {
                while (handle(mailbox.take())) {}
            } catch (InterruptedException | ExecutionException failure) {
                throw new IllegalStateException("no caller stops an actor this way", failure);
            }
        }

        private boolean handle(Message message) throws InterruptedException, ExecutionException {
            switch (message) {
                case Expect expect -> left = expect.messages();
                case Add add -> add(add.amount());
                case Ping ping -> ping(ping);
                case Sum ask -> ask.answer().complete(sum);
                case AskInTurn chain -> askInTurn(chain.whom(), chain.asks());
                case Begin begin -> begin(begin.beginners());
                case Stop() -> {
                    return false;
                }
            }
            return true;
        }

        private void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        private void ping(Ping ping) {
            if (ping.hops() == 0) {
                finish.reach();
            } else {
                ping.from().mailbox.add(new Ping(this, ping.hops() - 1));
            }
        }

        private void begin(AtomicInteger beginners) {
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }

        CompletableFuture<Integer> ask() {
            var answer = new CompletableFuture<Integer>();
            mailbox.add(new Sum(answer));
            return answer;
        }

        private void askInTurn(Counter whom, int asks) throws InterruptedException, ExecutionException {
            for (int i = 0; i < asks; i++) {
                whom.ask().get();
            }
            finish.reach();
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        counter.mailbox.add(new Expect(messages));
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                counter.mailbox.add(new Add(i));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(VirtualThreadFamily.class, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.mailbox.add(new Ping(other, hops));
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.ask().thenAccept(answer -> {
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
        counter.mailbox.add(new AskInTurn(other, asks));
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            counter.ask().get(30, TimeUnit.SECONDS);
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = new Counter();
            created.add(newcomer);
            newcomer.mailbox.add(new Begin(beginners));
        }
        finish.await();
    }

    @Override
    public void clear() {
        created.forEach(each -> each.mailbox.add(new Stop()));
        created.clear();
    }

    @Override
    public void close() {
        counter.mailbox.add(new Stop());
        other.mailbox.add(new Stop());
    }
}
