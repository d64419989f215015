package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.ProcessComponent.TextLine;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ForkJoinPool;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Uses real processes, and so real threads and real time. Every wait is ended by an event of the process. */
@Timeout(120)
class ExternalProcessTest {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Duration SHORT = Duration.ofMillis(200);
    private static final Path SHELL = Path.of("/bin/sh");

    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("processes"));
    private final Bus bus = Bus.inProcess("here", BusSettings.on(space));
    private final BusPort user = bus.attach("user");
    private final RecordingObserver notes = new RecordingObserver();
    private final LinkedBlockingQueue<String> lines = new LinkedBlockingQueue<>();

    @TempDir
    private Path directory;

    @BeforeEach
    void aShellIsThere() throws Exception {
        assumeTrue(Files.isExecutable(SHELL), "there is no " + SHELL + " on this machine");
        Files.createFile(directory.resolve("empty"));
    }

    @AfterEach
    void nothingIsLeft() {
        bus.close();
        space.close();
        var left = alive();
        left.forEach(ProcessHandle::destroyForcibly);
        assertThat(left).as("processes left").isEmpty();
    }

    /**
     * The processes of this test, found by its directory in their arguments. A process that has ended has no arguments,
     * whether reaped or not.
     */
    private List<ProcessHandle> alive() {
        return ProcessHandle.allProcesses()
                .filter(each -> each.info().commandLine().orElse("").contains(directory.toString()))
                .toList();
    }

    private boolean isAlive(String pid) {
        return alive().stream().anyMatch(each -> String.valueOf(each.pid()).equals(pid));
    }

    /** A process has no command line for a moment while it executes another program. */
    private void awaitAlive(String pid) throws InterruptedException {
        while (!isAlive(pid)) {
            Thread.sleep(1);
        }
    }

    private ComponentInterface<?, ?> open(Duration startLimit, Duration stopLimit, String... command) throws Exception {
        var component = ProcessComponent.of(
                "script",
                "scripting",
                new ProcessComponent.Settings(List.of(command), directory, startLimit, stopLimit));
        var opened = new CompletableFuture<ComponentInterface<?, ?>>();
        space.execute(() -> {
            user.subscribe(ProcessComponent.output("script"), (line, from) -> lines.add(line.text()));
            opened.complete(ComponentInterface.open(bus, "script", component, notes));
        });
        return opened.get(60, TimeUnit.SECONDS);
    }

    private ComponentInterface<?, ?> shell(Duration startLimit, Duration stopLimit, String script) throws Exception {
        return open(
                startLimit,
                stopLimit,
                SHELL.toString(),
                "-c",
                script.replace("SLEEP", "tail -f " + directory.resolve("empty")),
                directory.toString());
    }

    /** A script that ends on request. */
    private ComponentInterface<?, ?> shell(String script) throws Exception {
        return shell(PATIENCE, PATIENCE, script);
    }

    private static @Nullable Void done(Promise<@Nullable Void> promise) throws Exception {
        return promise.get(PATIENCE);
    }

    private String line() throws InterruptedException {
        return String.valueOf(lines.poll(60, TimeUnit.SECONDS));
    }

    @Test
    void process_runsFromItsFirstLine_andItsDataAreLines() throws Exception {
        var provider = shell("echo ready; while read line; do echo \"heard $line\"; done");
        done(provider.start());
        assertThat(line()).isEqualTo("ready");
        done(provider.check());
        user.publish(ProcessComponent.input("script"), new TextLine("one"));
        user.publish(ProcessComponent.input("script"), new TextLine("two"));
        assertThat(line()).isEqualTo("heard one");
        assertThat(line()).isEqualTo("heard two");
        done(provider.stop());
        assertThatThrownBy(() -> done(provider.check())).hasMessage("here/script has been terminated");
    }

    @Test
    void processThatEndsByItself_hasFailed_withItsStatusAndItsLastErrors() throws Exception {
        var provider = shell("echo ready; read line; echo 'out of wheels' >&2; exit 7");
        done(provider.start());
        assertThat(line()).isEqualTo("ready");
        user.publish(ProcessComponent.input("script"), new TextLine("go"));
        awaitNote("script has failed");
        assertThatThrownBy(() -> done(provider.check()))
                .isInstanceOf(ProviderException.class)
                .hasMessageContaining("ended with status 7; it said: out of wheels");
    }

    @Test
    void processThatEndsBeforeItsFirstLine_isNotStarted() throws Exception {
        var provider = shell("echo 'no such robot' >&2; exit 1");
        assertThatThrownBy(() -> done(provider.start()))
                .hasMessageStartingWith("here/script has failed: ")
                .hasMessageEndingWith("ended with status 1; it said: no such robot");
    }

    @Test
    void programThatDoesNotExist_isNamed() throws Exception {
        var provider = open(PATIENCE, PATIENCE, "no-such-program-anywhere");
        assertThatThrownBy(() -> done(provider.start()))
                .hasMessageContaining("\"no-such-program-anywhere\" cannot be started")
                .message()
                .doesNotEndWith(" ");
    }

    @Test
    void processThatSaysNothing_isGivenUp_whenItHasEnded() throws Exception {
        var provider = shell(SHORT, SHORT, "trap '' TERM; SLEEP; SLEEP");
        assertThatThrownBy(() -> done(provider.start()))
                .hasMessageContaining("has written no line in PT0.2S, expected one when it is ready");
        assertThat(alive()).as("processes beside what is started instead").isEmpty();
    }

    @Test
    void startLimitOfEver_isNoError() throws Exception {
        var provider =
                shell(Duration.ofSeconds(Long.MAX_VALUE), Duration.ofSeconds(Long.MAX_VALUE), "echo ready; SLEEP");
        done(provider.start());
        done(provider.stop());
    }

    /**
     * A shell may start a program just before it ends. That program is not in the tree when the first requests to end
     * are sent.
     */
    @Test
    void programThatIsStartedAmidTheTermination_isTerminatedToo() throws Exception {
        assumeSessions();
        var ever = Duration.ofSeconds(Long.MAX_VALUE);
        var provider = shell(ever, ever, "trap 'SLEEP & exit' TERM; echo ready; SLEEP & wait");
        done(provider.start());
        done(provider.stop());
        assertThat(alive()).isEmpty();
    }

    @Test
    void processThatIsDeafToTermination_isKilled() throws Exception {
        var provider = shell(PATIENCE, SHORT, "trap '' TERM; echo $$; while :; do SLEEP; done");
        for (int life = 0; life < 2; life++) {
            done(provider.start());
            var pid = line();
            awaitAlive(pid);
            done(provider.stop());
            assertThat(isAlive(pid)).as("process %s has ended", pid).isFalse();
        }
    }

    @Test
    void programThatAScriptHasStarted_endsWithIt() throws Exception {
        var provider = shell("SLEEP & echo $!; wait");
        done(provider.start());
        var started = line();
        awaitAlive(started);
        done(provider.stop());
        assertThat(isAlive(started)).isFalse();
    }

    @Test
    void programThatAScriptStartsAgainWhenItIsTerminated_endsWithIt() throws Exception {
        var provider = shell(PATIENCE, SHORT, "trap : TERM; while :; do SLEEP & echo $!; wait $!; done");
        done(provider.start());
        line();
        done(provider.stop());
        assertThat(alive()).isEmpty();
    }

    @Test
    void processThatEndsBeforeItsChild_hasFailed_whenTheChildHasEnded() throws Exception {
        assumeSessions();
        var provider = shell("SLEEP & echo $!; read line; exit 7");
        done(provider.start());
        var child = line();
        awaitAlive(child);
        var livesBesideTheNext = provider.whenEnded().handle((ended, error) -> isAlive(child));
        user.publish(ProcessComponent.input("script"), new TextLine("go"));
        assertThat(livesBesideTheNext.get(PATIENCE)).isFalse();
        assertThatThrownBy(() -> done(provider.check())).hasMessageContaining("ended with status 7");
        awaitNote("has ended with status 7, before processes that it had started; these are ended too: " + child);
    }

    @Test
    void healthOfAProcessThatHasEnded_isAnsweredWhenItsDeafChildHasEnded() throws Exception {
        assumeSessions();
        var provider = shell(PATIENCE, SHORT, "(trap '' TERM; exec SLEEP) & echo $!; read line; exit 7");
        done(provider.start());
        var child = line();
        awaitAlive(child);
        user.publish(ProcessComponent.input("script"), new TextLine("go"));
        while (provider.check().handle((well, error) -> error == null).get(PATIENCE)) {
            Thread.sleep(1);
        }
        assertThat(isAlive(child)).isFalse();
    }

    /** Without a session, a process whose parent has ended is not found. */
    private static void assumeSessions() {
        boolean found =
                Stream.of("/usr/bin/setsid", "/bin/setsid").map(Path::of).anyMatch(Files::isExecutable);
        assumeTrue(found && Files.isReadable(Path.of("/proc/self/stat")), "there is no setsid on this machine");
    }

    @Test
    void readersEnd_withTheChildThatHoldsTheirPipes() throws Exception {
        assumeSessions();
        var provider = shell("SLEEP & echo $!; read line; exit 7");
        done(provider.start());
        user.publish(ProcessComponent.input("script"), new TextLine("go"));
        awaitNote("script has failed");
        while (Thread.getAllStackTraces().keySet().stream()
                .map(Thread::getName)
                .anyMatch(name -> name.matches("std(out|err) of " + SHELL))) {
            Thread.sleep(1);
        }
        assertThatThrownBy(() -> done(provider.check())).hasMessageContaining("ended with status 7");
    }

    @Test
    void processThatStartsAnotherWhenItIsTerminated_endsWithIt_andTheCommonPoolIsFree() throws Exception {
        var provider = shell(PATIENCE, SHORT, "trap 'SLEEP & exit 0' TERM; SLEEP & echo ready; wait");
        for (int life = 0; life < 4; life++) {
            done(provider.start());
            done(provider.stop());
        }
        for (int task = 0; task < ForkJoinPool.getCommonPoolParallelism(); task++) {
            assertThat(ForkJoinPool.commonPool().submit(() -> "done").get(60, TimeUnit.SECONDS))
                    .isEqualTo("done");
        }
        assertThat(alive()).isEmpty();
    }

    @Test
    void lineThatDoesNotEnd_isCut_andThisIsReported() throws Exception {
        int longest = ExternalProcess.LONGEST_LINE_CHARACTERS;
        var provider = shell("echo ready; head -c " + longest + " /dev/zero | tr '\\0' x; echo;"
                + " head -c 1000000 /dev/zero | tr '\\0' y; echo; echo last; SLEEP");
        done(provider.start());
        assertThat(line()).isEqualTo("ready");
        assertThat(line()).isEqualTo("x".repeat(longest));
        assertThat(line()).isEqualTo("y".repeat(longest));
        assertThat(line()).isEqualTo("last");
        assertThat(notes.take())
                .filteredOn(note -> note.contains("a line of more than"))
                .hasSize(1)
                .first()
                .asString()
                .endsWith(" wrote a line of more than 65536 characters to its standard output; the rest of the line is"
                        + " lost");
        done(provider.stop());
    }

    @Test
    void linesThatAProcessDoesNotRead_areTold() throws Exception {
        var provider = shell("exec <&-; echo ready; exec SLEEP");
        done(provider.start());
        assertThat(line()).isEqualTo("ready");
        user.publish(ProcessComponent.input("script"), new TextLine("one"));
        awaitNote("reads its standard input no more");
        user.publish(ProcessComponent.input("script"), new TextLine("two"));
        awaitQuiet();
        done(provider.stop());
        awaitNote("1 lines for");
    }

    private void awaitNote(String text) throws InterruptedException {
        while (notes.take().stream().noneMatch(note -> note.contains(text))) {
            Thread.sleep(1);
        }
    }

    /** Waits until earlier published lines have reached the process. */
    private void awaitQuiet() throws Exception {
        for (int turn = 0; turn < 3; turn++) {
            var over = new CompletableFuture<Boolean>();
            space.execute(() -> over.complete(true));
            over.get(60, TimeUnit.SECONDS);
        }
    }
}
