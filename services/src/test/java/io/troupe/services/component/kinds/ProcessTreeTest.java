package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.broker.ProviderException;
import io.troupe.services.component.ComponentCommunication;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.reflect.Proxy;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.Stream;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Uses real processes. Every wait is ended by an event of a process. */
@Timeout(120)
class ProcessTreeTest {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Duration SHORT = Duration.ofMillis(50);
    private static final Path SHELL = Path.of("/bin/sh");

    @TempDir
    private Path directory;

    /** Main program: starts a process, prints its number on the first line, and exits as Ctrl-C would. */
    static final class Machine {
        private Machine() {}

        public static void main(String[] arguments) throws Exception {
            var process = new ExternalProcess(shell(Path.of("."), PATIENCE, "echo ready; exec sleep 1000"));
            var started = process.invoke(new Silent() {
                @Override
                public void info(String what) {
                    System.out.println(what.split("[ :]+")[1]);
                }
            });
            started.get(PATIENCE);
            System.exit(0);
        }
    }

    private static class Silent implements ComponentCommunication.Signals<String> {
        @Override
        public void data(String line) {}

        @Override
        public void failed(Throwable why) {}

        @Override
        public void info(String what) {}
    }

    @BeforeEach
    void aShellIsThere() {
        assumeTrue(Files.isExecutable(SHELL), "there is no " + SHELL + " on this machine");
    }

    private static ProcessComponent.Settings shell(Path directory, Duration stopLimit, String script) {
        return new ProcessComponent.Settings(List.of(SHELL.toString(), "-c", script), directory, PATIENCE, stopLimit);
    }

    private static ProcessHandle firstLine(ProcessTree tree) throws Exception {
        var reader = tree.root().inputReader(StandardCharsets.UTF_8);
        return ProcessHandle.of(Long.parseLong(reader.readLine())).orElseThrow();
    }

    @Test
    void withoutSessions_descendantsEndWithTheProgram() throws Exception {
        var tree = ProcessTree.start(shell(directory, PATIENCE, "sleep 1000 & echo $!; wait"), null);
        try {
            var child = firstLine(tree);
            assertThat(tree.alive()).containsExactlyInAnyOrder(tree.root().toHandle(), child);
        } finally {
            assertThat(tree.end(PATIENCE, PATIENCE)).isEmpty();
        }
        assertThat(tree.root().isAlive()).isFalse();
        assertThat(tree.alive()).isEmpty();
    }

    @Test
    void session_hasTheProcessesWhoseParentsHaveEnded() throws Exception {
        assumeTrue(hasSessions(), "there is no setsid on this machine");
        var tree = ProcessTree.start(shell(directory, PATIENCE, "sh -c 'sleep 1000 & echo $!'; exec sleep 1000"));
        ProcessHandle orphan;
        try {
            orphan = firstLine(tree);
            while (orphan.parent().map(ProcessHandle::pid).orElse(0L)
                            == tree.root().pid()
                    || tree.alive().size() > 2) {
                Thread.sleep(1);
            }
            assertThat(tree.alive()).containsExactlyInAnyOrder(tree.root().toHandle(), orphan);
        } finally {
            assertThat(tree.end(PATIENCE, PATIENCE)).isEmpty();
        }
    }

    /** A zombie, which may never be reaped in a container without an init process. */
    @Test
    void zombie_isNotAlive() throws Exception {
        assumeTrue(hasSessions(), "there is no setsid on this machine");
        var tree = ProcessTree.start(shell(directory, PATIENCE, "sleep 1000 & echo $!; exec sleep 1000"));
        try {
            var child = firstLine(tree);
            while (!List.of(tree.root().info().arguments().orElse(new String[0]))
                    .equals(List.of("1000"))) {
                Thread.sleep(1); // until the shell has become sleep: a shell would reap the zombie
            }
            child.destroyForcibly();
            while (!Files.readString(Path.of("/proc/" + child.pid() + "/stat")).contains(") Z ")) {
                Thread.sleep(1);
            }
            assertThat(child.isAlive()).as("what the machine says").isTrue();
            assertThat(tree.alive()).containsExactly(tree.root().toHandle());
        } finally {
            assertThat(tree.end(PATIENCE, PATIENCE)).isEmpty();
        }
    }

    @Test
    void processThatCannotBeKilled_isReported_andTheNextTerminationTriesAgain() throws Exception {
        var kills = new AtomicInteger();
        var process = new ExternalProcess(
                shell(directory, SHORT, "echo ready; exec sleep 1000"),
                settings -> {
                    var tree = ProcessTree.start(settings, null);
                    tree.add(immortal(kills));
                    return tree;
                },
                SHORT,
                Duration.ZERO);
        process.invoke(new Silent()).get(PATIENCE);
        assertThatThrownBy(() -> process.terminate().get(PATIENCE))
                .isInstanceOf(ProviderException.class)
                .hasMessageEndingWith("was killed, and PT0.05S later some of its processes are still alive: "
                        + Long.MAX_VALUE + " (/bin/rock)");
        int before = kills.get();
        assertThat(before).isPositive();
        assertThatThrownBy(() -> process.terminate().get(PATIENCE)).hasMessageContaining("/bin/rock");
        assertThat(kills.get()).isGreaterThan(before);
    }

    private static ProcessHandle immortal(AtomicInteger kills) {
        var info = (ProcessHandle.Info) Proxy.newProxyInstance(
                ProcessTreeTest.class.getClassLoader(),
                new Class<?>[] {ProcessHandle.Info.class},
                (proxy, method, arguments) -> Optional.of("/bin/rock"));
        return (ProcessHandle) Proxy.newProxyInstance(
                ProcessTreeTest.class.getClassLoader(),
                new Class<?>[] {ProcessHandle.class},
                (proxy, method, arguments) -> switch (method.getName()) {
                    case "pid" -> Long.MAX_VALUE;
                    case "info" -> info;
                    case "descendants" -> Stream.empty();
                    case "hashCode" -> 0;
                    case "equals" -> proxy == arguments[0];
                    case "destroyForcibly" -> kills.incrementAndGet() > 0;
                    default -> true;
                });
    }

