package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Clock;
import io.troupe.actor.ManualClock;
import io.troupe.actor.Promise;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.ConnectionClosedException;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.DeviceBinding;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.Scenario;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A world whose robots are offered on Player ports of this JVM, in lock step with the clients that answer.
 *
 * <p><b>Role.</b> Opened from a scenario. {@link #tick} advances it; {@link #close} closes its ports and disconnects
 * its clients.
 *
 * <p><b>Threads.</b> One thread calls {@code tick}; clients connect and send commands from any thread.
 *
 * <p><b>Order.</b> In a tick, every subscribed client gets its frame. When all have answered, the commands sent before
 * the answers take effect, client by client in the order in which they connected; if two clients drive one robot, the
 * command of the later client counts. Then the world advances by one interval. The clients of one actor space get their
 * frames in one turn of that space and have answered when the space is idle. This includes a client that closes itself
 * in that turn; a client that connects in that turn takes part from the next tick on (ADR 0003). A thread that replaces
 * its client must connect the new one before it closes the old one, or the world advances between the two.
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
    private final PauseControl time = new PauseControl(lock);
    private final Set<ClientConnection> clients = new LinkedHashSet<>(); // in the order in which they connected
    private final List<PlayerPorts.Registration> ports = new ArrayList<>();
    private final RobotDrivers drivers;
    private Duration answerLimit = ANSWER_LIMIT;
    private @Nullable Runnable whileWaiting;
    private @Nullable Object pausedBy;
    private int connected;
    private boolean lockStep = true;
    private boolean disconnectsSilent;
    private final Map<Integer, SpeedOverride> overrides = new TreeMap<>(); // by robot
    private boolean closed;
    private volatile boolean waitsForClients;

    /** A speed that counts instead of what clients command. */
    private record SpeedOverride(double forwardMps, double turnRadps) {}

    private Simulation(World world) {
        this.world = world;
        this.drivers = new RobotDrivers(world);
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

    /** Simulated time, for actor spaces whose timers follow it. */
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
     * Sets an action that {@link #tick} repeats while it waits for answers, for example to run a space that has no
     * thread.
     */
    public void whileWaiting(Runnable action) {
        whileWaiting = Objects.requireNonNull(action, "action");
    }

    /**
     * Sets how long a tick may wait for its answers, in wall-clock time; the default is 10 seconds. Paused time does
     * not count, except for a tick that {@link #step} has let pass.
     */
    public void answerLimit(Duration limit) {
        if (limit.isNegative() || limit.isZero()) {
            throw new IllegalArgumentException("answer limit is " + limit + ", expected more than nothing");
        }
        answerLimit = limit;
    }

    /** Sets the clock that measures the answer limit. */
    void wallClock(Clock clock) {
        time.wallClock(clock);
    }

    /**
     * Sets whether ticks wait for the clients' answers; they do by default. Otherwise the world runs freely, as in
     * Stage: slow clients miss frames, and only a recording makes a run repeatable.
     */
    public void lockStep(boolean waits) {
        withLock(() -> lockStep = waits);
    }

    /** Called under the lock. A closed simulation waits for no client. */
    boolean isLockStep() {
        return lockStep && !closed;
    }

    /**
     * Sets whether a client that does not answer in time is disconnected, with a warning in the log, instead of ending
     * the tick. For worlds that unknown clients may connect to.
     */
    public void disconnectSilentClients(boolean disconnects) {
        withLock(() -> disconnectsSilent = disconnects);
    }

    /** True if any client is subscribed to a device. */
    public boolean hasSubscribers() {
        return withLock(() -> clients.stream().anyMatch(ClientConnection::isSubscribed));
    }

    /**
     * Waits while time is paused; then publishes a frame, waits for the answers, and advances the world by one
     * interval.
     *
     * @throws UnansweredTickException if a client does not answer in time and is not to be disconnected; the world has
     *     not advanced
     * @throws IllegalStateException if this simulation is closed, or the caller is interrupted while it waits
     */
    public Snapshot tick() {
        return tick(null, Double.NaN);
    }

    /** As {@link #tick()}, and also waits until the interval has passed at the current pace. */
    Snapshot tick(RealTimePacer pacer, Pace pace) {
        return tick(pacer, withLock(() -> pace.factor(clients.stream().anyMatch(ClientConnection::isFreeRunning))));
    }

    private Snapshot tick(@Nullable RealTimePacer pacer, double factor) {
        time.awaitUnpaused(whileWaiting);
        Snapshot now = world.latest();
        List<ClientConnection> subscribers = withLock(() -> {
            if (closed) {
                throw new IllegalStateException(CLOSED);
            }
            clients.forEach(client -> client.tickBegins(now.tick()));
            return clients.stream().filter(ClientConnection::isSubscribed).toList();
        });
        publish(now, subscribers);
        awaitAnswers(now.tick(), subscribers);
        if (pacer != null) {
            if (time.takeStoodStill()) {
                pacer.restart();
            }
            pacer.await(now.timeMicros(), now.timeMicros() + world.spec().intervalMillis() * 1000L, factor);
        }
        // Under the same lock as the last answer: all commands sent before the answers are here, later ones wait
        // for the next tick.
        withLock(() -> {
            clients.forEach(client -> client.takeCommands().forEach(Runnable::run));
            overrides.forEach((robot, speed) -> world.command(robot, speed.forwardMps(), speed.turnRadps()));
            return now;
        });
        return world.advance();
    }

    // ---- time and place

    /**
     * Stops simulated time after the current tick; {@link #tick} then waits. Requests are still answered; their changes
     * take effect when time continues. A pause requested by a client ends when that client disconnects; this one ends
     * only by {@link #resume} or by a client's request.
     */
    public void pause() {
        setPaused(true);
    }

    /** Continues simulated time. */
    public void resume() {
        setPaused(false);
    }

    public boolean isPaused() {
        return time.isPaused();
    }

    private void setPaused(boolean wanted) {
        withLock(() -> {
            pausedBy = null;
            Recording recording = world.recording();
            if (time.pause(wanted) && recording != null) {
                recording.paused(wanted);
            }
            return wanted;
        });
    }

    /**
     * Called under the lock. The pause ends when this client disconnects, because no other client may be able to end
     * it.
     */
    void togglePause(Object client) {
        boolean wanted = !time.isPaused();
        setPaused(wanted);
        pausedBy = wanted ? client : null;
    }

    /** Called under the lock. */
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
     * Moves a robot to a pose at the end of this tick.
     *
     * @throws IllegalArgumentException if it would overlap something there
     */
    public void teleport(int robot, Pose pose) {
        world.teleport(robot, pose);
    }

    /**
     * Puts a box into the world at the end of this tick, or moves it.
     *
     * @throws IllegalArgumentException if it would overlap a robot there
     */
    public void putBox(ColouredBox box) {
        world.putBox(box);
    }

    /** Removes a box at the end of this tick, if it is there. */
    public void removeBox(int number) {
        world.removeBox(number);
    }

    /**
     * Drives a robot from the end of this tick on, whatever clients command, until {@link #endOverride}.
     *
     * @throws IllegalArgumentException if there is no such robot, or a speed is not finite
     */
    public void override(int robot, double forwardMps, double turnRadps) {
        world.command(robot, forwardMps, turnRadps); // checks them
        withLockNoNotify(() -> overrides.put(robot, new SpeedOverride(forwardMps, turnRadps)));
    }

    /** Stops a robot at the end of this tick, and lets clients drive it again. */
    public void endOverride(int robot) {
        withLockNoNotify(() -> overrides.remove(robot));
        world.stop(robot);
    }

    /** Resets the world at the end of this tick, as {@link World#reset} does. */
    public void reset() {
        world.reset();
    }

    /**
     * Records all input of this world from tick 0 on, for a {@link Replay}; closing the simulation ends the recording.
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

    /** As {@link #close()}, with a reason for the clients. */
    void close(String reason) {
        List<ClientConnection> left = withLock(() -> {
            closed = true;
            time.close();
            return List.copyOf(clients);
        });
        ports.forEach(PlayerPorts.Registration::close);
        try (world) { // closed even if the recording throws
            left.forEach(client -> client.disconnect(reason));
            Recording recording = world.recording();
            if (recording != null) {
                recording.close();
            }
        }
    }

    private void publish(Snapshot now, List<ClientConnection> subscribers) {
        long nanos = now.timeMicros() * 1000;
        Map<ActorSpace, List<ClientConnection>> bySpace = new LinkedHashMap<>();
        for (var client : subscribers) {
            ActorSpace space = client.space();
            if (space != null) {
                bySpace.computeIfAbsent(space, each -> new ArrayList<>()).add(client);
            }
        }
        if (bySpace.isEmpty()) {
            clock.advanceTo(nanos);
        }
        for (var client : subscribers) {
            if (client.space() == null) {
                client.deliver(now);
            }
        }
        bySpace.forEach((space, members) -> publish(now, nanos, space, members));
    }

    private void publish(Snapshot now, long nanos, ActorSpace space, List<ClientConnection> members) {
        Promise<@Nullable Void> end = space.whenClosed();
        end.toCompletableFuture().thenRun(() -> members.forEach(ClientConnection::spaceClosed));
        try {
            space.execute(() -> {
                // In one turn, so that timers that are due run after the frames. This turn may run after a later
                // tick: the world does not wait for a space whose clients have been closed by another thread.
                clock.advanceToAtLeast(nanos);
                members.forEach(client -> client.deliver(now));
            });
            space.onIdle(() -> {
                end.cancel();
                withLock(() -> {
                    members.forEach(client -> client.spaceIsIdle(now.tick()));
                    return now;
                });
            });
        } catch (ActorStoppedException spaceIsClosed) {
            end.cancel();
            members.forEach(ClientConnection::spaceClosed);
        }
    }

    private void awaitAnswers(long tick, List<ClientConnection> subscribers) {
        long deadline = time.runningNanos() + answerLimit.toNanos();
        // number of leading clients that have answered, so that each new answer does not check all clients again
        int answered = 0;
        while (true) {
            if (whileWaiting != null) {
                whileWaiting.run();
            }
            List<ClientConnection> silent;
            synchronized (lock) {
                while (answered < subscribers.size()
                        && subscribers.get(answered).hasAnswered(tick)) {
                    answered++;
                }
                long leftMillis = (deadline - time.runningNanos()) / 1_000_000;
                if (answered < subscribers.size() && leftMillis > 0) {
                    await(whileWaiting == null ? leftMillis : 1);
                    continue;
                }
                answered = 0;
                silent = subscribers.stream()
                        .filter(client -> !client.hasAnswered(tick))
                        .toList();
                if (silent.isEmpty()) {
                    return;
                }
                if (leftMillis > 0) {
                    continue; // a client has withdrawn its answer
                }
                if (!disconnectsSilent) {
                    throw new UnansweredTickException(tick, answerLimit, silent);
                }
            }
            silent.forEach(client -> disconnect(client, tick));
        }
    }

    private void disconnect(ClientConnection client, long tick) {
        String reason = "tick " + tick + " was not answered within " + answerLimit;
        LOG.log(System.Logger.Level.WARNING, client + " is disconnected: " + reason);
        client.disconnect(reason);
    }

    private void await(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting for the clients", e);
        }
    }

    // ---- for client connections and runners

    /** Runs an action under the lock that guards the clients, and wakes a waiting tick. */
    <T> T withLock(Supplier<T> action) {
        synchronized (lock) {
            T result = action.get();
            lock.notifyAll();
            return result;
        }
    }

    /** As {@link #withLock}, for changes that no tick waits for. */
    <T> T withLockNoNotify(Supplier<T> action) {
        synchronized (lock) {
            return action.get();
        }
    }

    int add(ClientConnection client) {
        return withLock(() -> {
            if (closed) {
                throw new ConnectionClosedException(CLOSED);
            }
            clients.add(client);
            return ++connected;
        });
    }

    void remove(ClientConnection client) {
        clients.remove(client);
    }

    RobotDrivers drivers() {
        return drivers;
    }

    /** Sleeps for a pacer, at most for the given time. */
    void sleep(long nanos) {
        time.sleep(nanos);
    }

    boolean isClosed() {
        return withLock(() -> closed);
    }

    boolean waitsForClients() {
        return waitsForClients;
    }

    /** Waits until the given number of clients wait for data; false if the simulation is closed. */
    boolean awaitClients(int count) throws InterruptedException {
        try {
            synchronized (lock) {
                while (!closed
                        && clients.stream().filter(ClientConnection::hasStarted).count() < count) {
                    time.standsStill();
                    waitsForClients = true;
                    lock.wait();
                }
                return !closed;
            }
        } finally {
            waitsForClients = false;
        }
    }
}
