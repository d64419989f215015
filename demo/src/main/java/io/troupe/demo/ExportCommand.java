package io.troupe.demo;

import io.troupe.common.text.Plural;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Installation;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputDirectory;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.RunRecorder;
import io.troupe.view.tools.RunExport;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe export}: writes a run in formats that other tools read. */
@Command(
        name = "export",
        description = {
            "Writes a run for other tools: an MCAP file for Foxglove and Lichtblick, CSV tables for plots.",
            "RUN is a run.jsonl, or what serve --record has written. The sensor readings of a run.jsonl are computed from its poses and its world."
        },
        mixinStandardHelpOptions = true,
        footer = {
            "  troupe export out/run.jsonl --mcap out/run.mcap",
            "  troupe export out/run.jsonl --csv out/tables",
            "  troupe export office.txt --world office.cfg --mcap office.mcap"
        })
final class ExportCommand implements Callable<Integer> {
    private static final int COLOURS = 8;

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "RUN", description = "the run.jsonl or recording")
    private Path run;

    @Option(names = "--mcap", paramLabel = "FILE", description = "the MCAP file to write")
    private @Nullable Path mcap;

    @Option(
            names = "--sensors",
            paramLabel = "N",
            split = ",",
            description = "with --mcap: numbers of the robots whose sensor readings it has; of at most "
                    + (RunRecorder.MANY_ROBOTS - 1) + " robots all, of more none unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable List<Integer> sensors;

    @Option(
            names = "--csv",
            paramLabel = "DIR",
            description = "where poses.csv, ranges.csv, blobs.csv, states.csv, contacts.csv and log.csv go, and the"
                    + " tables of further devices if the world has such")
    private @Nullable Path csv;

    @Option(
            names = "--world",
            paramLabel = "FILE",
            description = "the world of the run, a .world or .cfg file; the paper's arena unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path world;

    @Option(names = "--crowd", paramLabel = "N", description = "instead of a file: the halls of a crowd of N robots")
    private @Nullable Integer crowd;

    @Option(
            names = "--colours",
            paramLabel = "C",
            description = "colours of the crowd of a run.jsonl, as in troupe run; " + COLOURS + " unless given")
    private @Nullable Integer colours;

    @Mixin
    private WorldLoader loader;

    @Override
    public Integer call() throws IOException {
        if (mcap == null && csv == null) {
            throw new ParameterException(
                    spec.commandLine(), "nothing to write, expected --mcap FILE or --csv DIR, or both");
        }
        run = FileProblems.input(spec, run, "a run.jsonl, or what serve --record has written");
        if (mcap != null) {
            FileProblems.checkOutput(spec, "--mcap", mcap);
            if (Files.exists(mcap) && Files.isSameFile(mcap, run)) {
                throw new ParameterException(
                        spec.commandLine(), "--mcap is " + mcap + ", which is the run, expected another file");
            }
        }
        if (sensors != null && mcap == null) {
            throw new ParameterException(spec.commandLine(), "--sensors is given without --mcap, expected both");
        }
        WorldSpec where = world();
        var export = new RunExport(run, where);
        if (csv != null) {
            OutputDirectory.make(spec, "--csv", csv);
        }
        RunExport.Report report = null;
        if (mcap != null) {
            report = sensors == null ? export.writeMcap(mcap) : export.writeMcap(mcap, indices(sensors, where));
            wrote(mcap + String.format(Locale.ROOT, " (%.1f MB)", Files.size(mcap) / 1e6), report);
            if (sensors == null && where.robots().size() >= RunRecorder.MANY_ROBOTS) {
                warn("an MCAP file of " + RunRecorder.MANY_ROBOTS
                        + " robots or more has no sensor readings, expected --sensors 1,2,.. or --csv for these");
            }
        }
        if (csv != null) {
            report = export.writeCsv(csv);
            wrote("the tables in " + csv, report);
        }
        if (report != null) {
            report.remarks().forEach(this::warn);
        }
        return 0;
    }

    private Set<Integer> indices(List<Integer> numbers, WorldSpec where) {
        Set<Integer> indices = new TreeSet<>();
        for (int number : numbers) {
            OptionRange.check(spec, "--sensors", number, 1, where.robots().size());
            indices.add(number - 1);
        }
        return indices;
    }

    private void wrote(String what, RunExport.Report report) {
        PrintWriter terminal = spec.commandLine().getOut();
        terminal.printf(
                Locale.ROOT,
                "wrote %s: %s, %.1f s%n",
                what,
                Plural.of(report.readings(), "reading"),
                report.endMicros() / 1e6);
        terminal.flush();
    }

    private void warn(String remark) {
        PrintWriter err = spec.commandLine().getErr();
        err.println("troupe: warning: " + remark);
        err.flush();
    }

    private WorldSpec world() throws IOException {
        if (crowd == null) {
            if (colours != null) {
                throw new ParameterException(
                        spec.commandLine(),
                        "--colours is " + colours + ", but there is no crowd: expected --crowd as well");
            }
            Path file = world == null ? Installation.world("paper-arena.world") : world;
            return loader.read(file).world();
        }
        if (world != null) {
            throw new ParameterException(spec.commandLine(), "--crowd and --world are both given, expected one");
        }
        OptionRange.check(spec, "--crowd", crowd, 1, CrowdWorld.MOST_ROBOTS);
        if (colours == null && RunExport.isRecording(run)) {
            return CrowdWorld.scenario(crowd).world(); // that of serve --crowd
        }
        int panels =
                OptionRange.check(spec, "--colours", colours == null ? COLOURS : colours, 1, CrowdWorld.MOST_COLOURS);
        return CrowdWorld.scenario(crowd, panels).world();
    }
}
