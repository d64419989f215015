package io.troupe.bench;

import io.vertx.core.Context;
import io.vertx.core.Future;
import io.vertx.core.Promise;
import io.vertx.core.VerticleBase;
import io.vertx.core.Vertx;
import io.vertx.core.VertxOptions;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** Vert.x, one event loop: verticles as actors, closures run on their contexts as messages, its futures as answers. */
final class VertxContender implements Contender {
    private final CompletionLatch finish = new CompletionLatch();
    private final Vertx vertx = Vertx.vertx(new VertxOptions().setEventLoopPoolSize(1));
    private final Counter counter = new Counter();
    private final Counter other = new Counter();
    private final List<Future<String>> created = new ArrayList<>();

    VertxContender() throws Exception {
        for (Counter each : List.of(counter, other)) {
            await(vertx.deployVerticle(each));
        }
    }

    private static <T> T await(Future<T> future) throws Exception {
        return future.toCompletionStage().toCompletableFuture().get(30, TimeUnit.SECONDS);
    }

    private final class Counter extends VerticleBase {
        private int sum;
        private int left;

        Context home() {
            return context;
        }

        void add(int amount) {
            sum += amount;
            if (--left == 0) {
                finish.reach();
            }
        }

        void ping(Counter partner, int hops) {
            if (hops == 0) {
                finish.reach();
            } else {
                partner.home().runOnContext(none -> partner.ping(this, hops - 1));
            }
        }

        Future<Integer> sum() {
            Promise<Integer> answer = Promise.promise();
            home().runOnContext(none -> answer.complete(sum));
            return answer.future();
        }

        void askPartner(Counter partner, int asks) {
            partner.sum().onSuccess(answer -> {
                if (asks == 1) {
                    finish.reach();
                } else {
                    askPartner(partner, asks - 1);
                }
            });
        }

        void begin(AtomicInteger beginners) {
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        counter.home().runOnContext(none -> counter.left = messages);
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                int amount = i;
                counter.home().runOnContext(none -> counter.add(amount));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(VertxFamily.class, vertx, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.home().runOnContext(none -> counter.ping(other, hops));
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            counter.sum().onSuccess(answer -> {
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
        counter.home().runOnContext(none -> counter.askPartner(other, asks));
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            await(counter.sum());
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        var beginners = new AtomicInteger(actors);
        for (int i = 0; i < actors; i++) {
            var newcomer = new Counter();
            created.add(vertx.deployVerticle(newcomer)
                    .onSuccess(id -> newcomer.home().runOnContext(none -> newcomer.begin(beginners))));
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
