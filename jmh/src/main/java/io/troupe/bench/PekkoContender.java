package io.troupe.bench;

import com.typesafe.config.Config;
import com.typesafe.config.ConfigFactory;
import java.time.Duration;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.apache.pekko.actor.typed.ActorRef;
import org.apache.pekko.actor.typed.ActorSystem;
import org.apache.pekko.actor.typed.Behavior;
import org.apache.pekko.actor.typed.Props;
import org.apache.pekko.actor.typed.javadsl.ActorContext;
import org.apache.pekko.actor.typed.javadsl.AskPattern;
import org.apache.pekko.actor.typed.javadsl.Behaviors;
import org.jspecify.annotations.Nullable;

/** Pekko typed: behaviours over records, its ask pattern with a time-out of ten seconds. */
final class PekkoContender implements Contender {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final String QUIET = "pekko { loglevel = OFF, stdout-loglevel = OFF, log-dead-letters = off }\n";
    private static final String ONE_THREAD = """
            pekko.actor.default-dispatcher {
              type = Dispatcher, executor = thread-pool-executor, throughput = 100
              thread-pool-executor.fixed-pool-size = 1
            }
            """;

    private final CompletionLatch finish = new CompletionLatch();
    private final ActorSystem<Guardian> system;
    private final ActorRef<Message> counter;
    private final ActorRef<Message> other;
    private int families;

    private PekkoContender(String settings) {
        Config config = ConfigFactory.parseString(QUIET + settings).withFallback(ConfigFactory.load());
        system = ActorSystem.create(guardian(), "bench", config);
        counter = system.systemActorOf(counter(), "counter", Props.empty());
        other = system.systemActorOf(counter(), "other", Props.empty());
    }

    static Contender withDefaults() {
        return new PekkoContender("");
    }

    static Contender withOneThread() {
        return new PekkoContender(ONE_THREAD);
    }

    private sealed interface Message {}

    private record Expect(int messages) implements Message {}

    private record Add(int amount) implements Message {}

    private record Ping(ActorRef<Message> from, int hops) implements Message {}

    private record Sum(ActorRef<Integer> replyTo) implements Message {}

    private record AskInTurn(ActorRef<Message> whom, int asks) implements Message {}

    private record Begin(AtomicInteger beginners) implements Message {}

    private record Failed(Throwable error) implements Message {}

    private sealed interface Guardian {}

    private record Create(int actors) implements Guardian {}

    private record Clear() implements Guardian {}

    /** Only a parent can create anonymous actors. */
    private Behavior<Guardian> guardian() {
        return Behaviors.setup(context -> Behaviors.receiveMessage(message -> {
            switch (message) {
                case Create create -> {
                    var beginners = new AtomicInteger(create.actors());
                    for (int i = 0; i < create.actors(); i++) {
                        context.spawnAnonymous(counter()).tell(new Begin(beginners));
                    }
                }
                case Clear() -> {
                    context.getChildren().forEach(context::stop);
                    finish.reach();
                }
            }
            return Behaviors.same();
        }));
    }

    private Behavior<Message> counter() {
        return Behaviors.setup(context -> {
            var state = new Counter(context);
            return Behaviors.receiveMessage(message -> {
                state.handle(message);
                return Behaviors.same();
            });
        });
    }

    private final class Counter {
        private final ActorContext<Message> context;
        private int sum;
        private int left;

        Counter(ActorContext<Message> context) {
            this.context = context;
        }

        void handle(Message message) {
            switch (message) {
                case Expect expect -> left = expect.messages();
                case Add add -> add(add.amount());
                case Ping ping -> ping(ping);
                case Sum ask -> ask.replyTo().tell(sum);
                case AskInTurn chain -> askInTurn(chain.whom(), chain.asks());
                case Begin begin -> begin(begin.beginners());
                case Failed failed -> throw new IllegalStateException("no answer", failed.error());
            }
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
                ping.from().tell(new Ping(context.getSelf(), ping.hops() - 1));
            }
        }

        private void askInTurn(ActorRef<Message> whom, int asks) {
            if (asks == 0) {
                finish.reach();
                return;
            }
            context.ask(Integer.class, whom, TIMEOUT, Sum::new, (answer, error) -> next(whom, asks - 1, error));
        }

        private Message next(ActorRef<Message> whom, int asks, @Nullable Throwable error) {
            return error == null ? new AskInTurn(whom, asks) : new Failed(error);
        }

        private void begin(AtomicInteger beginners) {
            if (beginners.decrementAndGet() == 0) {
                finish.reach();
            }
        }
    }

    private CompletionStage<Integer> ask() {
        return AskPattern.ask(counter, Sum::new, TIMEOUT, system.scheduler());
    }

    @Override
    public void tell(int messages, Senders senders) throws Exception {
        finish.reset();
        counter.tell(new Expect(messages));
        senders.send(messages, share -> {
            for (int i = 0; i < share; i++) {
                counter.tell(new Add(i));
            }
        });
        finish.await();
    }

    @Override
    public Family newFamily(Tally tally) throws Exception {
        return Families.copy(PekkoFamily.class, system, "family" + families++, tally);
    }

    @Override
    public void pingPong(int hops) {
        finish.reset();
        counter.tell(new Ping(other, hops));
        finish.await();
    }

    @Override
    public void askPipelined(int asks) {
        finish.reset();
        var left = new AtomicInteger(asks);
        for (int i = 0; i < asks; i++) {
            ask().thenAccept(answer -> {
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
        counter.tell(new AskInTurn(other, asks));
        finish.await();
    }

    @Override
    public void askOnce(int asks) throws Exception {
        for (int i = 0; i < asks; i++) {
            ask().toCompletableFuture().get(30, TimeUnit.SECONDS);
        }
    }

    @Override
    public void create(int actors) {
        finish.reset();
        system.tell(new Create(actors));
        finish.await();
    }

    @Override
    public void clear() {
        finish.reset();
        system.tell(new Clear());
        finish.await();
    }

    @Override
    public void close() {
        system.terminate();
    }
}
