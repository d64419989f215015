package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/**
 * A heap that is really full, in separate JVMs: an actor keeps what it allocates until nothing is left. Nothing of the
 * library has failed there before, so everything that is needed for a failure is used for the first time.
 */
@Tag("threads")
@Timeout(value = 10, unit = TimeUnit.MINUTES)
class FullHeapTest {
    private static final boolean THOROUGH = System.getProperty("thorough") != null;
    private static final List<String> COLLECTORS = List.of("G1", "Serial", "Parallel", "Z");
    private static final List<String> HEAPS = List.of("48m", "100m", "256m");

    private record Jvm(String collector, String heap, List<String> options) {
        List<String> all() {
            var all = new ArrayList<>(List.of("-XX:+Use" + collector + "GC", "-Xms" + heap, "-Xmx" + heap));
            all.addAll(options);
            return all;
        }

        @Override
        public String toString() {
            return String.join(" ", all());
        }
    }

    private static Stream<Jvm> jvms() {
        if (!THOROUGH) {
            return Stream.of(new Jvm("G1", "48m", List.of()), new Jvm("Serial", "48m", List.of()));
        }
        return COLLECTORS.stream()
                .flatMap(collector -> Stream.concat(
                        HEAPS.stream().map(heap -> new Jvm(collector, heap, List.of())),
                        Stream.of(new Jvm(collector, "64m", List.of("-Xint")))));
    }

    @ParameterizedTest
    @MethodSource("jvms")
    void space_whoseActorFillsTheHeap_goesOn_onItsThread(Jvm jvm) throws Exception {
        assertThat(outputOf(jvm, "serve"))
                .containsExactly(
                        "another actor answered on thread hogs",
                        "its open request is answered",
                        "the error of the hog was reported or counted",
                        "the watchdog of another space reports",
                        "the time limit of another space expired",
                        "closed, open request rejected: true",
                        "late call rejected");
    }

    @ParameterizedTest
    @MethodSource("jvms")
    void space_thatIsClosedWhileTheHeapIsFull_endsClosed_andNoActorRunsElsewhere(Jvm jvm) throws Exception {
        assertThat(outputOf(jvm, "close"))
                .containsExactly(
                        "closed",
                        "open requests settled: 100 of 100",
                        "queued requests settled: 100 of 100",
                        "callbacks ended: 100 of 100",
                        "whenStopped settled, whenClosed settled",
                        "late call rejected",
                        "the watchdog of another space reports");
    }

    private static List<String> outputOf(Jvm jvm, String scenario) throws IOException, InterruptedException {
        return ChildJvm.run(jvm.all(), Child.class, scenario).lines();
    }

    /** The program of the other JVM. */
    static final class Child {
        private static final Duration PATIENCE = Duration.ofSeconds(60);
        private static final int OPEN = 100;

        private static volatile Thread spaceThread = Thread.currentThread();

        public interface Hog {
            void fill();

            void release();
        }

        public interface Other {
            Promise<String> thread();

            Promise<String> open();

            void answer();

            void watch(Callback<String> callback);

            void stall(CountDownLatch end);
        }

        private static final class Filling implements Hog {
            private @Nullable Object @Nullable [] kept;

            @Override
            public void fill() {
                var blocks = new Object[1 << 20];
                kept = blocks;
                int size = 1 << 16;
                for (int count = 0; ; count++) {
                    try {
                        blocks[count] = new byte[size];
                    } catch (OutOfMemoryError full) {
                        if (size == 16) {
                            throw full;
                        }
                        size /= 4; // down to the last bytes
                    }
                }
            }

            @Override
            public void release() {
                kept = null;
            }
        }

        private static final class Plain implements Other {
            private final List<Deferred<String>> open = new ArrayList<>();

            @Override
            public Promise<String> thread() {
                spaceThread = Thread.currentThread();
                return Promise.of(Thread.currentThread().getName());
            }

            @Override
            public Promise<String> open() {
                var answer = new Deferred<String>();
                open.add(answer);
                return answer;
            }

            @Override
            public void answer() {
                open.removeFirst().resolve("answered");
            }

            @Override
            public void watch(Callback<String> callback) {}

            @Override
            public void stall(CountDownLatch end) {
                try {
                    end.await(60, TimeUnit.SECONDS);
                } catch (InterruptedException interrupted) {
                    Thread.currentThread().interrupt();
                }
            }
        }

        private Child() {}

        public static void main(String[] arguments) throws Exception {
            if (arguments[0].equals("serve")) {
                serve();
            } else {
                close();
            }
            System.out.flush();
            Runtime.getRuntime().halt(0);
        }

        private static void say(String line) {
            System.out.println(line);
        }

