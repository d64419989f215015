package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorException;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.MailboxBound.Overflow;
import io.troupe.actor.MailboxFullException;
import io.troupe.actor.Supervision;
import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;

/** Calls of several threads that race with the end of their actor, or with a full mailbox. */
final class CallRaces {
    private static final int CALLERS = 3;
    private static final int CALLS = 150;

    private CallRaces() {}

    interface Target {
        void tell(Mark mark);

        Promise<Mark> ask(Mark mark);

        /** Answered by the next call, or rejected at the end. */
        Promise<Mark> askLater(Mark mark);

        void fail();
    }

    private record Asked(Mark mark, Promise<Mark> answer) {}

    /** The calls of a round and their results. */
    private static final class Ledger {
        final Mark.All marks = new Mark.All();
        final Queue<Mark> told = new ConcurrentLinkedQueue<>();
        final Queue<Asked> asked = new ConcurrentLinkedQueue<>();
        final AtomicInteger starts = new AtomicInteger();

        void call(Target target, SplittableRandom random) {
            Mark mark = marks.next();
            switch (random.nextInt(4)) {
                case 0, 1 -> {
                    target.tell(mark);
                    told.add(mark);
                }
                case 2 -> asked.add(new Asked(mark, target.ask(mark)));
                default -> {
                    var answer = target.askLater(mark);
                    asked.add(new Asked(mark, answer));
                    if (random.nextInt(10) == 0) {
                        answer.cancel();
                    }
                }
            }
        }

        int served() {
            int served = 0;
            for (var mark : told) {
                served += mark.served.get();
            }
            return served;
        }

        /**
         * Each one-way message was handled or became a dead letter, once; each request was fulfilled or rejected, once,
         * and its outcome matches.
         */
        void check() throws InterruptedException {
            for (var mark : told) {
                assertThat(mark.served.get() + mark.dead.get())
                        .as("message %s, served %s, dead %s", mark, mark.served, mark.dead)
                        .isEqualTo(1);
            }
            for (var each : asked) {
                var answer = Round.settled(each.answer);
                int served = each.mark.served.get();
                assertThat(each.mark.dead.get()).isZero();
                switch (answer.error()) {
                    case null -> {
                        assertThat(answer.getNow()).isSameAs(each.mark);
                        assertThat(served).as(each.toString()).isEqualTo(1);
                    }
                    case ActorStoppedException stopped ->
                        assertThat(served).as(stopped.toString()).isEqualTo(stopped.wasBegun() ? 1 : 0);
                    case MailboxFullException full ->
                        assertThat(served).as(full.toString()).isZero();
                    case CancellationException cancelled ->
                        assertThat(served).as(cancelled.toString()).isBetween(0, 1);
                    default -> throw new AssertionError("unexpected", answer.error());
                }
            }
        }
    }

    private static final class Served extends Actor implements Target {
        private final Ledger ledger;
        private final int failingStarts;
        private Deferred<Mark> open = new Deferred<>();
        private Mark last;

        Served(Ledger ledger, int failingStarts) {
            this.ledger = ledger;
            this.failingStarts = failingStarts;
            this.last = ledger.marks.next();
        }

        @Override
        protected void started() {
            if (ledger.starts.incrementAndGet() % 4 < failingStarts) {
                throw new IllegalStateException("cannot start");
            }
        }

        private void serve(Mark mark) {
            mark.served.incrementAndGet();
            open.resolve(last);
        }

        @Override
        public void tell(Mark mark) {
            serve(mark);
        }

        @Override
        public Promise<Mark> ask(Mark mark) {
            serve(mark);
            return Promise.of(mark);
        }

        @Override
        public Promise<Mark> askLater(Mark mark) {
            serve(mark);
            open = new Deferred<>();
            last = mark;
            return open;
        }

        @Override
        public void fail() {
            throw new IllegalStateException("on purpose");
        }
    }

