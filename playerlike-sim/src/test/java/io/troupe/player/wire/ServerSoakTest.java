package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Pace;
import io.troupe.sim.SimulationRunner;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.io.OutputStream;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.locks.LockSupport;
import java.util.logging.Level;
import java.util.logging.Logger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Isolated;

/**
 * A server under clients that send without a pause, send requests without reading, send garbage, connect and leave.
 * Beside them a good client runs in lock step and must receive every frame in order.
 *
 * <p>Short in every build: until the good client has received its frames and every other kind of client has made
 * progress. {@code -Dsoak.minutes=10} extends the run and prints the number of frames, the longest time between two,
 * and the heap in use.
 */
@Isolated("switches the log off")
class ServerSoakTest {
    private static final int FRAMES = Thorough.times(15, 50);
    private static final long EACH = Thorough.times(6, 20);

    /** What one kind of client does repeatedly; returns the amount of work done. */
    private interface Behaviour {
        long once(int port, Random random, AtomicBoolean stop) throws IOException;
    }

    private record Kind(String name, Behaviour behaviour, AtomicLong done) {
        Kind(String name, Behaviour behaviour) {
            this(name, behaviour, new AtomicLong());
        }
    }

    private final AtomicBoolean stop = new AtomicBoolean();
    private final ConcurrentLinkedQueue<Throwable> failures = new ConcurrentLinkedQueue<>();

    @Test
    void goodClient_getsEveryFrame_whateverTheOthersDo() throws Exception {
        double minutes = Double.parseDouble(System.getProperty("soak.minutes", "0"));
        var logger = Logger.getLogger("io.troupe.player.wire");
        Level before = logger.getLevel();
        logger.setLevel(Level.SEVERE); // errors caused by hostile clients are logged line by line
        try {
            soak(Duration.ofMillis((long) (minutes * 60_000)));
        } finally {
            logger.setLevel(before);
        }
    }

    private void soak(Duration atLeast) throws Exception {
        int storms = atLeast.isZero() ? 1 : Runtime.getRuntime().availableProcessors() + 1;
        var turn = CommandCodec.encode(new DeviceCommand.Velocity(0, 0, 0.1, true));
        var kinds = List.of(
                new Kind("unknown commands", storm(RawClient.message(MessageType.CMD, 4, 0, Content.empty(99)))),
                new Kind("commands", storm(RawClient.message(MessageType.CMD, 4, 0, turn))),
                new Kind("requests, replies unread", storm(RawClient.request(5, 0, Content.empty(1)))),
                new Kind("requests, replies read", ServerSoakTest::ask),
                new Kind("garbage", ServerSoakTest::garbage),
                new Kind("connections", ServerSoakTest::connect),
                new Kind("subscribers that do not read", ServerSoakTest::subscribe),
                new Kind("newest frames only, read late", ServerSoakTest::readNewest));
        var threads = new ArrayList<Thread>();
        try (var served = Served.open();
                var good = RawClient.greeted(served.port());
                var runner = SimulationRunner.start(served.simulation, 1, snapshot -> {}, new Pace.Unlimited())) {
            good.ask(new PlayerRequest.DataMode(Delivery.PULL));
            good.subscribe(Interfaces.SONAR); // no other client drives the robot
            for (var kind : kinds) {
                for (int i = 0; i < storms; i++) {
                    var random = new Random(i);
                    threads.add(Thread.ofPlatform().daemon().start(() -> behave(kind, served.port(), random)));
                }
            }
            long end = System.nanoTime() + atLeast.toNanos();
            long longestNanos = 0;
            long frames = 0;
            long last = System.nanoTime();
            while (frames < FRAMES
                    || kinds.stream().anyMatch(kind -> kind.done().get() < EACH)
                    || last - end < 0) {
                good.ask(new PlayerRequest.NextData());
                assertThat(good.next(MessageType.DATA, 5, 1).header().timeSeconds())
                        .as("the frame after %d others", frames)
                        .isEqualTo(frames * 100_000 / 1e6);
                good.next(MessageType.SYNCH, 1, 1);
                long now = System.nanoTime();
                longestNanos = Math.max(longestNanos, now - last);
                last = now;
                frames++;
            }
            assertThat(runner.isRunning()).isTrue();
            if (!atLeast.isZero()) {
                report(frames, longestNanos, kinds);
            }
        } finally {
            stop.set(true);
        }
        for (var thread : threads) {
            thread.join();
        }
        assertThat(failures).isEmpty();
    }