    private static void awaitWaiting(Thread thread) throws InterruptedException {
        while (thread.getState() != Thread.State.TIMED_WAITING && thread.isAlive()) {
            Thread.sleep(1);
        }
    }

    @Test
    void shutdownDuringAStart_endsTheProcess() throws Exception {
        var begun = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var tree = new AtomicReference<ProcessTree>();
        var process = new ExternalProcess(
                shell(directory, PATIENCE, "echo ready; exec sleep 1000"),
                settings -> {
                    begun.countDown();
                    try {
                        goOn.await();
                    } catch (InterruptedException e) {
                        throw new IOException(e);
                    }
                    tree.set(ProcessTree.start(settings));
                    return tree.get();
                },
                PATIENCE,
                Duration.ZERO);
        var start = Thread.ofPlatform().start(() -> process.invoke(new Silent()).handle((runs, error) -> null));
        begun.await();
        var hook = Thread.ofPlatform().start(process::endAtShutdown);
        awaitWaiting(hook);
        goOn.countDown();
        start.join();
        hook.join();
        try {
            assertThat(tree.get().root().isAlive()).isFalse();
        } finally {
            tree.get().end(PATIENCE, PATIENCE);
        }
    }

    @Test
    void shutdown_leavesTheStopToTheApplicationFirst() throws Exception {
        var tree = new AtomicReference<ProcessTree>();
        var process = new ExternalProcess(
                shell(directory, PATIENCE, "echo ready; exec sleep 1000"),
                settings -> {
                    tree.set(ProcessTree.start(settings));
                    return tree.get();
                },
                PATIENCE,
                PATIENCE);
        process.invoke(new Silent()).get(PATIENCE);
        var hook = Thread.ofPlatform().start(process::endAtShutdown);
        awaitWaiting(hook);
        try {
            assertThat(tree.get().root().isAlive()).isTrue();
        } finally {
            process.terminate().get(PATIENCE);
        }
        hook.join();
    }

    @Test
    void startThatThrows_leavesNoShutdownHook() {
        var process = new ExternalProcess(
                shell(directory, PATIENCE, "echo ready"),
                settings -> {
                    throw new IllegalArgumentException("a null character in the command");
                },
                PATIENCE,
                Duration.ZERO);
        assertThatThrownBy(() -> process.invoke(new Silent()).get(PATIENCE))
                .isInstanceOf(ProviderException.class)
                .hasMessageEndingWith("cannot be started: a null character in the command");
        assertThat(Runtime.getRuntime().removeShutdownHook(process.shutdownHook))
                .isFalse();
    }

    @Test
    void listenerThatThrowsAtTheEnd_leavesNoStartThatWaits() throws Exception {
        assumeTrue(hasSessions(), "there is no setsid on this machine");
        var process = new ExternalProcess(shell(directory, PATIENCE, "sleep 1000 & exit 7"));
        var started = process.invoke(new Silent() {
            @Override
            public void info(String what) {
                if (what.contains("has ended with status")) {
                    throw new IllegalStateException("no room for a message");
                }
            }
        });
        assertThatThrownBy(() -> started.get(PATIENCE)).hasMessageContaining("ended with status 7");
        assertThatThrownBy(() -> process.health().get(PATIENCE)).hasMessageContaining("does not run");
    }

    @Test
    void lineOfTheProcessTable_thatMakesNoSense_isOfNoProcess() throws Exception {
        var lines = List.of(
                "1 (sh) S 0 1 1 0 -1",
                "2 (a) Z) b) R 1 2 1 0",
                "3 (gone) Z 1 3 3 0",
                "",
                "5",
                "6 (x",
                "7 (x) S one 2 3");
        for (int i = 0; i < lines.size(); i++) {
            Path process = Files.createDirectory(directory.resolve(String.valueOf(i + 1)));
            Files.writeString(process.resolve("stat"), lines.get(i));
        }
        assertThat(ProcessTree.entries(directory))
                .containsExactlyInAnyOrder(new ProcessTree.Entry(1, 0, 1), new ProcessTree.Entry(2, 1, 1));
    }

    @Test
    void processTableThatCannotBeRead_isNotTakenForAnEmptyOne() {
        assertThatThrownBy(() -> ProcessTree.entries(directory.resolve("none")))
                .isInstanceOf(UncheckedIOException.class)
                .hasMessageStartingWith("the process table cannot be read at ");
    }

    @Test
    void endOfTheVirtualMachine_endsTheProcess() throws Exception {
        Process machine = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-XX:TieredStopAtLevel=1",
                        "-cp",
                        System.getProperty("java.class.path"),
                        Machine.class.getName())
                .redirectErrorStream(true)
                .start();
        String said = new String(machine.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(machine.waitFor(60, TimeUnit.SECONDS)).isTrue();
        assertThat(said.strip()).matches("[0-9]+");
        var left = ProcessHandle.of(Long.parseLong(said.strip()))
                .filter(each -> each.info().commandLine().isPresent());
        left.ifPresent(ProcessHandle::destroyForcibly);
        assertThat(left).isEmpty();
    }

    private static boolean hasSessions() {
        return Files.isReadable(Path.of("/proc/self/stat"))
                && Stream.of("/usr/bin/setsid", "/bin/setsid").map(Path::of).anyMatch(Files::isExecutable);
    }
}