    static void close(Round round) throws Exception {
        var ledger = new Ledger();
        var space = round.space("closed", ledger.marks::deadLetter);
        var other = round.space("other", ledger.marks::deadLetter);
        Target target = space.spawn(Target.class, () -> new Served(ledger, 0));
        boolean fromInside = round.random.nextBoolean();
        int when = round.random.nextInt(CALLS);
        round.start(CALLERS, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0) {
                    other.execute(() -> ledger.call(target, new SplittableRandom(random.nextLong())));
                } else {
                    ledger.call(target, random);
                }
                if (i == when && number > 0) { // two at the same time
                    if (!fromInside) {
                        space.close(Round.LONG);
                    } else if (number == 1) {
                        other.execute(space::close);
                    }
                }
                if (i % 16 == 0) {
                    Round.pause(random);
                }
            }
        });
        round.join();
        assertThat(Round.get(other.sequential(() -> true))).isTrue();
        round.end();
        ledger.check();
        var left = round.leftovers(space);
        assertThat(left.messages()).as(left.toString()).isLessThanOrEqualTo(ledger.told.size() - ledger.served());
        checkErrors(round, 0);
    }

    static void restart(Round round) throws Exception {
        var ledger = new Ledger();
        var space = round.space("restarting", ledger.marks::deadLetter);
        var other = round.space("other", ledger.marks::deadLetter);
        int failingStarts = round.random.nextInt(4); // 3 of 4 lead to pauses
        boolean factoryThrows = round.random.nextInt(4) == 0;
        var supervision = round.random.nextInt(4) == 0
                ? Supervision.STOP
                : Supervision.restart(1 + round.random.nextInt(12), Duration.ofHours(1));
        var settings = ActorSettings.DEFAULT.withSupervision(supervision);
        if (round.random.nextBoolean()) {
            settings = settings.withMailbox(1 + round.random.nextInt(100), Overflow.REJECT);
        }
        var made = new AtomicInteger();
        Target target = space.spawn(
                Target.class,
                () -> {
                    if (made.incrementAndGet() == 3 && factoryThrows) {
                        throw new IllegalStateException("cannot be made");
                    }
                    return new Served(ledger, failingStarts);
                },
                settings);
        boolean stops = round.random.nextBoolean();
        round.start(CALLERS, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0) {
                    long seed = random.nextLong();
                    other.execute(() -> ledger.call(target, new SplittableRandom(seed)));
                } else {
                    ledger.call(target, random);
                }
                if (random.nextInt(30) == 0) {
                    target.fail();
                }
                if (stops && random.nextInt(2 * CALLS) == 0) {
                    space.stop(target);
                }
                if (i % 16 == 0) {
                    Round.pause(random);
                }
            }
        });
        round.join();
        assertThat(Round.get(other.sequential(() -> true))).isTrue();
        if (round.random.nextBoolean()) {
            space.stop(target);
            Round.get(space.whenStopped(target));
        }
        round.end();
        assertThat(Round.get(space.whenStopped(target))).isNull();
        ledger.check();
        checkErrors(round, 1_000);
    }

    static void bounds(Round round) throws Exception {
        var ledger = new Ledger();
        var space = round.space("bounded", ledger.marks::deadLetter);
        var other = round.space("other", ledger.marks::deadLetter);
        var overflow = Overflow.values()[round.random.nextInt(Overflow.values().length)];
        boolean closes = round.random.nextInt(3) == 0;
        boolean inside = !closes && round.random.nextBoolean();
        var settings = ActorSettings.DEFAULT.withMailbox(1 + round.random.nextInt(6), overflow);
        Target target = space.spawn(Target.class, () -> new Served(ledger, 0), settings);
        round.start(CALLERS, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0 && inside) {
                    long seed = random.nextLong();
                    other.execute(() -> ledger.call(target, new SplittableRandom(seed)));
                } else {
                    ledger.call(target, random);
                }
                if (closes && number == 1 && i == CALLS / 2) {
                    other.execute(space::close); // some wait for room now
                }
            }
        });
        round.join();
        assertThat(Round.get(other.sequential(() -> true))).isTrue();
        round.end();
        ledger.check();
        if (overflow == Overflow.BLOCK && !inside && !closes) {
            assertThat(ledger.served())
                    .as("served of those that waited for room")
                    .isEqualTo(ledger.told.size());
        }
        checkErrors(round, 0);
    }

    /** Intended failures, and rejections that had no listener yet. */
    private static void checkErrors(Round round, int mostFailures) {
        long failures = round.errors.stream()
                .filter(IllegalStateException.class::isInstance)
                .count();
        assertThat(failures).isLessThanOrEqualTo(mostFailures);
        assertThat(round.errors)
                .allMatch(error -> error instanceof IllegalStateException || error instanceof ActorException);
    }
}
