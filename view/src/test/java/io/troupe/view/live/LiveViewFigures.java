package io.troupe.view.live;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import java.lang.management.ManagementFactory;
import java.lang.management.ThreadInfo;
import java.lang.management.ThreadMXBean;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledIfSystemProperty;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/**
 * With {@code -Dfigures=true}: measures the live page for the table of the guide, and prints its rows. The processor
 * time is that of the threads of the page: the thread that shows frames, those of the server, and those that carry the
 * connections. Compiler, collector and test are not in it.
 */
@EnabledIfSystemProperty(named = "figures", matches = "true")
@Timeout(600)
class LiveViewFigures {
    private static final int WARM_UP_SECONDS = Integer.getInteger("figures.warmUp", 20);
    private static final int SECONDS = Integer.getInteger("figures.seconds", 60);
    private static final int FRAMES_PER_SECOND = 30;
    private static final int SNAPSHOTS = 300;
    private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();

    @ParameterizedTest
    @CsvSource({"2, 2", "60, 1", "1000, 0", "1000, 1"})
    void figures_ofThePage(int robots, int selected) throws Exception {
        assumeTrue(Browser.isInstalled(), "chromium and chromedriver are not installed");
        var scenario = CrowdWorld.scenario(robots, 8);
        List<Snapshot> snapshots = new ArrayList<>();
        try (var simulation = Simulation.open(scenario, WorldSettings.defaults())) {
            for (int i = 0; i < robots; i++) {
                simulation.world().command(i, 0.3, 0.2);
            }
            for (int i = 0; i < SNAPSHOTS; i++) {
                snapshots.add(simulation.tick());
            }
        }
        var frames = Executors.newSingleThreadScheduledExecutor(
                Thread.ofPlatform().name("frames").factory());
        try (var page = LiveView.open(LiveView.Settings.defaults().withPort(0));
                var browser = Browser.open()) {
            var shown = new Shown(new ViewedRun(scenario.world(), new RunControl(0, false)).onto(page), snapshots);
            frames.scheduleAtFixedRate(shown, 0, 1_000_000_000 / FRAMES_PER_SECOND, TimeUnit.NANOSECONDS);
            browser.size(1280, 800);
            browser.open(page.address());
            browser.await("troupe.model.frame !== null && troupe.source.viewer !== undefined");
            for (int i = 0; i < selected; i++) {
                browser.get("troupe.select(" + i + ", true)");
            }
            TimeUnit.SECONDS.sleep(WARM_UP_SECONDS);
            measure(shown, browser, robots, selected);
        } finally {
            frames.shutdownNow();
        }
    }

    /** Shows snapshots again and again, with a time that goes on; notes when. */
    private static final class Shown implements Runnable {
        private final ViewedRun viewed;
        private final List<Snapshot> snapshots;
        final long[] millis = new long[(WARM_UP_SECONDS + SECONDS + 300) * FRAMES_PER_SECOND];
        private int next;

        Shown(ViewedRun viewed, List<Snapshot> snapshots) {
            this.viewed = viewed;
            this.snapshots = snapshots;
        }

        @Override
        public void run() {
            Snapshot of = snapshots.get(next % SNAPSHOTS);
            millis[next] = System.currentTimeMillis();
            viewed.moved(new Snapshot(next, next * 100_000L, of.robots(), of.contacts()));
            next++;
        }
    }

    /** Processor time of the threads of the page so far, by the id of the thread. */
    private static Map<Long, Long> pageNanos() {
        Map<Long, Long> nanos = new HashMap<>();
        for (ThreadInfo thread : THREADS.getThreadInfo(THREADS.getAllThreadIds())) {
            if (thread != null
                    && thread.getThreadName()
                            .matches("frames|live page.*|HTTP-Dispatcher|ForkJoinPool.*|.*[uU]nparker.*"
                                    + "|.*[pP]oller.*")) {
                nanos.put(thread.getThreadId(), THREADS.getThreadCpuTime(thread.getThreadId()));
            }
        }
        return nanos;
    }

    private static void measure(Shown shown, Browser browser, int robots, int selected) throws Exception {
        browser.get("(window.seen = [], window.millis = [], window.real = troupe.view.draw.bind(troupe.view),"
                + " troupe.view.draw = (...all) => { real(...all); millis.push(troupe.view.drawMillis);"
                + " const n = troupe.model.frame.number; if (seen.at(-1)?.[0] !== n)"
                + " seen.push([n, performance.timeOrigin + performance.now()]); })");
        double bytes = browser.number("troupe.source.bytes");
        Map<Long, Long> before = pageNanos();
        long begin = System.nanoTime();
        TimeUnit.SECONDS.sleep(SECONDS);
        double seconds = (System.nanoTime() - begin) / 1e9;
        long used = pageNanos().entrySet().stream()
                .mapToLong(each -> each.getValue() - before.getOrDefault(each.getKey(), 0L))
                .sum();
        double kibibytes = (browser.number("troupe.source.bytes") - bytes) / 1024;
        double[] latencies = Arrays.stream(browser.get("seen.map(each => each.join(' ')).join('|')")
                        .split("\\|"))
                .map(each -> each.split(" "))
                .mapToDouble(each -> Double.parseDouble(each[1]) - shown.millis[Integer.parseInt(each[0])])
                .sorted()
                .toArray();
        double drawn = browser.number("millis.toSorted((a, b) => a - b)[millis.length >> 1]");
        System.out.println(String.format(
                Locale.ROOT,
                "| %d, %d selected | %.0f | %.0f | %.1f | %.0f, %.0f | %.1f %% | load %.1f",
                robots,
                selected,
                latencies.length / seconds,
                kibibytes / seconds,
                drawn,
                latencies[latencies.length / 2],
                latencies[(int) (latencies.length * 0.99)],
                used / 1e7 / seconds,
                ManagementFactory.getOperatingSystemMXBean().getSystemLoadAverage()));
    }
}
