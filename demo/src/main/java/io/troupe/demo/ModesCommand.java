package io.troupe.demo;

import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.model.Scenario;
import io.troupe.view.ModeComparison;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunResult;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.EnumMap;
import java.util.Map;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe modes}: runs the same robots in the same world in synchronous, callback and promise mode. */
@Command(
        name = "modes",
        description =
                "Runs the paper's three modes from the same seed and shows their states side by side, where they differ, and why.",
        footer = {"  troupe modes", "  troupe modes --seed 7", "  troupe modes --world office.world --seconds 60"},
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class ModesCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private Path world = Installation.world("paper-arena.world");

    @Mixin
    private WorldLoader loader;

    @Option(names = "--seconds", paramLabel = "N", description = "simulated time to run in each mode")
    private double seconds = 300;

    @Option(names = "--seed", paramLabel = "N", description = "moves the start poses, as in run")
    private long seed = 1;

    @Option(names = "--out", paramLabel = "DIR", description = "where modes.svg and run-MODE.jsonl go")
    private Path out = Path.of("out");

    @Override
    public Integer call() throws IOException, InterruptedException {
        if (!(seconds > 0) || seconds > 1e6) {
            throw new ParameterException(
                    spec.commandLine(), "--seconds is " + seconds + ", expected a number above 0 and up to 1000000");
        }
        Scenario scenario = loader.read(world);
        recorded(scenario, Mode.PROMISE); // refuses a world that does not fit
        OutputDirectory.make(spec, out);
        try (var interruption = Interruption.open()) {
            var results = new EnumMap<Mode, RunResult>(Mode.class);
            for (Mode mode : Mode.values()) {
                if (!interruption.isRequested()) {
                    results.put(mode, run(scenario, mode, interruption));
                }
            }
            return interruption.isRequested() ? interrupted(results) : compare(scenario, results);
        }
    }

    /** Prints the states up to the interruption. Incomplete runs are not compared. */
    private int interrupted(Map<Mode, RunResult> results) {
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(new ModeComparison(results).table());
        String files = results.entrySet().stream()
                .map(each ->
                        "run-" + each.getKey() + ".jsonl has " + each.getValue().duration() + " s")
                .collect(Collectors.joining(", "));
        terminal.println("interrupted: there is no comparison and no new modes.svg"
                + (files.isEmpty() ? "" : ". " + files + "; the last line of one that was cut short has that"));
        terminal.flush();
        return Interruption.STATUS;
    }

    private int compare(Scenario scenario, Map<Mode, RunResult> results) throws IOException {
        var comparison = new ModeComparison(results);
        String title = comparison.finding() + " (" + scenario.world().name() + ", seed " + seed + ")";
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.print(comparison.text());
        terminal.flush(); // before writing files, which may fail
        OutputFiles.write(out.resolve("modes.svg"), Pictures.modes(comparison, title));
        terminal.println("wrote " + out.resolve("modes.svg") + " and, beside it, run-sync.jsonl, run-callback.jsonl and"
                + " run-promise.jsonl");
        terminal.flush();
        return 0;
    }

    private RecordedRun recorded(Scenario scenario, Mode mode) {
        var settings =
                RecordedRun.Settings.defaults().withMode(mode).withSeed(seed).withSeconds(seconds);
        return new RecordedRun(scenario, SubsumptionTable.ofThePaper(), settings);
    }

    private RunResult run(Scenario scenario, Mode mode, Interruption interruption)
            throws IOException, InterruptedException {
        try (var progress = ProgressBar.onTerminal(mode + " mode ", seconds);
                var log = new RunLog(out.resolve("run-" + mode + ".jsonl"))) {
            return recorded(scenario, mode).run(log, progress.listener(change -> {}, interruption));
        }
    }
}
