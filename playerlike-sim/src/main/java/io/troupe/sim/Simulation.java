package io.troupe.sim;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.time.Clock;
import io.troupe.actor.time.ManualClock;
import io.troupe.player.PlayerPorts;
import io.troupe.sim.scenario.DeviceBinding;
import io.troupe.sim.scenario.Scenario;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * A world whose robots are offered on Player ports of this JVM, in lock step with the programs that drive them.
 *
 * <p><b>Role.</b> Opened from a scenario; {@link #tick} moves it on; closing it closes its ports and disconnects its clients.
 * <p><b>Threads.</b> One thread calls {@code tick}; clients connect and command from any thread.
 * <p><b>Order.</b> A tick: every subscribed client gets its frame; when all have answered, their commands take effect, in the order of robots, and the world
 * advances by one interval. Clients of one actor space get their frames in one turn of it and have answered when the space is idle (ADR 0003).
 * <p><b>Errors.</b> {@link UnansweredTickException} if a client does not answer in time.
 */
public final class Simulation implements AutoCloseable {
    private static final Duration ANSWER_LIMIT = Duration.ofSeconds(10);

    private final World world;
    private final ManualClock clock = new ManualClock();
    private final Object lock = new Object();
    private final List<ClientLine> lines = new ArrayList<>();
    private final List<PlayerPorts.Registration> ports = new ArrayList<>();
    private final int[] drivers;
    private Duration answerLimit = ANSWER_LIMIT;
    private @Nullable Runnable whileWaiting;
    private int connected;
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

    /** Something to do again and again while {@link #tick} waits for answers, for example to crank a space that has no thread. */
    public void whileWaiting(Runnable action) {
        whileWaiting = Objects.requireNonNull(action, "action");
    }

    /** How long a tick may wait for its answers, by the machine's clock; 10 seconds unless set. */
    public void answerLimit(Duration limit) {
        answerLimit = limit;
    }

    /** Whether any client has subscribed to anything. */
    public boolean hasSubscribers() {
        synchronized (lock) {
            return lines.stream().anyMatch(ClientLine::isSubscribed);
        }
    }

    /** Publishes, waits for the answers, and advances the world by one interval. */
    public Snapshot tick() {
        Snapshot now = world.latest();
        List<ClientLine> audience;
        synchronized (lock) {
            audience = lines.stream().filter(ClientLine::isSubscribed).toList();
        }
        publish(now, audience);
        awaitAnswers(now.tick(), audience);
        return world.advance();
    }

    /** Disconnects all clients and closes the ports. */
    @Override
    public void close() {
        List<ClientLine> left;
        synchronized (lock) {
            closed = true;
            left = List.copyOf(lines);
            lines.clear();
            lock.notifyAll();
        }
        ports.forEach(PlayerPorts.Registration::close);
        left.forEach(line -> line.lose("the simulated world has been closed"));
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
        bySpace.forEach((space, members) -> {
            space.execute(() -> {
                clock.advanceTo(nanos); // in the same turn, so that what is due runs after the frames, not beside them
                members.forEach(line -> line.deliver(now));
            });
            space.onIdle(() -> members.forEach(line -> line.answered(now.tick())));
        });
    }

    private void awaitAnswers(long tick, List<ClientLine> audience) {
        Clock wall = Clock.system();
        long deadline = wall.nanos() + answerLimit.toNanos();
        while (true) {
            if (whileWaiting != null) {
                whileWaiting.run();
            }
            synchronized (lock) {
                var silent = audience.stream()
                        .filter(line -> !line.hasAnswered(tick))
                        .toList();
                if (silent.isEmpty()) {
                    return;
                }
                long leftMillis = (deadline - wall.nanos()) / 1_000_000;
                if (leftMillis <= 0) {
                    throw new UnansweredTickException(tick, answerLimit, silent);
                }
                await(whileWaiting == null ? leftMillis : 1);
            }
        }
    }

    private void await(long millis) {
        try {
            lock.wait(millis);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting for the clients", e);
        }
    }

    // ---- for client lines

    int add(ClientLine line) {
        synchronized (lock) {
            if (closed) {
                throw new IllegalStateException("the simulated world has been closed");
            }
            lines.add(line);
            return ++connected;
        }
    }

    void remove(ClientLine line) {
        synchronized (lock) {
            lines.remove(line);
            lock.notifyAll();
        }
    }

    /** Something has changed that a tick may wait for. */
    void changed(Runnable change) {
        synchronized (lock) {
            change.run();
            lock.notifyAll();
        }
    }

    /** Counts who may drive a robot; one that nobody may drive any more stops. */
    void countDrivers(int robot, int change) {
        synchronized (lock) {
            drivers[robot] += change;
            if (drivers[robot] == 0) {
                world.stop(robot);
            }
        }
    }

    /** Waits until somebody subscribes, or the world is closed; for runners. */
    boolean awaitSubscriber() throws InterruptedException {
        synchronized (lock) {
            while (!closed && lines.stream().noneMatch(ClientLine::isSubscribed)) {
                lock.wait();
            }
            return !closed;
        }
    }
}
