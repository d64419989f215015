package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.ManualClock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicReference;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** What a closing space still does, and what its own steps may lead to. */
@Timeout(20)
class EndOfSpaceTest {
    private final List<String> log = new ArrayList<>();
    private final List<DeadLetter> letters = new ArrayList<>();
    private final ManualClock clock = new ManualClock();
    private final SpaceSettings settings = SpaceSettings.named("ending")
            .withClock(clock)
            .withOnDeadLetter(letters::add)
            .withOnError((where, error) -> log.add(where))
            .withHandCrank();

    /** Takes messages and answers requests. */
    public interface Worker {
        void take(String text);

        Promise<String> ask(String text);
    }

    private final class Steady implements Worker {
        @Override
        public void take(String text) {
            log.add("took " + text);
        }

        @Override
        public Promise<String> ask(String text) {
            return new Deferred<>();
        }
    }

    private Worker spawnElsewhere(ActorSpace space) {
        var made = new AtomicReference<Worker>();
        Thread thread = Thread.ofPlatform().start(() -> made.set(space.spawn(Worker.class, Steady::new)));
        try {
            thread.join();
        } catch (InterruptedException interrupted) {
            throw new IllegalStateException(interrupted);
        }
        return made.get();
    }

    @Test
    void close_callBeforeItsActorHasStarted_isRejected() {
        var space = ActorSpace.create(settings);
        space.execute(() -> {
            Worker worker = spawnElsewhere(space); // the entry that starts it is in the inbox
            space.close();
            worker.take("a call");
        });
        space.crank();
        assertThat(log).isEmpty();
        assertThat(letters).hasSize(1);
    }

    @Test
    void close_retryFromOutside_ends() {
        var space = ActorSpace.create(settings);
        Worker worker = space.spawn(Worker.class, Steady::new);
        space.execute(space::close);
        Promise<String> retried = space.retry(3, Duration.ofSeconds(1), () -> worker.ask("again"));
        space.crank();
        assertThat(retried.isDone()).isTrue();
    }

    @Test
    void close_delayAskedForByTheLastListener_isCancelled() {
        var space = ActorSpace.create(settings);
        Worker worker = space.spawn(Worker.class, Steady::new);
        var late = new AtomicReference<Promise<?>>();
        space.execute(() -> {
            space.close();
            worker.ask("too late").exceptionally(error -> {
                late.set(space.delay(Duration.ofSeconds(1)));
                return "";
            });
        });
        space.crank();
        assertThat(late.get().error()).isInstanceOf(CancellationException.class);
    }

    @Test
    void close_lastErrorHandlerCallsAnActor_callIsADeadLetter() {
        var logger = new AtomicReference<Worker>();
        var space = ActorSpace.create(
                settings.withOnError((where, error) -> logger.get().take(where)));
        logger.set(space.spawn(Worker.class, Steady::new));
        space.crank();
        space.spawn(Loser.class, Loser::new);
        space.close();
        assertThat(letters).hasSize(1);
    }

    /** Fails in {@code stopped()}, in a promise without listeners. */
    public static class Loser extends Actor {
        @Override
        protected void stopped() {
            new Deferred<String>().reject(new IllegalStateException("nobody listens"));
        }
    }

    @Test
    void close_lastListenerThrows_isReported() {
        var space = ActorSpace.create(settings);
        Worker worker = space.spawn(Worker.class, Steady::new);
        space.execute(() -> {
            space.close();
            worker.ask("too late").whenComplete((value, error) -> {
                throw new IllegalStateException("a fault in a listener");
            });
        });
        space.crank();
        assertThat(log).hasSize(1);
    }

    @Test
    void close_idleActionThatWaits_isNotLostInSilence() {
        var space = ActorSpace.create(settings);
        space.execute(() -> {
            space.onIdle(() -> log.add("idle"));
            space.close();
            space.execute(() -> {}); // so that it is never idle again, and this is a dead letter
        });
        space.crank();
        assertThat(log.size() + letters.size()).isEqualTo(2);
    }

    @Test
    void crank_afterClose_keepsTheLeftovers() {
        var space = ActorSpace.create(settings);
        space.execute(() -> {
            space.close();
            space.execute(() -> {});
        });
        space.crank();
        assertThat(space.close(Duration.ofSeconds(1)).tasks()).isEqualTo(1);
        space.crank();
        assertThat(space.close(Duration.ofSeconds(1)).tasks()).isEqualTo(1);
    }

    @Test
    void close_droppedCallsTicket_leftoversNameTheCallThatWaits() {
        var space = ActorSpace.create(settings);
        Worker worker =
                space.spawn(Worker.class, Steady::new, ActorSettings.DEFAULT.withMailbox(1, Overflow.DROP_OLDEST));
        space.crank();
        space.execute(() -> {
            space.close();
            worker.ask("old").exceptionally(error -> "");
            worker.ask("new").exceptionally(error -> "");
        });
        space.crank();
        Leftovers left = space.close(Duration.ofSeconds(1));
        assertThat(left.requests()).isEqualTo(1);
        assertThat(left.examples()).singleElement().asString().contains("new");
    }

    @Test
    void stop_timersOfTheActor_areRemoved() {
        var space = ActorSpace.create(settings);
        Clocked clocked = space.spawn(Clocked.class, Clocked::new);
        space.crank();
        space.stop(clocked);
        space.crank();
        assertThat(space.metrics().timers()).isZero();
        space.close();
    }

    /** Has timers. */
    public static class Clocked extends Actor {
        @Override
        protected void started() {
            after(Duration.ofHours(1), () -> {});
            after("key", Duration.ofHours(1), () -> {});
        }
    }

    @Test
    void deadLetterHandler_listenerItRegisters_isNotThatOfTheActorWhoseTurnWasBefore() {
        var space = new AtomicReference<ActorSpace>();
        space.set(ActorSpace.create(settings.withOnDeadLetter(
                letter -> space.get().delay(Duration.ofSeconds(1)).thenRun(() -> log.add("alarm")))));
        Worker stopped = space.get().spawn(Worker.class, Steady::new);
        space.get().stop(stopped);
        space.get().crank();
        Worker other = space.get().spawn(Worker.class, Steady::new);
        other.take("a call");
        stopped.take("a dead letter");
        space.get().crank();
        space.get().stop(other);
        space.get().crank();
        clock.advance(Duration.ofSeconds(2));
        space.get().crank();
        assertThat(log).containsExactly("took a call", "alarm");
        space.get().close();
    }
}
