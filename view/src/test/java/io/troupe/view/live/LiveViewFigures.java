package io.troupe.view.live;

import static org.junit.jupiter.api.Assumptions.assumeTrue;

import com.sun.management.OperatingSystemMXBean;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import java.lang.management.ManagementFactory;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledIfSystemProperty;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** With {@code -Dfigures=true}: measures the live page for the table of the guide, and prints its rows. */
@EnabledIfSystemProperty(named = "figures", matches = "true")
@Timeout(300)
class LiveViewFigures {
    private static final int SECONDS = 12;
    private static final int FRAMES_PER_SECOND = 30;

    @ParameterizedTest
    @CsvSource({"2, 2", "60, 1", "1000, 0", "1000, 1"})
    void figures_ofThePage(int robots, int selected) throws Exception {
        assumeTrue(Browser.isInstalled(), "chromium and chromedriver are not installed");
        var scenario = CrowdWorld.scenario(robots, 8);
        List<Snapshot> snapshots = new ArrayList<>();
        try (var simulation = Simulation.open(scenario, WorldSettings.DEFAULT)) {
            for (int i = 0; i < robots; i++) {
                simulation.world().command(i, 0.3, 0.2);
            }
            for (int i = 0; i < SECONDS * FRAMES_PER_SECOND * 2; i++) {
                snapshots.add(simulation.tick());
            }
        }
        try (var page = LiveView.open(LiveView.Settings.DEFAULT.withPort(0));
                var browser = Browser.open()) {
            var viewed = new ViewedRun(scenario.world(), new RunControl(0, false)).onto(page);
            viewed.moved(snapshots.getFirst());
            browser.size(1280, 800);
            browser.open(page.address());
            browser.await("troupe.model.frame !== null && troupe.source.viewer !== undefined");
            for (int i = 0; i < selected; i++) {
                browser.get("troupe.select(" + i + ", true)");
            }
            measure(snapshots, viewed, browser, robots, selected);
        }
    }

    private static void measure(List<Snapshot> snapshots, ViewedRun viewed, Browser browser, int robots, int selected)
            throws Exception {
        browser.get("(window.seen = [], window.millis = [], window.real = troupe.view.draw.bind(troupe.view),"
                + " troupe.view.draw = (...all) => { real(...all); millis.push(troupe.view.drawMillis);"
                + " const n = troupe.model.frame.number; if (seen.at(-1)?.[0] !== n)"
                + " seen.push([n, performance.timeOrigin + performance.now()]); })");
        var process = ManagementFactory.getPlatformMXBean(OperatingSystemMXBean.class);
        double[] shownMillis = new double[snapshots.size() + 1];
        var next = new AtomicInteger(1);
        var thread = Executors.newSingleThreadScheduledExecutor();
        double bytes = browser.number("troupe.source.bytes");
        long processor = process.getProcessCpuTime();
        long begin = System.nanoTime();
        thread.scheduleAtFixedRate(
                () -> {
                    int number = next.getAndIncrement();
                    shownMillis[number] = System.currentTimeMillis();
                    viewed.moved(snapshots.get(number));
                },
                0,
                1_000_000_000 / FRAMES_PER_SECOND,
                TimeUnit.NANOSECONDS);
        browser.await("seen.length && seen.at(-1)[0] >= " + SECONDS * FRAMES_PER_SECOND);
        double seconds = (System.nanoTime() - begin) / 1e9;
        long used = process.getProcessCpuTime() - processor;
        double kibibytes = (browser.number("troupe.source.bytes") - bytes) / 1024;
        thread.shutdownNow();
        double[] latencies = Arrays.stream(browser.get("seen.map(each => each.join(' ')).join('|')")
                        .split("\\|"))
                .map(each -> each.split(" "))
                .filter(each -> shownMillis[Integer.parseInt(each[0])] > 0)
                .mapToDouble(each -> Double.parseDouble(each[1]) - shownMillis[Integer.parseInt(each[0])])
                .sorted()
                .toArray();
        double drawn = browser.number("millis.toSorted((a, b) => a - b)[millis.length >> 1]");
        System.out.println(String.format(
                Locale.ROOT,
                "| %d, %d selected | %.1f | %.0f | %.1f | %.0f / %.0f | %.1f %% |",
                robots,
                selected,
                latencies.length / seconds,
                kibibytes / seconds,
                drawn,
                latencies[latencies.length / 2],
                latencies[(int) (latencies.length * 0.99)],
                used / 1e7 / seconds));
    }
}