        /** Lets the space go on, and waits for a promise, and for a thread unless that is the calling one. */
        private static void awaitEnd(CountDownLatch gate, Promise<?> promise, Thread thread) {
            boolean begun = false;
            boolean warm = Promise.done().isDone() && Thread.currentThread().isAlive();
            while (true) {
                try {
                    if (!begun) {
                        begun = warm;
                        gate.countDown();
                    }
                    if (promise.isDone() && (thread == Thread.currentThread() || !thread.isAlive())) {
                        return;
                    }
                    Thread.onSpinWait();
                } catch (OutOfMemoryError full) {
                    // try again
                }
            }
        }

        private static ActorSpace hogs() {
            return ActorSpace.create(SpaceSettings.named("hogs")
                    .withOnStall(Duration.ofMillis(50), stall -> {}) // is noticed while the heap is full
                    .withOnError((where, error) -> {})
                    .withOnDeadLetter(letter -> {}));
        }

        private static ActorSpace healthy(AtomicInteger stalls, CountDownLatch[] end) {
            return ActorSpace.create(SpaceSettings.named("healthy")
                    .withOnError((where, error) -> {})
                    .withOnStall(Duration.ofMillis(300), stall -> {
                        stalls.incrementAndGet();
                        end[0].countDown();
                    }));
        }

        private static void checkWatchdog(ActorSpace healthy, AtomicInteger stalls, CountDownLatch[] end)
                throws Exception {
            Other other = healthy.spawn(Other.class, Plain::new);
            int before = stalls.get();
            end[0] = new CountDownLatch(1);
            other.stall(end[0]);
            boolean soon = end[0].await(5, TimeUnit.SECONDS); // the watchdog looks every 75 ms
            end[0].countDown();
            other.thread().get(PATIENCE.multipliedBy(2));
            say(soon && stalls.get() > before ? "the watchdog of another space reports" : "NO REPORT OF A STALL");
        }

        private static void serve() throws Exception {
            var end = new CountDownLatch[1];
            var stalls = new AtomicInteger();
            var healthy = healthy(stalls, end);
            var hogs = hogs();
            Hog hog = hogs.spawn(Hog.class, Filling::new);
            Other other = hogs.spawn(Other.class, Plain::new);
            Promise<String> open = other.open();
            Promise<String> never = other.open();
            other.thread().get(PATIENCE);
            Promise<String> limited = healthy.<String>deferred().orTimeout(Duration.ofMillis(1_500));
            var gate = new CountDownLatch(1);
            other.stall(gate); // until everything is queued: this thread must not need memory later
            hog.fill();
            hog.release();
            other.answer();
            Promise<String> thread = other.thread();
            awaitEnd(gate, thread, Thread.currentThread());
            say("another actor answered on thread " + thread.get(PATIENCE));
            say(open.get(PATIENCE).equals("answered") ? "its open request is answered" : "WRONG");
            say(hogs.metrics().errors() > 0 ? "the error of the hog was reported or counted" : "NO ERROR");
            checkWatchdog(healthy, stalls, end);
            try {
                say("NOT LATE: " + limited.get(PATIENCE));
            } catch (TimeoutException | OutOfMemoryError late) { // which of them depends on the moment
                say(limited.isDone() ? "the time limit of another space expired" : "NOT EXPIRED");
            }
            hogs.close();
            say("closed, open request rejected: " + never.isRejected());
            say(other.thread().isRejected() ? "late call rejected" : "LATE CALL ANSWERED");
        }

        private static void close() throws Exception {
            var end = new CountDownLatch[1];
            var stalls = new AtomicInteger();
            var healthy = healthy(stalls, end);
            var hogs = hogs();
            Hog hog = hogs.spawn(Hog.class, Filling::new);
            Other other = hogs.spawn(Other.class, Plain::new);
            Other last = hogs.spawn(Other.class, Plain::new);
            last.thread().get(PATIENCE);
            var stopped = hogs.whenStopped(other);
            var closed = hogs.whenClosed();
            var open = new ArrayList<Promise<String>>();
            var queued = new ArrayList<Promise<String>>();
            var ended = new AtomicInteger();
            for (int i = 0; i < OPEN; i++) {
                open.add((i % 2 == 0 ? other : last).open());
            }
            last.thread().get(PATIENCE);
            var gate = new CountDownLatch(1);
            last.stall(gate);
            hogs.execute(() -> {
                hog.fill();
                hogs.close();
                for (int i = 0; i < OPEN; i++) { // behind the end
                    queued.add(last.thread());
                    last.watch((value, error) -> ended.incrementAndGet());
                }
            });
            awaitEnd(gate, closed, spaceThread);
            say("closed");
            say("open requests settled: "
                    + open.stream().filter(Promise::isRejected).count() + " of " + OPEN);
            say("queued requests settled: "
                    + queued.stream().filter(Promise::isRejected).count() + " of " + OPEN);
            say("callbacks ended: " + ended + " of " + OPEN);
            say("whenStopped " + (stopped.isDone() ? "settled" : "PENDING") + ", whenClosed "
                    + (closed.isDone() ? "settled" : "PENDING"));
            say(last.thread().isRejected() ? "late call rejected" : "LATE CALL ANSWERED");
            checkWatchdog(healthy, stalls, end);
        }
    }
}
