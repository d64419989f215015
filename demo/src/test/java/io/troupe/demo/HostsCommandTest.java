package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.DisabledOnOs;
import org.junit.jupiter.api.condition.OS;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;
import picocli.CommandLine;
import picocli.CommandLine.ParameterException;

/** {@code troupe hosts}, as processes: it shows a failover, and leaves no process behind. */
@Timeout(300)
@DisabledOnOs(OS.WINDOWS)
@Execution(ExecutionMode.CONCURRENT)
class HostsCommandTest extends CommandLineBench {
    private static final Path CONFIGURATION = Path.of("..", "docs", "hosts", "nats.conf");
    private static final Pattern ADDRESS = Pattern.compile("watch it at (http://\\S+)");
    /** Nodes of the graph. */
    private static final String[] WANTED = {
        "\"space\":\"bus\",\"name\":\"host-a\"",
        "\"space\":\"bus\",\"name\":\"arbitrator\"",
        "\"space\":\"arbitrator\",\"name\":\"Arbitrator\",\"turns\":"
    };

    private static final Pattern PROCESS = Pattern.compile(", process (\\d+)");

    private static void assumeInstalled() {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
    }

    /** The installation with the configuration of the server. */
    private static String home() {
        Path root = CONFIGURATION
                .toAbsolutePath()
                .normalize()
                .getParent()
                .getParent()
                .getParent();
        return "-Dtroupe.home=" + root;
    }

    private ProcessBuilder hosts(String options) {
        return jvm(home(), Main.class, words("hosts " + ARENA + "--out DIR " + options))
                .redirectErrorStream(true);
    }

    /** What a run has printed, and its exit status. */
    private record Outcome(int status, List<String> lines) {
        String text() {
            return String.join("\n", lines);
        }
    }

    /** Runs to the end; {@code onLine} may end the process. */
    private static Outcome run(Process process, Consumer<String> onLine) throws IOException, InterruptedException {
        List<String> lines = new ArrayList<>();
        try (var output = process.inputReader()) {
            for (String line = output.readLine(); line != null; line = output.readLine()) {
                lines.add(line);
                onLine.accept(line);
            }
            return new Outcome(process.waitFor(), lines);
        } finally {
            process.destroyForcibly();
        }
    }

    private static void assertNoProcessIsLeft(Outcome outcome) throws Exception {
        List<Long> children = outcome.lines().stream()
                .flatMap(line -> PROCESS.matcher(line).results())
                .map(match -> Long.parseLong(match.group(1)))
                .toList();
        assertThat(children).as(outcome.text()).hasSize(4);
        for (long child : children) {
            var handle = ProcessHandle.of(child);
            if (handle.isPresent()) { // if it has been killed, it may take a moment
                handle.get().onExit().get(60, TimeUnit.SECONDS);
            }
        }
    }

    @Test
    void providerThatIsKilled_isReplaced_andDrawn() throws Exception {
        assumeInstalled();
        Outcome outcome = run(hosts("--seconds 20").start(), line -> {});
        assertNoProcessIsLeft(outcome);
        assertThat(outcome.lines())
                .anyMatch(line -> line.matches(" +1\\d\\.\\d s  host-[abc] is killed \\(SIGKILL\\)"));
        if (outcome.status() == Main.MISSING_SERVICE) { // on a busy machine: a clear end instead of another driver
            assertThat(outcome.lines().getLast()).startsWith("troupe: ");
            return;
        }
        assertThat(outcome.status()).as(outcome.text()).isZero();
        assertThat(outcome.text()).contains("robot 1 is driven by host-a", "robot 2 is driven by host-b");
        assertThat(outcome.lines())
                .anyMatch(line -> line.matches(
                        "host-[abc] was killed at 1\\d\\.\\d s: robot 1 had no driver for .* s(, then host-[abc])?"));
        assertThat(written("drivers.svg")).contains("class=\"gap\"", ">robot 2</text>", ">node host-a</text>");
        assertThat(written("trajectory.svg")).startsWith("<svg ");
        assertThat(written("run.jsonl")).contains("\"type\":\"summary\"", "\"node\":\"host-b\"");
        assertWritten("host-a.log", "host-b.log", "host-c.log", "serve.log");
        assertThat(written("nats.conf"))
                .isEqualTo(Files.readString(CONFIGURATION).replace("port: 7422", "port: -1"));
    }

