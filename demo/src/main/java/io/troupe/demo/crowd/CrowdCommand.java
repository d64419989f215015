package io.troupe.demo.crowd;

import io.troupe.common.text.Plural;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.tools.ProgressLine;
import io.troupe.view.live.LiveView;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code troupe crowd}: measures the cost of a robot for crowds of several sizes. */
@Command(
        name = "crowd",
        description =
                "Measures crowds of robots on one actor space: simulated world, Player connections, arbitrator and services, in lock step.",
        footer = {
            "  troupe crowd",
            "  troupe crowd --sizes 2,50,1000",
            "  troupe crowd --sizes 200 --view",
            "",
            "Processor time is that of all threads, the compiler's and the collector's included; world is that of the thread that moves the world, services that of",
            "the actor space's thread. The two take turns, so one core is all they need; to have no more than one: taskset -c 0 ./troupe crowd"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class CrowdCommand implements Callable<Integer> {
    private static final int MOST_SECONDS = 100_000;
    private static final int MOST_REPEATS = 1000;

    @Spec
    private CommandSpec spec;

    @Option(names = "--sizes", paramLabel = "N", split = ",", description = "numbers of robots")
    private List<Integer> sizes = List.of(1, 3, 10, 30, 100, 300, 1000);

    @Option(names = "--seconds", paramLabel = "N", description = "simulated time to measure for each size")
    private double seconds = 10;

    @Option(names = "--repeat", paramLabel = "N", description = "rounds; the table has their medians")
    private int repeat = 3;

    @Option(names = "--colours", paramLabel = "C", description = "panels in each hall, and states")
    private int colours = 8;

    @Option(names = "--services", paramLabel = "S", description = "different services")
    private int services = 3;

    @Option(names = "--seed", paramLabel = "N", description = "of the world")
    private long seed = 1;

    @Option(names = "--out", paramLabel = "DIR", description = "where crowd.csv, crowd.svg and crowd.png go")
    private Path out = Path.of("out");

    @Mixin
    private ViewOptions view;

    @Override
    public Integer call() throws IOException, InterruptedException {
        check();
        OutputDirectory.make(spec, out);
        PrintWriter terminal = spec.commandLine().getOut();
        int cores = Runtime.getRuntime().availableProcessors();
        terminal.println("crowds of " + Plural.of(colours, "colour") + " and " + Plural.of(services, "service") + " on "
                + Plural.of(cores, "core") + (cores == 1 ? "" : ", of which two take turns"));
        terminal.flush();
        List<CrowdTrial.Result> trials = new ArrayList<>();
        try (var interruption = Interruption.open();
                var page = view.open()) {
            try {
                measure(trials, page, interruption);
            } catch (InterruptedCommand interrupted) {
                terminal.println("interrupted: " + Plural.of(trials.size(), "measurement") + " of "
                        + repeat * sizes.size() + (trials.isEmpty() ? "; no files were written" : ""));
                terminal.flush();
            }
            if (!trials.isEmpty()) {
                report(new CrowdReport(trials), terminal);
            }
            return interruption.isRequested() ? Interruption.STATUS : 0;
        }
    }

    private void report(CrowdReport report, PrintWriter terminal) throws IOException {
        terminal.print(report.table());
        terminal.flush(); // before writing files, which may fail
        OutputFiles.write(out.resolve("crowd.csv"), report.csv());
        new CrowdFigure(report.medians(), colours, services).write(out);
        terminal.println("wrote " + out.resolve("crowd.csv") + ", crowd.svg and crowd.png");
        terminal.flush();
    }

    private void check() {
        for (int size : sizes) {
            OptionRange.check(spec, "--sizes", size, 1, CrowdWorld.MOST_ROBOTS);
        }
        OptionRange.check(spec, "--repeat", repeat, 1, MOST_REPEATS);
        OptionRange.check(spec, "--colours", colours, 1, CrowdWorld.MOST_COLOURS);
        OptionRange.check(spec, "--services", services, 1, CrowdTable.MOST_SERVICES);
        OptionRange.checkSeconds(spec, seconds, MOST_SECONDS);
    }

    /**
     * Measures all sizes in each round, so that changes in the machine's speed affect all of them. The first round is a
     * warm-up and is not counted.
     */
    private void measure(List<CrowdTrial.Result> trials, @Nullable LiveView page, Interruption interruption)
            throws InterruptedException {
        try (var line = ProgressLine.open()) {
            for (int round = 0; round <= repeat; round++) {
                for (int robots : sizes) {
                    String what = Plural.of(robots, "robot") + ", "
                            + (round == 0 ? "warming up" : "round " + round + " of " + repeat);
                    var trial = new CrowdTrial(
                                    new CrowdTrial.Settings(
                                            robots,
                                            colours,
                                            services,
                                            round == 0 ? Math.min(seconds, 2) : seconds,
                                            seed),
                                    page)
                            .run(done -> {
                                interruption.check();
                                line.show(what, ProgressLine.bar(Math.min(1, done)) + " " + what);
                            });
                    if (round > 0) {
                        trials.add(trial);
                    }
                }
            }
        }
    }
}
