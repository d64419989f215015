package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorEnd;
import io.troupe.actor.ActorException;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.MailboxFullException;
import io.troupe.actor.Promise;
import io.troupe.actor.Supervision;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.SplittableRandom;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.regex.Pattern;

/** Calls of several threads that race with the end of their actor, or with a full mailbox. */
final class CallRaces {
    private static final int CALLERS = 3;
    private static final int CALLS = 150;
    private static final Pattern MARK = Pattern.compile("#(\\d+)#");

    /** The argument of one call, with the number of times the call was handled and became a dead letter. */
    record Mark(int number, AtomicInteger served, AtomicInteger dead) {
        @Override
        public String toString() {
            return "#" + number + "#"; // found again in the texts of dead letters
        }
    }

    private record Asked(Mark mark, Promise<Mark> answer) {}

    interface Target {
        void tell(Mark mark);

        Promise<Mark> ask(Mark mark);

        /** Answered by the next call, or rejected at the end. */
        Promise<Mark> askLater(Mark mark);

        void fail();
    }

    private final class Served extends Actor implements Target {
        private Deferred<Mark> open = new Deferred<>();
        private Mark last = nextMark();

        @Override
        protected void started() {
            if (starts.incrementAndGet() % 4 < failingStarts) {
                throw new IllegalStateException("cannot start");
            }
        }

        @Override
        public void tell(Mark mark) {
            mark.served.incrementAndGet();
            open.resolve(last);
        }

        @Override
        public Promise<Mark> ask(Mark mark) {
            tell(mark);
            return Promise.of(mark);
        }

        @Override
        public Promise<Mark> askLater(Mark mark) {
            tell(mark);
            open = new Deferred<>();
            last = mark;
            return open;
        }

        @Override
        public void fail() {
            throw new IllegalStateException("on purpose");
        }
    }

    private final Map<Integer, Mark> marks = new ConcurrentHashMap<>();
    private final AtomicInteger made = new AtomicInteger();
    private final AtomicInteger starts = new AtomicInteger();
    private final Queue<Mark> told = new ConcurrentLinkedQueue<>();
    private final Queue<Asked> asked = new ConcurrentLinkedQueue<>();
    private final Round round;
    private final ActorSpace space;
    private final ActorSpace other;
    private int failingStarts; // of each four starts

    CallRaces(Round round, String name) {
        this.round = round;
        this.space = round.space(name, this::deadLetter);
        this.other = round.space("other", this::deadLetter);
    }

    private Mark nextMark() {
        var mark = new Mark(made.incrementAndGet(), new AtomicInteger(), new AtomicInteger());
        marks.put(mark.number, mark);
        return mark;
    }

    private void deadLetter(String message) {
        var found = MARK.matcher(message);
        if (found.find()) {
            marks.get(Integer.valueOf(found.group(1))).dead.incrementAndGet();
        }
    }

    /** What happens after a call of a thread. */
    private interface Disturbance {
        void after(int thread, int call, SplittableRandom random);
    }

    /** Calls on all threads; {@code inside} is true if the first of them calls on the thread of the other space. */
    private void call(Target target, boolean inside, Disturbance disturbance) throws Exception {
        round.run(CALLERS, (number, random) -> {
            for (int i = 0; i < CALLS; i++) {
                if (number == 0 && inside) {
                    var own = new SplittableRandom(random.nextLong());
                    other.execute(() -> call(target, own));
                } else {
                    call(target, random);
                }
                disturbance.after(number, i, random);
            }
        });
        Round.drain(List.of(other));
    }

