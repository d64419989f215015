package io.troupe.services.subsumption;

import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.lang.System.Logger.Level;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalInt;
import java.util.concurrent.CountDownLatch;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The synchronous mode: one connection for all robots, and their services' cycles one after the other.
 *
 * <p><b>Threads.</b> One separate thread does all work, so no atomics and no messages are needed. <b>Order.</b> A
 * colour changes the state at once, after the cycle of the robot that saw it. The old services are not notified, and no
 * zero speed is sent in between. If a robot's next cycle comes only after its speed command has expired
 * ({@link DriverLimits}), the loop repeats the command meanwhile. So the robot keeps its speed as long as this thread
 * lives, and no longer.
 *
 * <p><b>Errors.</b> An error stops all robots and is passed to the {@code failed} consumer of {@link #start}.
 *
 * <p><b>Source.</b> Paper, section 3.4, Figure 14.
 */
final class SynchronousLoop implements AutoCloseable {
    private static final System.Logger LOG = System.getLogger(SynchronousLoop.class.getName());

    private final SubsumptionRun.Settings settings;
    private final Consumer<Throwable> failed;
    private final CountDownLatch started = new CountDownLatch(1);
    private final Thread thread = new Thread(this::run, "robots");
    private volatile boolean closing;

    // confined to the thread
    private List<PlayerRobot> robots = List.of();
    private final List<ServiceCycle> cycles = new ArrayList<>();
    private State state;
    private OptionalInt seen = OptionalInt.empty();
    private int turn;
    private int ended; // of the cycles: so many have been reported as ended
    private double lastCycleSeconds = Double.NEGATIVE_INFINITY;

    private SynchronousLoop(SubsumptionRun.Settings settings, Consumer<Throwable> failed) {
        this.settings = settings;
        this.failed = failed;
        this.state = settings.robots().table().first();
    }

    /** Returns when the services of the first state have started, or have failed to start. */
    static SynchronousLoop start(SubsumptionRun.Settings settings, Consumer<Throwable> failed)
            throws InterruptedException {
        var loop = new SynchronousLoop(settings, failed);
        loop.thread.start();
        try {
            loop.started.await();
            return loop;
        } catch (InterruptedException e) {
            loop.close();
            throw e;
        }
    }

    /** Stops the robots and disconnects. */
    @Override
    public void close() {
        closing = true;
        thread.interrupt();
        boolean interrupted = false;
        while (thread != Thread.currentThread() && thread.isAlive()) {
            try {
                thread.join();
            } catch (InterruptedException e) {
                interrupted = true;
            }
        }
        if (interrupted) {
            Thread.currentThread().interrupt();
        }
    }

    private void run() {
        try (var connection = connect()) {
            drive(connection);
        } catch (RuntimeException | Error error) {
            report(error);
        } finally {
            started.countDown();
        }
    }

    private RobotConnection connect() {
        var table = settings.robots().table();
        return RobotConnection.open(
                settings.robots().host(),
                settings.robots().port(),
                RobotConnection.Delivery.PULL, // one frame holds the readings of all robots
                IntStream.range(0, table.robots())
                        .mapToObj(robot -> new RobotConnection.Devices(robot, true, table.usesLaser(robot)))
                        .toList());
    }

    private void drive(RobotConnection connection) {
        try {
            robots = connection.robots();
            startServices(null);
            started.countDown();
            while (!closing) {
                connection.readAll();
                react();
            }
        } catch (RuntimeException | Error error) {
            // before disconnecting: a world in lock step runs on once its client has left
            report(error);
        } finally {
            halt();
        }
    }

    private void report(Throwable error) {
        if (closing && error instanceof PlayerException) {
            LOG.log(Level.DEBUG, "closed", error);
        } else {
            failed.accept(error);
        }
    }

    private void react() {
        if (!robots.stream().allMatch(PlayerRobot::hasData)) {
            return; // a slow sensor has not sent its first reading yet
        }
        if (settings.round() == SynchronousRound.ALL_SERVICES_A_READING) {
            runAllServices();
        } else if (ReadingTime.isCycle(lastCycleSeconds, robots.get(turn).stampSeconds())) {
            lastCycleSeconds = robots.get(turn).stampSeconds();
            int robot = turn;
            turn = (turn + 1) % robots.size();
            cycle(robot).ifPresent(next -> change(next, robot));
            robots.forEach(PlayerRobot::repeatCommand);
        }
    }

    private void runAllServices() {
        for (int robot = 0; robot < robots.size(); robot++) {
            if (cycles.get(robot).isDue()) {
                var next = cycle(robot);
                if (next.isPresent()) {
                    change(next.get(), robot);
                    cycles.forEach(cycle -> cycle.run(ServiceCycle.Finder.NONE));
                    return;
                }
            }
        }
    }

    /** Runs the cycle of a robot; returns the next state if the robot sees a colour that leads to one. */
    private Optional<State> cycle(int robot) {
        var service = cycles.get(robot).service();
        var rule = service.findsColours() ? settings.robots().table().ruleIn(state) : ColourRule.NONE;
        cycles.get(robot).run((devices, secondsInCharge) -> {
            seen = rule.pick(devices.blobs(), secondsInCharge);
            return true; // also when the state ends
        });
        return seen.isEmpty() ? Optional.empty() : settings.robots().table().next(state, seen.getAsInt());
    }

    private void change(State next, int seenBy) {
        notifyServicesEnded();
        state = next;
        turn = 0;
        startServices(seenBy);
    }

    private void startServices(@Nullable Integer seenBy) {
        settings.listener().stateStarted(state, seenBy);
        for (int robot = 0; robot < robots.size(); robot++) {
            Service service = state.services().get(robot);
            var cycle = new ServiceCycle(
                    service,
                    robots.get(robot),
                    robots.get(robot)::drive,
                    settings.robots().observer());
            if (robots.get(robot).hasData()) {
                cycle.start();
            }
            cycles.add(cycle);
            settings.robots().observer().serviceStarted(robot, service);
        }
    }

    private void notifyServicesEnded() {
        while (ended < cycles.size()) { // after an observer that fails, each of the others is notified once
            int robot = ended++;
            settings.robots().observer().serviceEnded(robot, cycles.get(robot).service());
        }
        cycles.clear();
        ended = 0;
    }

    private void halt() {
        Thread.interrupted(); // clear the interrupt that close() used to wake this thread
        try {
            cycles.forEach(ServiceCycle::halt);
        } catch (RuntimeException unreachable) {
            report(unreachable);
        } finally {
            notifyServicesEnded();
        }
    }
}
