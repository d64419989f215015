package io.troupe.faults;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.faults.history.Event.Called;
import io.troupe.faults.history.Event.Commanded;
import io.troupe.faults.history.Event.Delivered;
import io.troupe.faults.history.Event.DriverFaultBegan;
import io.troupe.faults.history.Event.FaultBegan;
import io.troupe.faults.history.Event.Rolled;
import io.troupe.faults.history.Event.StreamEnded;
import io.troupe.faults.history.History;
import io.troupe.faults.history.HistoryChecker;
import io.troupe.faults.history.Violation;
import io.troupe.faults.history.Violation.Rule;
import io.troupe.faults.hosts.Hosts;
import io.troupe.tools.NatsServerProcess;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.nio.file.Path;
import java.util.EnumSet;
import java.util.List;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** The short mode of the fault suite: the faults are random, the rules are not. */
@Tag("threads")
class FaultsTest {
    private static final int FAULTS = Thorough.times(5, 12);
    private static final int DRIVER_FAULTS = Thorough.times(1, 2);

    /** Their limits of time are for a machine that has nothing else to do; the command checks these, too. */
    private static final Set<Rule> OF_TIME = EnumSet.of(
            Rule.SETTLED_IN_TIME,
            Rule.NOT_LATE,
            Rule.FRESH,
            Rule.STOPPED,
            Rule.STANDS,
            Rule.DRIVEN_AGAIN,
            Rule.CLEAR_END);

    private final long seed = System.nanoTime() % 1_000_000;

    @TempDir
    Path folder;

    @Test
    @Timeout(value = 5, unit = TimeUnit.MINUTES)
    void applicationOverHosts_keepsItsPromises_whateverBreaks() throws Exception {
        History history = run(FAULTS, hosts -> new BusFaultRun(hosts, folder, seed, fault -> {}));
        assertThat(count(history, FaultBegan.class)).isEqualTo(FAULTS);
        assertThat(count(history, Called.class)).isPositive();
        assertThat(count(history, Delivered.class)).isPositive();
        assertThat(count(history, StreamEnded.class)).isPositive();
        assertThat(HistoryChecker.commands(history)).as("commands of robots").isPositive();
        var report = new FaultReport.OfBus();
        report.add(seed, history, HistoryChecker.check(history));
        assertThat(report.toString()).contains("fault", "all  ", "seeds " + seed);
        assertThat(report.json()).startsWith("{\"faults\": {\"").contains("\"violations\": ");
    }

    @Test
    @Timeout(value = 5, unit = TimeUnit.MINUTES)
    void robots_areDrivenAgain_byOneDriver_whateverBreaks() throws Exception {
        History history = run(DRIVER_FAULTS, hosts -> new DriverFaultRun(hosts, folder, seed, fault -> {}));
        assertThat(count(history, DriverFaultBegan.class)).isEqualTo(DRIVER_FAULTS);
        assertThat(count(history, Commanded.class)).isPositive();
        assertThat(count(history, Rolled.class)).isPositive();
        var report = new FaultReport.OfDrivers();
        report.add(seed, history, HistoryChecker.check(history));
        assertThat(report.toString()).contains("next driver", "all  ", "seeds " + seed);
        assertThat(report.json()).startsWith("{\"driverFaults\": {\"").contains("\"violations\": ");
    }

    private interface Opener {
        FaultRun open(Hosts hosts) throws IOException;
    }

    /** Does one run, in which no rule may be broken. */
    private History run(int faults, Opener opener) throws IOException, InterruptedException {
        assumeTrue(
                NatsServerProcess.isInstalled(),
                "nats-server is not installed (Debian: apt-get install nats-server): no faults are tested");
        History history;
        try (Hosts hosts = Hosts.open(Hosts.Kind.AUTO);
                FaultRun run = opener.open(hosts)) {
            history = run.run(faults);
        }
        assertThat(brokenRules(history)).as("seed %d", seed).isEmpty();
        return history;
    }

    private static List<Violation> brokenRules(History history) {
        return HistoryChecker.check(history).stream()
                .filter(violation -> !OF_TIME.contains(violation.rule()))
                .toList();
    }

    private static long count(History history, Class<?> type) {
        return history.entries().stream()
                .filter(entry -> type.isInstance(entry.event()))
                .count();
    }
}
