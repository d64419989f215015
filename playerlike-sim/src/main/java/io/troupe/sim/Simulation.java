package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.ManualClock;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.sim.scenario.DeviceBinding;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.Scenario;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A world whose robots are offered on Player ports of this JVM, in lock step with the programs that drive them, as far
 * as they answer.
 *
 * <p><b>Role.</b> Opened from a scenario; {@link #tick} moves it on; closing it closes its ports and disconnects its
 * clients.
 *
 * <p><b>Threads.</b> One thread calls {@code tick}; clients connect and command from any thread.
 *
 * <p><b>Order.</b> A tick: every subscribed client gets its frame; when all have answered, what they said before their
 * answers takes effect, client by client in the order in which they connected, so that of two clients that drive one
 * robot the one that came later counts, and the world advances by one interval. Clients of one actor space get their
 * frames in one turn of it and have answered when the space is idle, also one that closes itself in that turn; so a
 * client that the turn connects anew takes part from the next tick on (ADR 0003). A thread that changes its client
 * connects the new one before it closes the old: between the two the world would run on.
 *
 * <p><b>Errors.</b> {@link UnansweredTickException} if a client does not answer in time.
 */
public final class Simulation implements AutoCloseable {
    static final String CLOSED = "the simulated world has been closed";
    private static final System.Logger LOG = System.getLogger(Simulation.class.getName());
    private static final Duration ANSWER_LIMIT = Duration.ofSeconds(10);

    private final World world;
    private final ManualClock clock = new ManualClock();
    private final Object lock = new Object();
    private final TimeGate time = new TimeGate(lock);
    private final Set<ClientLine> lines = new LinkedHashSet<>(); // in the order in which they came
    private final List<PlayerPorts.Registration> ports = new ArrayList<>();
    private final int[] drivers;
    private Duration answerLimit = ANSWER_LIMIT;
    private @Nullable Runnable whileWaiting;
    private @Nullable Object pausedBy;
    private int connected;
    private boolean lockStep = true;
    private boolean disconnectsSilent;
    private boolean closed;

    private Simulation(World world) {
        this.world = world;
        this.drivers = new int[world.spec().robots().size()];
    }

    /**
     * Creates the world of a scenario and opens its ports.
     *
     * @throws io.troupe.player.PlayerException if a port is open already
     */
    public static Simulation open(Scenario scenario, WorldSettings settings) {
        var simulation = new Simulation(World.create(scenario.world(), settings));
        Map<Integer, List<DeviceBinding>> byPort = new LinkedHashMap<>();
        for (var binding : scenario.devices()) {
            byPort.computeIfAbsent(binding.port(), port -> new ArrayList<>()).add(binding);
        }
        try {
            byPort.forEach((port, bindings) ->
                    simulation.ports.add(PlayerPorts.open(port, new PortServer(simulation, port, bindings))));
        } catch (RuntimeException e) {
            simulation.close();
            throw e;
        }
        return simulation;
    }

    public World world() {
        return world;
    }

    /** Simulated time, for actor spaces whose timers shall follow it. */
    public Clock clock() {
        return clock;
    }

    public Snapshot latest() {
        return world.latest();
    }

    public long timeMicros() {
        return world.timeMicros();
    }

    /**
     * Something to do again and again while {@link #tick} waits for answers, for example to crank a space that has no
     * thread.
     */
    public void whileWaiting(Runnable action) {
        whileWaiting = Objects.requireNonNull(action, "action");
    }

    /**
     * How long a tick may wait for its answers, by the machine's clock; 10 seconds unless set. While time is paused it
     * does not count, except for a tick that {@link #step} has let pass.
     */
    public void answerLimit(Duration limit) {
        if (limit.isNegative() || limit.isZero()) {
            throw new IllegalArgumentException("answer limit is " + limit + ", expected more than nothing");
        }
        answerLimit = limit;
    }

    /** Measures the answer limit. */
    void wallClock(Clock clock) {
        time.wallClock(clock);
    }

    /**
     * Whether ticks wait for the clients' answers, as they do unless this says otherwise. If not, the world goes on
     * like Stage's: at the pace of time, whoever is slow misses something, and a run cannot be repeated but from a
     * recording.
     */
    public void lockStep(boolean waits) {
        under(() -> lockStep = waits);
    }

    /** Under the lock. A closed simulation waits for nobody. */
    boolean isLockStep() {
        return lockStep && !closed;
    }

    /**
     * Whether a client that does not answer in time is disconnected, with a warning in the log, instead of ending the
     * tick; for worlds that strangers connect to.
     */
    public void disconnectSilentClients(boolean disconnects) {
        under(() -> disconnectsSilent = disconnects);
    }

    /** Whether any client has subscribed to anything. */
    public boolean hasSubscribers() {
        return under(() -> lines.stream().anyMatch(ClientLine::isSubscribed));
    }

    /**
     * Waits while time is paused; then publishes, waits for the answers, and advances the world by one interval.
     *
     * @throws UnansweredTickException if a client does not answer in time and is not to be disconnected; the world
     *     stands where it stood
     * @throws IllegalStateException if this simulation is closed, or the caller is interrupted while it waits
     */
    public Snapshot tick() {
        return tick(null, Double.NaN);
    }

    /** The same, waiting as well until the interval has passed at the pace that holds now. */
    Snapshot tick(Pacer pacer, Pace pace) {
        return tick(pacer, under(() -> pace.factor(lines.stream().anyMatch(ClientLine::isFreeRunning))));
    }

    private Snapshot tick(@Nullable Pacer pacer, double factor) {
        time.awaitTime(whileWaiting);
        Snapshot now = world.latest();
        List<ClientLine> audience = under(() -> {
            if (closed) {
                throw new IllegalStateException(CLOSED);
            }
            lines.forEach(line -> line.tickBegins(now.tick()));
            return lines.stream().filter(ClientLine::isSubscribed).toList();
        });
        publish(now, audience);
        awaitAnswers(now.tick(), audience);
        if (pacer != null) {
            if (time.takeStoodStill()) {
                pacer.restart();
            }
            pacer.await(now.timeMicros(), now.timeMicros() + world.spec().intervalMillis() * 1000L, factor);
        }
        // Under the lock in which the last answer was seen: all that was said before the answers is there, what comes
        // later waits for the next tick.
        under(() -> {
            lines.forEach(line -> line.takeCommands().forEach(Runnable::run));
            return now;
        });
        return world.advance();
    }

    // ---- time and place

    /**
     * Stops simulated time after the tick that is being played; {@link #tick} then waits. Requests are still answered;
     * what they change takes effect when time goes on. A pause that a client has asked for ends when that client
     * leaves, this one only by {@link #resume} or a client's asking again.
     */
    public void pause() {
        setPaused(true);
    }

    /** Lets time go on. */
    public void resume() {
        setPaused(false);
    }

    public boolean isPaused() {
        return time.isPaused();
    }

    private void setPaused(boolean wanted) {
        under(() -> {
            pausedBy = null;
            Recording recording = world.recording();
            if (time.pause(wanted) && recording != null) {
                recording.paused(wanted);
            }
            return wanted;
        });
    }

    /** Under the lock. A pause ends with the client that asked for it, or nobody might be left who can end it. */
    void togglePause(Object client) {
        boolean wanted = !time.isPaused();
        setPaused(wanted);
        pausedBy = wanted ? client : null;
    }

    /** Under the lock. */
    void endPauseOf(Object client) {
        if (pausedBy == client) {
            setPaused(false);
        }
    }

    /**
     * Lets one tick pass while time is paused.
     *
     * @throws IllegalStateException if it is not paused
     */
    public void step() {
        time.step();
    }

    /**
     * Puts a robot elsewhere at the end of this tick.
     *
     * @throws IllegalArgumentException if it would overlap something there
     */
    public void teleport(int robot, Pose pose) {
        world.teleport(robot, pose);
    }

    /** Everything back to its start at the end of this tick, as by {@link World#reset}. */
    public void reset() {
        world.reset();
    }

    /**
     * Writes down all that enters this world from tick 0 on, for a {@link Replay}; closing the simulation ends it.
     *
     * @throws IllegalStateException if the world has advanced already or is being recorded
     */
    public Recording record(Appendable out) {
        return world.record(out);
    }

    /** Disconnects all clients and closes the ports. */
    @Override
    public void close() {
        close(CLOSED);
    }

    /** The same, telling the clients why. */
    void close(String reason) {
        List<ClientLine> left = under(() -> {
            closed = true;
            time.close();
            return List.copyOf(lines);
        });
        ports.forEach(PlayerPorts.Registration::close);
        try (world) { // whatever the recording throws
            left.forEach(line -> line.lose(reason));
            Recording recording = world.recording();
            if (recording != null) {
                recording.close();
            }
        }
    }

    private void publish(Snapshot now, List<ClientLine> audience) {
        long nanos = now.timeMicros() * 1000;
        Map<ActorSpace, List<ClientLine>> bySpace = new LinkedHashMap<>();
        for (var line : audience) {
            ActorSpace space = line.space();
            if (space != null) {
                bySpace.computeIfAbsent(space, each -> new ArrayList<>()).add(line);
            }
        }
        if (bySpace.isEmpty()) {
            clock.advanceTo(nanos);
        }
        for (var line : audience) {
            if (line.space() == null) {
                line.deliver(now);
            }
        }
        bySpace.forEach((space, members) -> publish(now, nanos, space, members));
    }

    private void publish(Snapshot now, long nanos, ActorSpace space, List<ClientLine> members) {
        Promise<@Nullable Void> end = space.whenClosed();
        end.toCompletableFuture().thenRun(() -> members.forEach(ClientLine::endWithSpace));
        try {
            space.execute(() -> {
                // in the same turn, so that what is due runs after the frames, not beside them; the world does not wait
                // for a
                // space whose clients have been closed by others, so that this turn may come after a later tick
                clock.advanceToAtLeast(nanos);
                members.forEach(line -> line.deliver(now));
            });
            space.onIdle(() -> {
                end.cancel();
                under(() -> {
                    members.forEach(line -> line.spaceIsIdle(now.tick()));
                    return now;
                });
            });
        } catch (ActorStoppedException spaceIsClosed) {
            end.cancel();
            members.forEach(ClientLine::endWithSpace);
        }
    }

    private void awaitAnswers(long tick, List<ClientLine> audience) {
        long deadline = time.runningNanos() + answerLimit.toNanos();
        int answered =
                0; // of the first ones it is known, so that many clients are not asked again whenever one answers
        while (true) {
            if (whileWaiting != null) {
                whileWaiting.run();
            }
            List<ClientLine> silent;
            synchronized (lock) {
                while (answered < audience.size() && audience.get(answered).hasAnswered(tick)) {
                    answered++;
                }
                long leftMillis = (deadline - time.runningNanos()) / 1_000_000;
                if (answered < audience.size() && leftMillis > 0) {
                    await(whileWaiting == null ? leftMillis : 1);
                    continue;
                }
                answered = 0;
                silent = audience.stream()
                        .filter(line -> !line.hasAnswered(tick))
                        .toList();
                if (silent.isEmpty()) {
                    return;
                }
                if (leftMillis > 0) {
                    continue; // one has taken its answer back
                }
                if (!disconnectsSilent) {
                    throw new UnansweredTickException(tick, answerLimit, silent);
                }
            }
            silent.forEach(line -> disconnect(line, tick));
        }
    }

    private void disconnect(ClientLine line, long tick) {
        String reason = "tick " + tick + " was not answered within " + answerLimit;
        LOG.log(System.Logger.Level.WARNING, line + " is disconnected: " + reason);
        line.lose(reason);
    }

    private void await(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting for the clients", e);
        }
    }

    // ---- for client lines and runners

    /** Does something to the clients under the lock that guards them, and lets a tick that waits look again. */
    <T> T under(Supplier<T> action) {
        synchronized (lock) {
            T result = action.get();
            lock.notifyAll();
            return result;
        }
    }

    /** The same for what no tick waits for. */
    <T> T quietly(Supplier<T> action) {
        synchronized (lock) {
            return action.get();
        }
    }

    int add(ClientLine line) {
        return under(() -> {
            if (closed) {
                throw new ConnectionClosedException(CLOSED);
            }
            lines.add(line);
            return ++connected;
        });
    }

    void remove(ClientLine line) {
        lines.remove(line);
    }

    /** Counts who may drive a robot; one that nobody may drive any more stops. */
    void countDrivers(int robot, int change) {
        drivers[robot] += change;
        if (drivers[robot] == 0) {
            world.stop(robot);
        }
    }

    /** Sleeps for a pacer, at most so long. */
    void sleep(long nanos) {
        time.sleep(nanos);
    }

    boolean isClosed() {
        return under(() -> closed);
    }

    /** Waits until so many clients have begun, or the simulation is closed: then it is false. */
    boolean awaitClients(int count) throws InterruptedException {
        synchronized (lock) {
            while (!closed && lines.stream().filter(ClientLine::hasBegun).count() < count) {
                time.standsStill();
                lock.wait();
            }
            return !closed;
        }
    }
}