    private void call(Target target, SplittableRandom random) {
        Mark mark = nextMark();
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

    private static void pauseAtTimes(int call, SplittableRandom random) {
        if (call % 16 == 0) {
            Round.pause(random);
        }
    }

    void close() throws Exception {
        Target target = space.spawn(Target.class, Served::new);
        boolean fromInside = round.random.nextBoolean();
        int when = round.random.nextInt(CALLS);
        call(target, true, (number, i, random) -> {
            if (i == when && number > 0) { // two at the same time
                if (!fromInside) {
                    space.close(Round.LONG);
                } else if (number == 1) {
                    other.execute(space::close);
                }
            }
            pauseAtTimes(i, random);
        });
        round.end();
        check(0);
        var left = round.leftovers(space);
        assertThat(left.messages()).as(left.toString()).isLessThanOrEqualTo(told.size() - served());
    }

    void restart() throws Exception {
        failingStarts = round.random.nextInt(4); // 3 of 4 lead to pauses
        boolean factoryThrows = round.random.nextInt(4) == 0;
        var supervision = round.random.nextInt(4) == 0
                ? Supervision.STOP
                : Supervision.restart(1 + round.random.nextInt(12), Duration.ofHours(1));
        var settings = ActorSettings.defaults().withSupervision(supervision);
        if (round.random.nextBoolean()) {
            settings = settings.withMailbox(1 + round.random.nextInt(100), Overflow.REJECT);
        }
        var instances = new AtomicInteger();
        Target target = space.spawn(
                Target.class,
                () -> {
                    if (instances.incrementAndGet() == 3 && factoryThrows) {
                        throw new IllegalStateException("cannot be made");
                    }
                    return new Served();
                },
                settings);
        boolean stops = round.random.nextBoolean();
        call(target, true, (number, i, random) -> {
            if (random.nextInt(30) == 0) {
                target.fail();
            }
            if (stops && random.nextInt(2 * CALLS) == 0) {
                space.stop(target);
            }
            pauseAtTimes(i, random);
        });
        if (round.random.nextBoolean()) {
            space.stop(target);
            Round.get(space.whenStopped(target));
        }
        round.end();
        assertThat(Round.get(space.whenStopped(target))).isInstanceOf(ActorEnd.class);
        check(1_000);
    }

    void bounds() throws Exception {
        var overflow = Overflow.values()[round.random.nextInt(Overflow.values().length)];
        boolean closes = round.random.nextInt(3) == 0;
        boolean inside = !closes && round.random.nextBoolean();
        var settings = ActorSettings.defaults().withMailbox(1 + round.random.nextInt(6), overflow);
        Target target = space.spawn(Target.class, Served::new, settings);
        call(target, inside, (number, i, random) -> {
            if (closes && number == 1 && i == CALLS / 2) {
                other.execute(space::close); // some wait for room now
            }
        });
        round.end();
        check(0);
        if (overflow == Overflow.BLOCK && !inside && !closes) {
            assertThat(served()).as("served of those that waited for room").isEqualTo(told.size());
        }
    }

    private int served() {
        return told.stream().mapToInt(mark -> mark.served.get()).sum();
    }

    /**
     * Each one-way message was handled or became a dead letter, once; each request was fulfilled or rejected, once, and
     * its outcome matches. The errors are intended failures, and rejections that had no listener yet.
     */
    private void check(int mostFailures) throws InterruptedException {
        for (var mark : told) {
            assertThat(mark.served.get() + mark.dead.get())
                    .as("message %s, served %s, dead %s", mark, mark.served, mark.dead)
                    .isEqualTo(1);
        }
        for (var each : asked) {
            check(each.mark, Round.settled(each.answer));
        }
        assertThat(round.errors)
                .allMatch(error -> error instanceof IllegalStateException || error instanceof ActorException)
                .filteredOn(IllegalStateException.class::isInstance)
                .hasSizeLessThanOrEqualTo(mostFailures);
    }

    private static void check(Mark mark, Promise<Mark> answer) {
        int served = mark.served.get();
        assertThat(mark.dead.get()).isZero();
        switch (answer.error()) {
            case null -> {
                assertThat(answer.getNow()).isSameAs(mark);
                assertThat(served).as(mark.toString()).isEqualTo(1);
            }
            case ActorStoppedException stopped ->
                assertThat(served).as(stopped.toString()).isEqualTo(stopped.mayHaveRun() ? 1 : 0);
            case MailboxFullException full ->
                assertThat(served).as(full.toString()).isZero();
            case CancellationException cancelled ->
                assertThat(served).as(cancelled.toString()).isBetween(0, 1);
            default -> throw new AssertionError("unexpected", answer.error());
        }
    }
}
