package io.troupe.bench;

import io.vertx.core.Future;
import io.vertx.core.VerticleBase;
import io.vertx.core.Vertx;
import io.vertx.core.VertxOptions;
import io.vertx.core.eventbus.EventBus;
import io.vertx.core.eventbus.Message;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/**
 * Vert.x, one event loop: verticles with local consumers at the event bus, an address for each kind of message,
 * {@code send} and {@code request}.
 */
final class VertxBusContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final Vertx vertx = Vertx.vertx(new VertxOptions().setEventLoopPoolSize(1));
    private final EventBus bus = vertx.eventBus();
    private final Counter counter = new Counter("counter", "other");
    private final Counter other = new Counter("other", "counter");
    private final List<Future<String>> created = new ArrayList<>();
    private final AtomicInteger beginners = new AtomicInteger();
    private int names;

    VertxBusContender() throws Exception {
        for (Counter each : List.of(counter, other)) {
            await(vertx.deployVerticle(each));
        }
    }

    private static <T> T await(Future<T> future) throws Exception {
        return future.toCompletionStage().toCompletableFuture().get(30, TimeUnit.SECONDS);
    }

    private final class Counter extends VerticleBase {
        private final String name;
        private final String partner;
        private int sum;
        private int left;

        Counter(String name, String partner) {
            this.name = name;
            this.partner = partner;
        }

        @Override
        public Future<?> start() {
            bus.localConsumer(name + ".expect", (Message<Integer> messages) -> left = messages.body());
            bus.localConsumer(name + ".add", this::add);
            bus.localConsumer(name + ".ping", this::ping);
            bus.localConsumer(name + ".sum", (Message<Integer> ask) -> ask.reply(sum));
            bus.localConsumer(name + ".askPartner", (Message<Integer> asks) -> askPartner(asks.body()));
            return Future.succeededFuture();
        }

        private void add(Message<Integer> amount) {
            sum += amount.body();
            if (--left == 0) {
                finish.reach();
            }
        }

        private void ping(Message<Integer> hops) {
            if (hops.body() == 0) {
                finish.reach();
            } else {
                bus.send(partner + ".ping", hops.body() - 1);
            }
        }

        private void askPartner(int asks) {
            bus.<Integer>request(partner + ".sum", 0).onSuccess(answer -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(asks - 1);
                }
            });
        }
    }

    /**
     * The actor of the workload {@code create}: a counter that handles only its first message. So each has one address,
     * as each has one mailbox in other libraries.
     */
    private final class Beginner extends VerticleBase {
        private final String address;

        Beginner(String address) {
            this.address = address;
        }

        @Override
        public Future<?> start() {
            bus.localConsumer(address, (Message<Integer> begin) -> {
                if (beginners.addAndGet(-begin.body()) == 0) {
                    finish.reach();
                }
            });
            return Future.succeededFuture();
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        bus.send("counter.expect", messages);
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                bus.send("counter.add", i);
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(VertxBusFamily.class, vertx, "family" + names++, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        bus.send("counter.ping", hops);
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            bus.<Integer>request("counter.sum", 0).onSuccess(answer -> {
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
        bus.send("counter.askPartner", asks);
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            await(bus.<Integer>request("counter.sum", 0));
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        beginners.set(actors);
        for (int i = 0; i < actors; i++) {
            String address = "beginner" + names++;
            created.add(vertx.deployVerticle(new Beginner(address)).onSuccess(id -> bus.send(address, 1)));
        }
        finish.await();
    }

    @Override
    public void clear() throws Exception {
        var stopped = new ArrayList<Future<Void>>();
        for (Future<String> each : created) {
            stopped.add(vertx.undeploy(await(each)));
        }
        created.clear();
        await(Future.all(stopped));
    }

    @Override
    public void close() {
        vertx.close();
    }
}
