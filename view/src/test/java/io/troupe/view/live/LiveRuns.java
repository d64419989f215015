package io.troupe.view.live;

import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.nio.file.Path;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** Runs of the main job for the tests of the live page, at separate ports. */
final class LiveRuns {
    static final Path WORLDS = Path.of("..", "demo", "worlds");
    static final Scenario ARENA = ScenarioReader.read(WORLDS.resolve("paper-arena.world"));
    static final SubsumptionTable TABLE = SubsumptionTable.ofThePaper();

    private static final AtomicInteger NEXT_PORT = new AtomicInteger(7_665);

    private LiveRuns() {}

    /** The same world, at a port that no other world in this JVM has: the tests in Chromium run beside the others. */
    static Scenario atOwnPort(Scenario scenario) {
        return scenario.withPort(NEXT_PORT.getAndIncrement());
    }

    /** Runs the main job. */
    static void run(Path log, double seconds, RecordedRun.Listener listener) throws Exception {
        run(log, RecordedRun.Settings.defaults().withSeconds(seconds), listener);
    }

    private static void run(Path log, RecordedRun.Settings settings, RecordedRun.Listener listener) throws Exception {
        try (var written = new RunLog(log)) {
            new RecordedRun(atOwnPort(ARENA), TABLE, settings).run(written, listener);
        }
    }

    /** The arena at the start. */
    static Snapshot start() {
        try (var simulation = Simulation.open(atOwnPort(ARENA), WorldSettings.defaults())) {
            return simulation.latest();
        }
    }

    /** A run on another thread, shown on a page, until it is closed. */
    static final class Endless implements AutoCloseable {
        final LiveView page;
        final RunControl control;
        private final CountDownLatch stop = new CountDownLatch(1);
        private final Future<?> running;

        Endless(Path log, int port, double speed) throws IOException {
            this(log, port, speed, Mode.PROMISE);
        }

        Endless(Path log, int port, double speed, Mode mode) throws IOException {
            page = LiveView.open(LiveView.Settings.defaults().withPort(port));
            control = new RunControl(speed, true);
            var viewed = new ViewedRun(ARENA.world(), TABLE, control).onto(page);
            var listener = viewed.listener(new RecordedRun.Listener() {
                @Override
                public boolean isStopRequested() {
                    return stop.getCount() == 0;
                }
            });
            var thread = Executors.newSingleThreadExecutor();
            running = thread.submit(() -> {
                run(log, RecordedRun.Settings.defaults().withSeconds(1e6).withMode(mode), listener);
                return null;
            });
            thread.shutdown();
        }

        @Override
        public void close() throws IOException {
            stop.countDown();
            try {
                running.get(5, TimeUnit.MINUTES);
            } catch (Exception e) {
                throw new IOException(e);
            } finally {
                page.close();
            }
        }
    }
}
