package io.troupe.view;

import io.troupe.actor.CallObserver;
import io.troupe.common.text.Plural;
import io.troupe.services.subsumption.DriverReport;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotNode;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import org.jspecify.annotations.Nullable;

/**
 * One run of the main job over hosts: the robots are at a Player server, their services at any number of providers, and
 * the arbitrator and the record are here.
 *
 * <p><b>Threads.</b> The calling thread reads the poses and writes the log; the arbitrator runs on another one.
 *
 * <p><b>Order.</b> In real time, so no run repeats another one. Events are recorded in the order in which they arrive.
 *
 * <p><b>Errors.</b> A service without a provider is a {@link io.troupe.broker.MissingServiceException}. Robots that
 * cannot be reached are a {@link io.troupe.player.PlayerException}.
 */
public final class RecordedHostedRun {
    /**
     * What to run.
     *
     * @param host where the robots are, with {@code port}
     * @param world for the walls of the picture, and the gaps
     * @param mode promise or callback
     * @param seconds of the robots' clock
     */
    public record Settings(String host, int port, WorldSpec world, SubsumptionTable table, Mode mode, double seconds) {
        public Settings {
            if (world.robots().size() != table.robots()) {
                throw new WorldFileException(world.file() + " has "
                        + Plural.of(world.robots().size(), "robot") + ", expected " + table.robots()
                        + " as the table of services has");
            }
        }

        long endMicros() {
            return StrictMath.round(seconds * 1e6);
        }
    }

    /** What a run reports while it runs, on the thread that called {@link RecordedHostedRun#run}. */
    public interface Listener extends RecordedRun.Listener {
        /** A robot has got or lost a driver; {@code line} describes it. */
        default void driverChanged(String line) {}
    }

    private final Settings settings;
    private volatile boolean stopped;
    private volatile @Nullable RemoteWorld reading;

    public RecordedHostedRun(Settings settings) {
        this.settings = settings;
    }

    /** Ends the run now, as if its time was over. Any thread may call it. */
    public void stop() {
        stopped = true;
        RemoteWorld world = reading;
        if (world != null) {
            world.stop();
        }
    }

    /** Runs until the end time, or until it is stopped. The caller closes the log. */
    public RunResult run(RobotNode node, RunLog log, Listener listener) throws InterruptedException {
        try (var world = new RemoteWorld(settings.host(), settings.port(), settings.world())) {
            reading = world;
            if (stopped) {
                world.stop();
            }
            log.begin(settings);
            var recorder = new RunRecorder(settings.world(), settings.table(), log, listener::stateStarted);
            var events = new Events(recorder, listener);
            try (var running = SubsumptionRun.overHosts(node, settings.mode(), settings.table(), events)) {
                return record(world, recorder, events, running, listener);
            } catch (RuntimeException | Error failure) {
                recorder.fail();
                throw failure;
            }
        }
    }

    private RunResult record(
            RemoteWorld world, RunRecorder recorder, Events events, SubsumptionRun running, Listener listener) {
        Snapshot snapshot = world.next();
        events.record();
        if (snapshot != null) {
            recorder.start(snapshot);
            listener.recorded(snapshot, recorder);
        }
        while (snapshot != null
                && snapshot.timeMicros() < settings.endMicros()
                && !stopped
                && !listener.isStopRequested()) {
            snapshot = world.next();
            running.check();
            events.record();
            if (snapshot != null) {
                recorder.record(snapshot);
                listener.recorded(snapshot, recorder);
                listener.ticked(snapshot.timeMicros());
            }
        }
        return recorder.finish(snapshot == null || snapshot.timeMicros() < settings.endMicros());
    }

    /** Keeps what happens on the arbitrator's thread until the thread that records gets to it. */
    private final class Events implements SubsumptionRun.HostsListener {
        private final RunRecorder recorder;
        private final Listener listener;
        private final Queue<Runnable> queue = new ConcurrentLinkedQueue<>();

        Events(RunRecorder recorder, Listener listener) {
            this.recorder = recorder;
            this.listener = listener;
        }

        @Override
        public @Nullable CallObserver callObserver() {
            return listener.callObserver();
        }

        void record() {
            for (Runnable event = queue.poll(); event != null; event = queue.poll()) {
                event.run();
            }
        }

        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            queue.add(() -> recorder.stateStarted(state, seenBy));
        }

        @Override
        public void colourReceived(int robot, int colour) {
            queue.add(() -> recorder.colourReceived(robot, colour));
        }

        @Override
        public void colourTooLate(int robot, int colour) {
            queue.add(() -> recorder.colourTooLate(robot, colour));
        }

        @Override
        public void reported(DriverReport report, String node) {
            queue.add(() -> recorder.driverReported(report, node, listener::driverChanged));
        }

        @Override
        public void driverLost(int robot, String service, Throwable why) {
            queue.add(() -> recorder.driverLost(robot, service, why, listener::driverChanged));
        }
    }
}
