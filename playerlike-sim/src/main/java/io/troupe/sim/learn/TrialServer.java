package io.troupe.sim.learn;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.BufferUnderflowException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.function.LongFunction;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Lets another program, such as one in Python, step a batch of trials over a pair of streams.
 *
 * {@snippet :
 * try (var server = TrialServer.of(4, seed -> RandomWorld.arena(seed, 8, 0.1).withRobots(1))) {
 *     server.serve(in, out);
 * }
 * }
 *
 * <p><b>Role.</b> The observations are those of {@link Trial}, bit for bit, on any number of threads.
 *
 * <p><b>Units and shapes.</b> All numbers are big-endian. A frame is its length (4 bytes) and so many bytes. The server
 * begins with a frame of JSON text: {@code protocol} (1), {@code worlds}, {@code robots} in each, {@code sonars} of
 * each robot, {@code greatestRangeM} and {@code intervalS}. Then it answers each request, in order. A request has for
 * each world a byte: 0 leaves it alone, 1 steps it, with two doubles for each robot (m/s, rad/s, left positive), 2
 * resets it, with a seed of 8 bytes. The answer is a byte 0, then for each world that was not left alone the time (s)
 * as double, and for each robot x, y (m), heading (rad), 1 or 0 for stalled, 1 or 0 for collided, and all ranges (m),
 * as doubles.
 *
 * <p><b>Threads.</b> {@link #serve} is for one thread at a time.
 *
 * <p><b>Errors.</b> The answer to a wrong request is a byte 1 and a line of text in UTF-8; then no world has changed.
 * The same is the answer if a world cannot be built from a seed; then all worlds have to be reset.
 */
public final class TrialServer implements AutoCloseable {
    private static final int PROTOCOL = 1;
    private static final byte LEAVE = 0;
    private static final byte STEP = 1;
    private static final byte RESET = 2;
    private static final byte DONE = 0;
    private static final byte REFUSED = 1;
    private static final int OF_ROBOT = 5; // numbers of a robot before its ranges

    private final List<Trial> trials;
    private final boolean[] begun;
    private final int robots;
    private final int sonars;
    private final double greatestRangeM;
    private final double intervalS;
    private final List<ExecutorService> workers; // a world is always stepped by the same one

    /** What a request demands of one world. */
    private record Demand(int world, double @Nullable [] actions, long seed) {}

    private TrialServer(int worlds, LongFunction<WorldSpec> build, WorldSettings settings, int threads) {
        if (worlds < 1) {
            throw new IllegalArgumentException(worlds + " worlds, expected at least 1");
        }
        WorldSpec sample = build.apply(settings.seed());
        List<SonarSpec> rings = new ArrayList<>();
        for (RobotSpec robot : sample.robots()) {
            SonarSpec ring = robot.sonar();
            if (ring == null
                    || !rings.isEmpty()
                            && ring.mounts().size() != rings.getFirst().mounts().size()) {
                throw new IllegalArgumentException("robot '" + robot.name()
                        + "' has no sonars, or another number of them, expected as many for each robot");
            }
            rings.add(ring);
        }
        if (rings.isEmpty()) {
            throw new IllegalArgumentException("world '" + sample.name() + "' has no robots, expected at least one");
        }
        trials = IntStream.range(0, worlds)
                .mapToObj(i -> Trial.of(build, settings))
                .toList();
        begun = new boolean[worlds];
        robots = rings.size();
        sonars = rings.getFirst().mounts().size();
        greatestRangeM = rings.stream().mapToDouble(SonarSpec::maxRangeM).max().orElseThrow();
        intervalS = sample.intervalMillis() / 1000.0;
        int count = Math.clamp(worlds, 1, threads);
        workers = IntStream.range(0, count == 1 ? 0 : count)
                .mapToObj(i -> Executors.newSingleThreadExecutor(
                        Thread.ofPlatform().daemon().name("worlds-" + i).factory()))
                .toList();
    }

    /** A server of worlds with the default settings, which steps them on all cores. */
    public static TrialServer of(int worlds, LongFunction<WorldSpec> build) {
        return of(worlds, build, WorldSettings.defaults(), Runtime.getRuntime().availableProcessors());
    }

    /** A server of worlds; each reset replaces the seed of the settings. */
    public static TrialServer of(int worlds, LongFunction<WorldSpec> build, WorldSettings settings, int threads) {
        return new TrialServer(worlds, requireNonNull(build, "build"), requireNonNull(settings, "settings"), threads);
    }

    /**
     * Answers requests until the input ends.
     *
     * @throws IOException if a stream fails, the input ends within a frame, or a frame is too long
     */
    public void serve(InputStream in, OutputStream out) throws IOException {
        var requests = new DataInputStream(in);
        var answers = new DataOutputStream(out);
        send(answers, ByteBuffer.wrap(hello().getBytes(StandardCharsets.UTF_8)));
        int longest = trials.size() * (1 + Math.max(Long.BYTES, 2 * robots * Double.BYTES));
        while (true) {
            int first = requests.read();
            if (first < 0) {
                return;
            }
            int length = first << 24 | requests.readUnsignedByte() << 16 | requests.readUnsignedShort();
            if (length < 0 || length > longest) {
                throw new IOException("a request of " + Integer.toUnsignedString(length) + " bytes, expected at most "
                        + longest + " for " + trials.size() + " worlds");
            }
            var body = new byte[length];
            requests.readFully(body);
            send(answers, answer(ByteBuffer.wrap(body)));
        }
    }

    private String hello() {
        return String.format(
                Locale.ROOT,
                "{\"protocol\":%d,\"worlds\":%d,\"robots\":%d,\"sonars\":%d,\"greatestRangeM\":%s,\"intervalS\":%s}",
                PROTOCOL,
                trials.size(),
                robots,
                sonars,
                greatestRangeM,
                intervalS);
    }

    private static void send(DataOutputStream to, ByteBuffer body) throws IOException {
        to.writeInt(body.limit());
        to.write(body.array(), 0, body.limit());
        to.flush();
    }

    private ByteBuffer answer(ByteBuffer request) {
        try {
            List<Demand> demands = demands(request);
            var seen = new Observation[demands.size()];
            fulfil(demands, seen);
            return encoded(seen);
        } catch (IllegalArgumentException | IllegalStateException wrong) {
            byte[] message = String.valueOf(wrong.getMessage()).getBytes(StandardCharsets.UTF_8);
            return ByteBuffer.allocate(1 + message.length)
                    .put(REFUSED)
                    .put(message)
                    .flip();
        }
    }

    private List<Demand> demands(ByteBuffer request) {
        List<Demand> demands = new ArrayList<>();
        int world = 0;
        try {
            for (; world < trials.size(); world++) {
                byte kind = request.get();
                switch (kind) {
                    case LEAVE -> {}
                    case STEP -> demands.add(new Demand(world, actions(world, request), 0));
                    case RESET -> demands.add(new Demand(world, null, request.getLong()));
                    default ->
                        throw new IllegalArgumentException(
                                "world " + world + ": kind " + kind + ", expected 0 (leave), 1 (step) or 2 (reset)");
                }
            }
        } catch (BufferUnderflowException tooShort) {
            throw new IllegalArgumentException(
                    "the request ends after " + request.limit() + " bytes, expected more for world " + world, tooShort);
        }
        if (request.hasRemaining()) {
            throw new IllegalArgumentException(request.remaining() + " bytes after the last world, expected none");
        }
        return demands;
    }

    private double[] actions(int world, ByteBuffer request) {
        if (!begun[world]) {
            throw new IllegalStateException("world " + world + ": a step before the first reset");
        }
        var actions = new double[2 * robots];
        for (int i = 0; i < actions.length; i++) {
            actions[i] = request.getDouble();
            if (!Double.isFinite(actions[i])) {
                throw new IllegalArgumentException(
                        "world " + world + ": an action of " + actions[i] + ", expected finite numbers");
            }
        }
        return actions;
    }

    /** Fulfils the demands, those of each worker in order, and rethrows the first failure. */
    private void fulfil(List<Demand> demands, Observation[] seen) {
        if (workers.isEmpty()) {
            for (int i = 0; i < seen.length; i++) {
                seen[i] = fulfil(demands.get(i));
            }
            return;
        }
        List<Future<?>> running = new ArrayList<>();
        for (int i = 0; i < seen.length; i++) {
            int index = i;
            Demand demand = demands.get(i);
            running.add(workers.get(demand.world() % workers.size()).submit(() -> {
                seen[index] = fulfil(demand);
            }));
        }
        RuntimeException failure = null;
        for (Future<?> each : running) {
            try {
                each.get();
            } catch (ExecutionException failed) {
                if (!(failed.getCause() instanceof RuntimeException thrown)) {
                    throw new IllegalStateException(failed.getCause());
                }
                failure = failure == null ? thrown : failure;
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
                throw new CancellationException("interrupted while worlds were stepped");
            }
        }
        if (failure != null) {
            throw failure;
        }
    }

    private Observation fulfil(Demand demand) {
        Trial trial = trials.get(demand.world());
        double[] actions = demand.actions();
        if (actions != null) {
            return trial.step(actions);
        }
        begun[demand.world()] = false;
        Observation seen = trial.reset(demand.seed());
        begun[demand.world()] = true;
        return seen;
    }

    private ByteBuffer encoded(Observation[] seen) {
        int numbers = 1 + robots * (OF_ROBOT + sonars);
        ByteBuffer body =
                ByteBuffer.allocate(1 + seen.length * numbers * Double.BYTES).put(DONE);
        for (Observation observation : seen) {
            body.putDouble(observation.timeS());
            for (int robot = 0; robot < robots; robot++) {
                body.putDouble(observation.x(robot));
                body.putDouble(observation.y(robot));
                body.putDouble(observation.headingRad(robot));
                body.putDouble(observation.stalled(robot) ? 1 : 0);
                body.putDouble(observation.collided(robot) ? 1 : 0);
                for (int sonar = 0; sonar < sonars; sonar++) {
                    body.putDouble(observation.rangeM(robot, sonar));
                }
            }
        }
        return body.flip();
    }

    /** Ends the threads. */
    @Override
    public void close() {
        workers.forEach(ExecutorService::close);
    }
}
