package io.troupe.bench;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.bench.BenchmarkCommand.AtLeastOne;
import io.troupe.tools.SampleStatistics;
import java.lang.management.ManagementFactory;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Objects;
import java.util.concurrent.Callable;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.locks.LockSupport;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/**
 * Measures what needs more than one turn on one thread: questions of an actor to an actor on another space, beside a
 * bare exchange between two threads through the same queues; and what periodic timers take of a processor core.
 */
@Command(
        name = "MeasureSpaces",
        description = "Measures questions between two spaces, and periodic timers.",
        showDefaultValues = true)
public final class MeasureSpaces implements Callable<Integer> {
    private static final int WARM_UPS = 20;
    private static final Duration LONG = Duration.ofSeconds(60);

    @Option(names = "--rounds", paramLabel = "N", converter = AtLeastOne.class, description = "of turns of each kind")
    int rounds = 100;

    @Option(names = "--questions", paramLabel = "N", converter = AtLeastOne.class, description = "in a turn")
    int questions = 5_000;

    @Option(names = "--timers", paramLabel = "N", converter = AtLeastOne.class, description = "of one space")
    int timers = 10_000;

    @Option(
            names = "--seconds",
            paramLabel = "N",
            converter = AtLeastOne.class,
            description = "for which timers are measured, for each period")
    int seconds = 5;

    public static void main(String... arguments) {
        System.exit(BenchmarkCommand.of(new MeasureSpaces()).execute(arguments));
    }

    @Override
    public Integer call() throws Exception {
        System.out.printf(
                Locale.ROOT,
                "Java %s, %d processors, load %.1f%n%n",
                Runtime.version(),
                Runtime.getRuntime().availableProcessors(),
                ManagementFactory.getOperatingSystemMXBean().getSystemLoadAverage());
        System.out.println("| a question and its answer | ns, median (quartiles) | ratio of the same round |");
        System.out.println("|---|---|---|");
        compareQuestions().forEach(System.out::println);
        System.out.printf(Locale.ROOT, "%n| %,d timers, period | share of a core | us for each run |%n", timers);
        System.out.println("|---|---|---|");
        for (Duration period : List.of(Duration.ofMillis(100), Duration.ofSeconds(1))) {
            System.out.println(TimerShare.measure(timers, period, Duration.ofSeconds(seconds)));
        }
        return 0;
    }

    /** The rows of the first table; both kinds take turns. */
    List<String> compareQuestions() throws Exception {
        List<Double> bare = new ArrayList<>();
        List<Double> asked = new ArrayList<>();
        List<Double> ratios = new ArrayList<>();
        try (var exchange = new BareExchange();
                var spaces = new TwoSpaces()) {
            for (int round = -WARM_UPS; round < rounds; round++) {
                double bareNanos = exchange.nanosPerQuestion(questions);
                double askedNanos = spaces.nanosPerQuestion(questions);
                if (round >= 0) {
                    bare.add(bareNanos);
                    asked.add(askedNanos);
                    ratios.add(askedNanos / bareNanos);
                }
            }
        }
        return List.of(
                row("bare exchange of two threads", bare, ""),
                row("actors of two spaces", asked, SampleStatistics.of(ratios).text(2)));
    }

    private static String row(String name, List<Double> nanos, String ratio) {
        return "| " + name + " | " + SampleStatistics.of(nanos).text(0) + " | " + ratio + " |";
    }

    /** Two threads that pass one object to and fro, with the queues and the sleep of a space, and nothing else. */
    private static final class BareExchange implements AutoCloseable {
        private static final int LOOKS = 12; // as a space does
        private static final int SPINS_PER_LOOK = 8;

        private final End caller = new End();
        private final End answerer = new End();

        BareExchange() {
            caller.other = answerer;
            answerer.other = caller;
            caller.start();
            answerer.start();
        }

        private static final class Ball extends QueueEntry {
            private final CompletableFuture<@Nullable Void> done;
            private int left;

            Ball(int left, CompletableFuture<@Nullable Void> done) {
                this.left = left;
                this.done = done;
            }
        }

        private static final class End implements Runnable {
            private final EntryQueue queue = new EntryQueue();
            private final Thread thread =
                    Thread.ofPlatform().daemon().name("exchange").unstarted(this);
            private @Nullable End other;
            private volatile boolean isAsleep;
            private volatile boolean isOver;

            void start() {
                thread.start();
            }

            void offer(QueueEntry node) {
                queue.offer(node);
                wake();
            }

            void wake() {
                if (isAsleep) {
                    isAsleep = false;
                    LockSupport.unpark(thread);
                }
            }

