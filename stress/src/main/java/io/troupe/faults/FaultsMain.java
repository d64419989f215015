package io.troupe.faults;

import io.troupe.faults.history.History;
import io.troupe.faults.history.HistoryChecker;
import io.troupe.faults.history.Violation;
import io.troupe.faults.history.Violation.Rule;
import io.troupe.faults.hosts.Hosts;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;
import java.util.function.Consumer;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** The command line of the fault suite. Its exit status is 0; 1 if a rule was broken; or 2 for invalid arguments. */
@Command(
        name = "faults",
        description = "Breaks the hosts, links and processes of a bus at random, and checks what has happened.",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class FaultsMain implements Callable<Integer> {
    private static final int PRINTED_PER_RULE = 5;

    /** What the hosts do while they are broken. */
    private enum Work {
        BUS,
        DRIVERS,
        BOTH
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--work",
            paramLabel = "WORK",
            description =
                    "${COMPLETION-CANDIDATES}: calls, topics and streams, or robot services; by default one run of"
                            + " the first kind, then one of the second, and so on")
    private Work work = Work.BOTH;

    @Option(names = "--faults", paramLabel = "N", description = "how many")
    private int faults = 20;

    @Option(
            names = "--faults-per-run",
            paramLabel = "N",
            description = "after so many, all begins again and is checked")
    private int faultsPerRun = 50;

    @Option(names = "--seed", paramLabel = "N", description = "of the faults; default: another one each time")
    private @Nullable Long seed;

    @Option(names = "--hosts", paramLabel = "KIND", description = "${COMPLETION-CANDIDATES}")
    private Hosts.Kind kind = Hosts.Kind.AUTO;

    @Option(names = "--json", paramLabel = "FILE", description = "writes the table of the report")
    private @Nullable Path json;

    private FaultsMain() {}

    public static void main(String[] arguments) {
        System.exit(new CommandLine(new FaultsMain())
                .setCaseInsensitiveEnumValuesAllowed(true)
                .execute(arguments));
    }

    @Override
    public Integer call() throws IOException, InterruptedException {
        if (faults < 1 || faultsPerRun < 1) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--faults is " + faults + " and --faults-per-run is " + faultsPerRun + ", expected at least 1");
        }
        if (!NatsServerProcess.isInstalled()) {
            System.out.println("faults: " + NatsServerProcess.HOW_TO_GET);
            return CommandLine.ExitCode.SOFTWARE;
        }
        long first = seed == null ? System.nanoTime() % 1_000_000 : seed;
        Path folder = Files.createTempDirectory("troupe-faults-");
        var report = new FaultReport.OfBus();
        var drivers = new FaultReport.OfDrivers();
        try (Hosts hosts = Hosts.open(kind);
                var line = ProgressLine.open()) {
            System.out.println("hosts: " + hosts);
            for (int done = 0; done < faults; done += faultsPerRun) {
                int number = done / faultsPerRun;
                long runSeed = first + number;
                if (work == Work.DRIVERS || work == Work.BOTH && number % 2 == 1) {
                    Opener opener = (histories, progress) -> new DriverFaultRun(hosts, histories, runSeed, progress);
                    run(opener, folder, runSeed, done, line, drivers);
                } else {
                    Opener opener = (histories, progress) -> new BusFaultRun(hosts, histories, runSeed, progress);
                    run(opener, folder, runSeed, done, line, report);
                }
            }
        }
        System.out.print((report.isEmpty() ? "" : report.toString()) + (drivers.isEmpty() ? "" : drivers));
        if (json != null) {
            Files.writeString(
                    json, (report.isEmpty() ? "" : report.json()) + (drivers.isEmpty() ? "" : drivers.json()));
        }
        return report.violations().isEmpty() && drivers.violations().isEmpty() ? 0 : 1;
    }

    /** Opens a run with a folder for its histories. */
    private interface Opener {
        FaultRun open(Path histories, Consumer<FaultRun.Progress> progress) throws IOException;
    }

    /** Does one run. Its histories are kept if they break a rule. */
    private void run(Opener opener, Path folder, long runSeed, int done, ProgressLine line, FaultReport<?> report)
            throws IOException, InterruptedException {
        Path histories = folder.resolve("" + runSeed);
        History history;
        try (var run =
                opener.open(histories, fault -> line.show((done + fault.number()) + " of " + faults, fault.text()))) {
            history = run.run(Math.min(faultsPerRun, faults - done));
        }
        List<Violation> violations = HistoryChecker.check(history);
        report.add(runSeed, history, violations);
        show(runSeed, history, violations, histories, line);
    }

    private static void show(
            long runSeed, History history, List<Violation> violations, Path histories, ProgressLine line)
            throws IOException {
        line.interrupt(() -> {
            System.out.println("seed " + runSeed + ": " + history.entries().size() + " lines, " + violations.size()
                    + " violations" + (violations.isEmpty() ? "" : ", histories in " + histories));
            Map<Rule, Integer> printed = new EnumMap<>(Rule.class);
            violations.stream()
                    .filter(each -> printed.merge(each.rule(), 1, Integer::sum) <= PRINTED_PER_RULE)
                    .forEach(System.out::println);
        });
        if (violations.isEmpty()) {
            remove(histories);
        }
    }

    private static void remove(Path folder) throws IOException {
        try (Stream<Path> files = Files.list(folder)) {
            for (Path file : files.toList()) {
                Files.delete(file);
            }
        }
        Files.delete(folder);
    }
}