    private static void report(long frames, long longestNanos, List<Kind> kinds) {
        var runtime = Runtime.getRuntime();
        Logger.getLogger("soak") // the loggers of this package are switched off
                .info(() -> frames + " frames, at most " + longestNanos / 1_000_000 + " ms between two, "
                        + (runtime.totalMemory() - runtime.freeMemory()) / (1 << 20) + " MiB of heap in use; "
                        + String.join(
                                ", ",
                                kinds.stream()
                                        .map(kind -> kind.name() + ": " + kind.done())
                                        .toList()));
    }

    private void behave(Kind kind, int port, Random random) {
        try {
            while (!stop.get()) {
                try {
                    kind.done().addAndGet(kind.behaviour().once(port, random, stop));
                } catch (IOException | AssertionError ended) {
                    kind.done().incrementAndGet(); // closed by the server, which a hostile client has to expect
                }
            }
        } catch (RuntimeException e) {
            failures.add(e);
        }
    }

    /** Sends one message repeatedly; from time to time over a new connection. */
    private static Behaviour storm(byte[] message) {
        var many = new byte[100 * message.length];
        for (int i = 0; i < 100; i++) {
            System.arraycopy(message, 0, many, i * message.length, message.length);
        }
        boolean unread = message[19] == MessageType.REQ.code();
        return (port, random, stop) -> {
            try (var client = new RawClient(port)) {
                OutputStream out = client.socket.getOutputStream();
                if (unread) { // as much as fits without blocking
                    out.write(many, 0, 10 * message.length);
                    return 10;
                }
                for (int i = 0; i < 1_000 && !stop.get(); i++) {
                    out.write(many);
                }
                return 100_000;
            }
        };
    }

    private static long ask(int port, Random random, AtomicBoolean stop) throws IOException {
        try (var client = RawClient.greeted(port)) {
            for (int i = 0; i < 100 && !stop.get(); i++) {
                client.sync();
            }
            return 100;
        }
    }

    private static long garbage(int port, Random random, AtomicBoolean stop) throws IOException {
        try (var client = new RawClient(port)) {
            var bytes = new byte[random.nextInt(400)];
            random.nextBytes(bytes);
            client.send(bytes);
            return 1;
        }
    }

    private static long connect(int port, Random random, AtomicBoolean stop) throws IOException {
        try (var client = new RawClient(port)) {
            if (random.nextBoolean()) {
                client.socket.setSoLinger(true, 0);
            }
            return 1;
        }
    }

    private static long subscribe(int port, Random random, AtomicBoolean stop) throws IOException {
        try (var client = RawClient.greeted(port)) {
            client.subscribe(Interfaces.BLOBFINDER);
            return 10;
        }
    }

    /** Frames that a replace rule conflates while the client does not read, in order of their times. */
    private static long readNewest(int port, Random random, AtomicBoolean stop) throws IOException {
        try (var client = RawClient.greeted(port)) {
            client.ask(new PlayerRequest.AddRule(
                    new ReplaceRule(-1, -1, MessageType.DATA.code(), -1, ReplaceRule.REPLACE)));
            client.ask(new PlayerRequest.DataMode(Delivery.PUSH));
            client.subscribe(Interfaces.BLOBFINDER);
            double before = -1;
            for (int i = 0; i < 10 && !stop.get(); i++) {
                LockSupport.parkNanos(random.nextInt(2_000_000));
                double now = client.next(MessageType.DATA, Interfaces.BLOBFINDER.code(), 1)
                        .header()
                        .timeSeconds();
                if (now <= before) {
                    throw new IllegalStateException("a frame of " + now + " s after one of " + before + " s");
                }
                before = now;
            }
            return 10;
        }
    }
}
