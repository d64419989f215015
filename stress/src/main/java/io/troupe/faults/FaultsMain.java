package io.troupe.faults;

import io.troupe.faults.history.History;
import io.troupe.faults.history.HistoryChecker;
import io.troupe.faults.history.Violation;
import io.troupe.faults.hosts.Hosts;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

/** The command line of the fault suite. Its exit status is 0; 1 if a rule was broken; or 2 for invalid arguments. */
@Command(
        name = "faults",
        description = "Breaks the hosts, links and processes of a bus at random, and checks what has happened.",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class FaultsMain implements Callable<Integer> {
    private static final int VIOLATIONS_PRINTED = 20;

    @Option(names = "--faults", paramLabel = "N", description = "how many")
    private int faults = 20;

    @Option(names = "--faults-per-run", paramLabel = "N", description = "after so many, all begins again and is checked")
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
        long first = seed == null ? System.nanoTime() % 1_000_000 : seed;
        Path folder = Files.createTempDirectory("troupe-faults-");
        int bad = 0;
        try (Hosts hosts = Hosts.open(kind)) {
            System.out.println("hosts: " + hosts);
            for (int done = 0; done < faults; done += faultsPerRun) {
                long its = first + done / faultsPerRun;
                System.out.println("seed " + its + ", histories in " + folder.resolve("" + its));
                History history;
                try (var run = new FaultRun(hosts, folder.resolve("" + its), its, System.out::println)) {
                    history = run.run(Math.min(faultsPerRun, faults - done));
                }
                List<Violation> violations = HistoryChecker.check(history);
                System.out.println(history.entries().size() + " lines, " + violations.size() + " violations");
                violations.stream().limit(VIOLATIONS_PRINTED).forEach(System.out::println);
                bad += violations.size();
            }
        }
        return bad == 0 ? 0 : 1;
    }
}