    /** Debian puts the server where the PATH of a plain user does not lead. */
    @Test
    void interruption_endsAllProcesses_ofAServerThatIsNotOnThePath_asSoonAsThePageHasShownAllActors() throws Exception {
        assumeInstalled();
        var reading = new CompletableFuture<String>();
        var builder = hosts("--seconds 3600 --fault none --view 0");
        if (Files.isExecutable(Path.of("/usr/sbin/nats-server"))) {
            builder.environment().put("PATH", directory.toString());
        }
        Process process = builder.start();
        Outcome outcome = run(process, line -> {
            Matcher address = ADDRESS.matcher(line);
            if (address.find()) {
                Thread.ofVirtual().start(() -> reading.complete(read(address.group(1), process)));
            }
        });
        assertNoProcessIsLeft(outcome);
        assertThat(reading.get(1, TimeUnit.MINUTES))
                .as(outcome.text())
                .contains(List.of(WANTED))
                .contains("\"space\":\"broker\"", "\"name\":\"robot1\"");
        assertThat(outcome.status()).as(outcome.text()).isEqualTo(128 + 15);
        assertThat(outcome.text()).contains("interrupted: this is what was done until then");
        assertWritten("drivers.svg", "run.jsonl");
    }

    /** Reads the stream of the page until it has all that is wanted, or ends, and ends the process. */
    private static String read(String address, Process process) {
        var text = new StringBuilder();
        try (var stream = URI.create(address + "stream").toURL().openStream()) {
            byte[] bytes = new byte[8192];
            for (int count = stream.read(bytes); count >= 0; count = stream.read(bytes)) {
                text.append(new String(bytes, 0, count, StandardCharsets.ISO_8859_1));
                if (Stream.of(WANTED).allMatch(text.toString()::contains)) {
                    break;
                }
            }
        } catch (IOException e) {
            text.append(e);
        } finally {
            process.toHandle().destroy(); // SIGTERM is handled as Ctrl-C is
        }
        return text.toString();
    }

    @Test
    void killedCommand_leavesNoJvmBehind() throws Exception {
        assumeInstalled();
        Process process = hosts("--seconds 3600 --fault none").start();
        Outcome outcome = run(process, line -> {
            if (line.contains("is driven by host-b")) {
                endServer(process);
                process.toHandle().destroyForcibly();
            }
        });
        assertNoProcessIsLeft(outcome);
    }

    /** The only child that is no JVM: it does not notice that its parent is killed. */
    private static void endServer(Process process) {
        process.children()
                .filter(child -> child.info().command().orElse("").endsWith("nats-server"))
                .forEach(ProcessHandle::destroyForcibly);
    }

    @Test
    void withoutServer_itTellsHowToGetOne_andWhereItWasLookedFor() {
        var command = new HostsCommand();
        new CommandLine(command).parseArgs("--world", "worlds/paper-arena.world"); // in the folder demo
        assertThatThrownBy(() -> command.call(false))
                .isInstanceOf(ParameterException.class)
                .hasMessageStartingWith("there is no nats-server in the PATH, /usr/local/sbin, /usr/sbin, ")
                .hasMessageEndingWith(": on Debian and Ubuntu apt-get install nats-server, elsewhere see"
                        + " https://nats.io/download");
    }

    @Test
    void wrongOptions_areRefused() {
        assertRefused("hosts --seconds 0", "--seconds is 0.0, expected a number above 0 and up to 3600");
        assertRefused("hosts --fault melt", "--fault is 'melt', expected one of: kill, freeze, none");
        assertRefused("hosts --world DIR/nowhere", "DIR/nowhere: no such file, expected a world file");
    }
}