            @Override
            public void run() {
                End receiver = Objects.requireNonNull(other);
                while (!isOver) {
                    QueueEntry node = queue.poll();
                    if (node == null) {
                        sleep();
                    } else {
                        var ball = (Ball) node;
                        if (--ball.left == 0) {
                            ball.done.complete(null);
                        } else {
                            receiver.offer(next(ball));
                        }
                    }
                }
            }

            /** A new object for each message, as for a question; the queue keeps the one that was taken last. */
            private static Ball next(Ball ball) {
                return new Ball(ball.left, ball.done);
            }

            private void sleep() {
                for (int look = 0; look < LOOKS; look++) {
                    for (int spin = 0; spin < SPINS_PER_LOOK; spin++) {
                        Thread.onSpinWait();
                    }
                    if (queue.isReady()) {
                        return;
                    }
                }
                isAsleep = true;
                if (queue.isEmpty() && !isOver) {
                    LockSupport.park(this);
                }
                isAsleep = false;
            }
        }

        double nanosPerQuestion(int questions) {
            var done = new CompletableFuture<@Nullable Void>();
            long begin = System.nanoTime();
            answerer.offer(new Ball(2 * questions, done));
            done.join();
            return (System.nanoTime() - begin) / (double) questions;
        }

        @Override
        public void close() {
            for (End end : List.of(caller, answerer)) {
                end.isOver = true;
                LockSupport.unpark(end.thread);
            }
        }
    }

    /** Answers with a number. */
    public interface Answerer {
        Promise<Integer> next();
    }

    /** Asks an answerer again and again. */
    public interface Caller {
        Promise<Integer> ask(Answerer answerer, int questions);
    }

    private static final class TwoSpaces implements AutoCloseable {
        private final ActorSpace first = ActorSpace.create(SpaceSettings.named("callers"));
        private final ActorSpace second = ActorSpace.create(SpaceSettings.named("answerers"));
        private final Caller caller = first.spawn(Caller.class, () -> TwoSpaces::ask);
        private final Answerer answerer = second.spawn(Answerer.class, Counting::new);

        private static final class Counting implements Answerer {
            private int count;

            @Override
            public Promise<Integer> next() {
                return Promise.of(++count);
            }
        }

        private static Promise<Integer> ask(Answerer answerer, int questions) {
            var all = new Deferred<Integer>();
            again(answerer, questions, all);
            return all;
        }

        private static void again(Answerer answerer, int left, Deferred<Integer> all) {
            answerer.next().thenAccept(number -> {
                if (left == 1) {
                    all.resolve(number);
                } else {
                    again(answerer, left - 1, all);
                }
            });
        }

        double nanosPerQuestion(int questions) throws Exception {
            long begin = System.nanoTime();
            caller.ask(answerer, questions).get(LONG);
            return (System.nanoTime() - begin) / (double) questions;
        }

        @Override
        public void close() {
            first.close();
            second.close();
        }
    }

    /** What the thread of a space takes for many periodic timers. */
    static final class TimerShare {
        /** Has timers. */
        public interface Ticking {
            Promise<Long> start(int timers, long periodNanos);

            Promise<Long> runs();
        }

        /** Starts its timers evenly over a period. */
        static final class TickingActor extends Actor implements Ticking {
            private long runs;

            @Override
            public Promise<Long> start(int timers, long periodNanos) {
                for (int timer = 0; timer < timers; timer++) {
                    context()
                            .after(
                                    Duration.ofNanos(periodNanos * timer / timers),
                                    () -> context().every(Duration.ofNanos(periodNanos), () -> runs++));
                }
                return Promise.of(Thread.currentThread().threadId());
            }

            @Override
            public Promise<Long> runs() {
                return Promise.of(runs);
            }
        }

        private TimerShare() {}

        /** A row of the table. */
        static String measure(int timers, Duration period, Duration time) throws Exception {
            try (var space = ActorSpace.create(SpaceSettings.named("timers"))) {
                Ticking actor = space.spawn(Ticking.class, TickingActor::new);
                long thread = actor.start(timers, period.toNanos()).get(LONG);
                Thread.sleep(period.multipliedBy(2).plus(time)); // also warms up
                var cpu = ManagementFactory.getThreadMXBean();
                long runsBefore = actor.runs().get(LONG);
                long cpuBefore = cpu.getThreadCpuTime(thread);
                long begin = System.nanoTime();
                Thread.sleep(time);
                double spentNanos = cpu.getThreadCpuTime(thread) - cpuBefore;
                double wallNanos = System.nanoTime() - begin;
                long runs = actor.runs().get(LONG) - runsBefore;
                return String.format(
                        Locale.ROOT,
                        "| %d ms | %.1f %% | %.2f |",
                        period.toMillis(),
                        100 * spentNanos / wallNanos,
                        spentNanos / 1000 / runs);
            }
        }
    }
}
