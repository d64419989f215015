package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.services.component.ComponentBroker;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.ProcessComponent.TextLine;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.reflect.Proxy;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ForkJoinPool;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Processes as components, and their process trees. Uses real processes, and so real threads and real time. Every wait
 * is ended by an event of a process.
 */
@Timeout(120)
class ExternalProcessTest {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Duration SHORT = Duration.ofMillis(200);
    private static final Duration EVER = Duration.ofSeconds(Long.MAX_VALUE);
    private static final Path SHELL = Path.of("/bin/sh");

    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("processes"));
    private final Bus bus = Bus.inProcess("here", BusSettings.on(space));
    private final BusPort user = bus.attach("user");
    private final RecordingObserver notes = new RecordingObserver();
    private final ComponentBroker broker = new ComponentBroker(space, ComponentBroker.PATIENT, notes);
    private final LinkedBlockingQueue<String> lines = new LinkedBlockingQueue<>();
    private final List<ProcessTree> trees = new CopyOnWriteArrayList<>();

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
        assertThat(trees)
                .allSatisfy(tree -> assertThat(tree.end(PATIENCE, PATIENCE)).isEmpty());
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

    private ComponentBroker.Registered<?, ?> open(Duration startLimit, Duration stopLimit, String... command)
            throws Exception {
        var settings = ProcessComponent.Settings.of(List.of(command), directory)
                .withStartLimit(startLimit)
                .withStopLimit(stopLimit);
        var component = ProcessComponent.of("script", "scripting", settings);
        var opened = new CompletableFuture<ComponentBroker.Registered<?, ?>>();
        space.execute(() -> {
            user.subscribe(ProcessComponent.output("script"), (line, from) -> lines.add(line.text()));
            opened.complete(broker.register(ComponentInterface.open(bus, "script", component, notes)));
        });
        return opened.get(60, TimeUnit.SECONDS);
    }

    private ComponentBroker.Registered<?, ?> shell(Duration startLimit, Duration stopLimit, String script)
            throws Exception {
        String text = script.replace("SLEEP", "tail -f " + directory.resolve("empty"));
        return open(startLimit, stopLimit, SHELL.toString(), "-c", text, directory.toString());
    }

    /** Starts a script that ends on request. A limit of ever is no error. */
    private ComponentBroker.Registered<?, ?> started(String script) throws Exception {
        var provider = shell(EVER, EVER, script);
        done(provider.start());
        return provider;
    }

    private static @Nullable Void done(Promise<@Nullable Void> promise) throws Exception {
        return promise.get(PATIENCE);
    }

    private void send(String line) {
        user.publish(ProcessComponent.input("script"), new TextLine(line));
    }

    private String line() throws InterruptedException {
        return String.valueOf(lines.poll(60, TimeUnit.SECONDS));
    }

    /** Reads a line with the number of a process. It has no command line while it executes another program. */
    private String lineOfProcess() throws InterruptedException {
        String pid = line();
        while (!isAlive(pid)) {
            Thread.sleep(1);
        }
        return pid;
    }

    private void awaitNote(String text) throws InterruptedException {
        while (notes.take().stream().noneMatch(note -> note.contains(text))) {
            Thread.sleep(1);
        }
    }

    private static boolean hasSessions() {
        return Files.isReadable(Path.of("/proc/self/stat"))
                && Stream.of("/usr/bin/setsid", "/bin/setsid").map(Path::of).anyMatch(Files::isExecutable);
    }

    /** Without a session, a process whose parent has ended is not found. */
    private static void assumeSessions() {
        assumeTrue(hasSessions(), "there is no setsid on this machine");
    }

    // ---- a component that is a process

    @Test
    void process_runsFromItsFirstLine_andItsDataAreLines() throws Exception {
        var provider = started("echo ready; while read line; do echo \"heard $line\"; done");
        assertThat(line()).isEqualTo("ready");
        done(provider.check());
        send("one");
        send("two");
        assertThat(List.of(line(), line())).containsExactly("heard one", "heard two");
        done(provider.stop());
        assertThatThrownBy(() -> done(provider.check())).hasMessage("here/script has been terminated");
    }

    @Test
    void processThatEndsByItself_hasFailed_withItsStatusAndItsLastErrors() throws Exception {
        var provider = started("echo ready; read line; echo 'out of wheels' >&2; exit 7");
        assertThat(line()).isEqualTo("ready");
        send("go");
        awaitNote("script has failed");
        assertThatThrownBy(() -> done(provider.check()))
                .isInstanceOf(ProviderException.class)
                .hasMessageContaining("ended with status 7; it printed: out of wheels");
    }

    @Test
    void processThatEndsBeforeItsFirstLine_isNotStarted() {
        assertThatThrownBy(() -> started("echo 'no such robot' >&2; exit 1"))
                .hasMessageStartingWith("here/script has failed: ")
                .hasMessageEndingWith("ended with status 1; it printed: no such robot");
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

    @ParameterizedTest
    @ValueSource(
            strings = {
                "trap : TERM; while :; do SLEEP & echo $!; wait $!; done",
                "trap 'SLEEP & exit 0' TERM; SLEEP & echo ready; wait"
            })
    void programThatAScriptStartsWhenItIsTerminated_endsWithIt_andTheCommonPoolIsFree(String script) throws Exception {
        var provider = shell(PATIENCE, SHORT, script);
        for (int life = 0; life < 4; life++) {
            done(provider.start());
            done(provider.stop());
            assertThat(alive()).isEmpty();
        }
        for (int task = 0; task < ForkJoinPool.getCommonPoolParallelism(); task++) {
            assertThat(ForkJoinPool.commonPool().submit(() -> "done").get(60, TimeUnit.SECONDS))
                    .isEqualTo("done");
        }
    }

    /**
     * A shell may start a program just before it ends. That program is not in the tree when the first requests to end
     * are sent.
     */
    @Test
    void programThatIsStartedAmidTheTermination_isTerminatedToo() throws Exception {
        assumeSessions();
        done(started("trap 'SLEEP & exit' TERM; echo ready; SLEEP & wait").stop());
        assertThat(alive()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(
            quoteCharacter = '`',
            value = {"PT0.2S, trap '' TERM; echo $$; while :; do SLEEP; done", "PT60S, SLEEP & echo $!; wait"})
    void processThatIsDeafToTermination_orStartedByTheScript_endsWithTheComponent(Duration stopLimit, String script)
            throws Exception {
        var provider = shell(PATIENCE, stopLimit, script);
        for (int life = 0; life < 2; life++) {
            done(provider.start());
            var pid = lineOfProcess();
            done(provider.stop());
            assertThat(isAlive(pid)).as("process %s is alive", pid).isFalse();
        }
    }

    @Test
    void processThatEndsBeforeItsChild_hasFailed_whenTheChildHasEnded() throws Exception {
        assumeSessions();
        var provider = started("SLEEP & echo $!; read line; exit 7");
        var child = lineOfProcess();
        var livesBesideTheNext = broker.nextFailure().handle((ended, error) -> isAlive(child));
        send("go");
        assertThat(livesBesideTheNext.get(PATIENCE)).isFalse();
        assertThatThrownBy(() -> done(provider.check())).hasMessageContaining("ended with status 7");
        awaitNote("has ended with status 7, before processes that it had started; these are ended too: " + child);
        while (Thread.getAllStackTraces().keySet().stream() // the readers end with the child that holds their pipes
                .map(Thread::getName)
                .anyMatch(name -> name.matches("std(out|err) of " + SHELL))) {
            Thread.sleep(1);
        }
    }

    @Test
    void healthOfAProcessThatHasEnded_isAnsweredWhenItsDeafChildHasEnded() throws Exception {
        assumeSessions();
        var provider = shell(PATIENCE, SHORT, "(trap '' TERM; exec SLEEP) & echo $!; read line; exit 7");
        done(provider.start());
        var child = lineOfProcess();
        send("go");
        while (provider.check().handle((well, error) -> error == null).get(PATIENCE)) {
            Thread.sleep(1);
        }
        assertThat(isAlive(child)).isFalse();
    }

    @Test
    void lineThatDoesNotEnd_isCut_andThisIsReported() throws Exception {
        int longest = ExternalProcess.LONGEST_LINE_CHARACTERS;
        var provider = started("echo ready; head -c " + longest + " /dev/zero | tr '\\0' x; echo;"
                + " head -c 1000000 /dev/zero | tr '\\0' y; echo; echo last; SLEEP");
        assertThat(line()).isEqualTo("ready");
        assertThat(line()).isEqualTo("x".repeat(longest));
        assertThat(line()).isEqualTo("y".repeat(longest));
        assertThat(line()).isEqualTo("last");
        assertThat(notes.take())
                .filteredOn(note -> note.contains("a line of more than"))
                .singleElement()
                .asString()
                .endsWith(" wrote a line of more than 65536 characters to its standard output; the rest of the line is"
                        + " lost");
        done(provider.stop());
    }

    @Test
    void linesThatAProcessDoesNotRead_areTold() throws Exception {
        var provider = started("exec <&-; echo ready; exec SLEEP");
        assertThat(line()).isEqualTo("ready");
        send("one");
        awaitNote("reads its standard input no more");
        send("two");
        for (int turn = 0; turn < 3; turn++) { // until the line has reached the process
            var over = new CompletableFuture<Boolean>();
            space.execute(() -> over.complete(true));
            over.get(60, TimeUnit.SECONDS);
        }
        done(provider.stop());
        awaitNote("1 lines for");
    }

    // ---- the tree of a process

    private static ProcessComponent.Settings script(Path directory, Duration stopLimit, String script) {
        return ProcessComponent.Settings.of(List.of(SHELL.toString(), "-c", script), directory)
                .withStartLimit(PATIENCE)
                .withStopLimit(stopLimit);
    }

    private ProcessComponent.Settings script(String script) {
        return script(directory, PATIENCE, script);
    }

    /** A password of the bus is for this process only. */
    @Test
    void environment_isThatOfThisProcess_withoutOurVariables() throws Exception {
        var environment =
                Map.of("TROUPE_BUS_PASSWORD", "secret", "TROUPE_PASSWORD", "secret", "OTHER", "kept", "PATH", "/bin");
        var tree = ProcessTree.start(
                script("echo $OTHER $TROUPE_BUS_PASSWORD $TROUPE_PASSWORD; env | grep -c TROUPE"), null, environment);
        trees.add(tree);
        assertThat(new String(tree.root().getInputStream().readAllBytes(), StandardCharsets.UTF_8))
                .isEqualTo("kept\n0\n");
    }

    /** Starts a process tree, which ends after the test. */
    private ProcessTree tree(ProcessComponent.Settings settings) throws IOException {
        trees.add(ProcessTree.start(settings));
        return trees.getLast();
    }

    private static ProcessHandle firstLine(ProcessTree tree) throws Exception {
        var reader = tree.root().inputReader(StandardCharsets.UTF_8);
        return ProcessHandle.of(Long.parseLong(reader.readLine())).orElseThrow();
    }

    /** Signals of which only the information counts. */
    private static ComponentCommunication.Signals<String> signals(Consumer<String> infos) {
        return new ComponentCommunication.Signals<>() {
            @Override
            public void data(String line) {}

            @Override
            public void failed(Throwable why) {}

            @Override
            public void info(String what) {
                infos.accept(what);
            }
        };
    }

    private static Promise<@Nullable Void> invoke(ExternalProcess process) {
        return process.invoke(signals(what -> {}));
    }

    @Test
    void withoutSessions_descendantsEndWithTheProgram() throws Exception {
        trees.add(ProcessTree.start(script("sleep 1000 & echo $!; wait"), null));
        var tree = trees.getFirst();
        var child = firstLine(tree);
        assertThat(tree.alive()).containsExactlyInAnyOrder(tree.root().toHandle(), child);
        assertThat(tree.end(PATIENCE, PATIENCE)).isEmpty();
        assertThat(tree.root().isAlive()).isFalse();
        assertThat(tree.alive()).isEmpty();
    }

    @Test
    void session_hasTheProcessesWhoseParentsHaveEnded() throws Exception {
        assumeSessions();
        var tree = tree(script("sh -c 'sleep 1000 & echo $!'; exec sleep 1000"));
        var orphan = firstLine(tree);
        while (orphan.parent().map(ProcessHandle::pid).orElse(0L) == tree.root().pid()
                || tree.alive().size() > 2) {
            Thread.sleep(1);
        }
        assertThat(tree.alive()).containsExactlyInAnyOrder(tree.root().toHandle(), orphan);
    }

    /** A zombie, which may never be reaped in a container without an init process. */
    @Test
    void zombie_isNotAlive() throws Exception {
        assumeSessions();
        var tree = tree(script("sleep 1000 & echo $!; exec sleep 1000"));
        var child = firstLine(tree);
        var root = tree.root().toHandle();
        while (!List.of(root.info().arguments().orElse(new String[0])).equals(List.of("1000"))) {
            Thread.sleep(1); // until the shell has become sleep: a shell would reap the zombie
        }
        child.destroyForcibly();
        while (!Files.readString(Path.of("/proc/" + child.pid() + "/stat")).contains(") Z ")) {
            Thread.sleep(1);
        }
        assertThat(child.isAlive()).as("what the machine says").isTrue();
        assertThat(tree.alive()).containsExactly(root);
    }

    @Test
    void processThatCannotBeKilled_isReported_andTheNextTerminationTriesAgain() throws Exception {
        var shortest = Duration.ofMillis(50);
        var kills = new AtomicInteger();
        ExternalProcess.Starter starter = settings -> {
            var tree = ProcessTree.start(settings, null);
            tree.add(immortal(kills));
            return tree;
        };
        var settings = script(directory, shortest, "echo ready; exec sleep 1000");
        var process = new ExternalProcess(settings, starter, shortest, Duration.ZERO);
        done(invoke(process));
        assertThatThrownBy(() -> done(process.terminate()))
                .isInstanceOf(ProviderException.class)
                .hasMessageEndingWith("was killed, and PT0.05S later some of its processes are still alive: "
                        + Long.MAX_VALUE + " (/bin/rock)");
        int before = kills.get();
        assertThat(before).isPositive();
        assertThatThrownBy(() -> done(process.terminate())).hasMessageContaining("/bin/rock");
        assertThat(kills.get()).isGreaterThan(before);
    }

    /** The request is made before the clock is looked at: a look at the processes may take longer than the limit. */
    @Test
    void processThatCannotBeKilled_isKilledOnce_evenIfTheLimitIsOverAtOnce() throws Exception {
        var kills = new AtomicInteger();
        var tree = ProcessTree.start(script(directory, Duration.ZERO, "exit 0"), null);
        tree.add(immortal(kills));
        assertThat(tree.end(Duration.ZERO, Duration.ZERO))
                .extracting(ProcessHandle::pid)
                .contains(Long.MAX_VALUE);
        assertThat(kills.get()).isPositive();
    }

    /** A program that has just been started by a shell may lose a request to end, since it is not yet itself. */
    @Test
    void processThatLosesTheFirstRequests_isRequestedAgain() throws Exception {
        var requests = new AtomicInteger();
        var tree = ProcessTree.start(script(directory, Duration.ZERO, "exit 0"), null);
        tree.add(process(Map.of("destroy", () -> requests.incrementAndGet() > 0, "isAlive", () -> requests.get() < 3)));
        assertThat(tree.end(PATIENCE, Duration.ZERO)).isEmpty();
        assertThat(requests.get()).isEqualTo(3);
    }

    private static ProcessHandle immortal(AtomicInteger kills) {
        return process(Map.of("destroyForcibly", () -> kills.incrementAndGet() > 0));
    }

    /** A process with some methods replaced. */
    private static ProcessHandle process(Map<String, Supplier<Boolean>> replaced) {
        var loader = ExternalProcessTest.class.getClassLoader();
        var info = Proxy.newProxyInstance(
                loader, new Class<?>[] {ProcessHandle.Info.class}, (proxy, method, values) -> Optional.of("/bin/rock"));
        return (ProcessHandle) Proxy.newProxyInstance(
                loader, new Class<?>[] {ProcessHandle.class}, (proxy, method, values) -> switch (method.getName()) {
                    case "pid" -> Long.MAX_VALUE;
                    case "info" -> info;
                    case "descendants" -> Stream.empty();
                    case "hashCode" -> 0;
                    case "equals" -> proxy == values[0];
                    case "toString" -> "/bin/rock";
                    default ->
                        replaced.getOrDefault(method.getName(), () -> true).get();
                });
    }

    /** Runs the shutdown hook of a process, until it waits or ends. */
    private static Thread startShutdown(ExternalProcess process) throws InterruptedException {
        var hook = Thread.ofPlatform().start(process::endAtShutdown);
        while (hook.getState() != Thread.State.TIMED_WAITING && hook.isAlive()) {
            Thread.sleep(1);
        }
        return hook;
    }

    @Test
    void shutdownDuringAStart_endsTheProcess() throws Exception {
        var begun = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        ExternalProcess.Starter starter = settings -> {
            begun.countDown();
            try {
                goOn.await();
            } catch (InterruptedException e) {
                throw new IOException(e);
            }
            return tree(settings);
        };
        var process = new ExternalProcess(script("echo ready; exec sleep 1000"), starter, PATIENCE, Duration.ZERO);
        var start = Thread.ofPlatform().start(() -> invoke(process).handle((runs, error) -> null));
        begun.await();
        var hook = startShutdown(process);
        goOn.countDown();
        start.join();
        hook.join();
        assertThat(trees.getFirst().root().isAlive()).isFalse();
    }

    @Test
    void shutdown_leavesTheStopToTheApplicationFirst() throws Exception {
        var process = new ExternalProcess(script("echo ready; exec sleep 1000"), this::tree, PATIENCE, PATIENCE);
        done(invoke(process));
        var hook = startShutdown(process);
        try {
            assertThat(trees.getFirst().root().isAlive()).isTrue();
        } finally {
            done(process.terminate());
        }
        hook.join();
    }

    @Test
    void startThatThrows_leavesNoShutdownHook() {
        ExternalProcess.Starter starter = settings -> {
            throw new IllegalArgumentException("a null character in the command");
        };
        var process = new ExternalProcess(script("echo ready"), starter, PATIENCE, Duration.ZERO);
        assertThatThrownBy(() -> done(invoke(process)))
                .isInstanceOf(ProviderException.class)
                .hasMessageEndingWith("cannot be started: a null character in the command");
        assertThat(Runtime.getRuntime().removeShutdownHook(process.shutdownHook))
                .isFalse();
    }

    @Test
    void listenerThatThrowsAtTheEnd_leavesNoStartThatWaits() {
        assumeSessions();
        var process = new ExternalProcess(script("sleep 1000 & exit 7"));
        var started = process.invoke(signals(what -> {
            if (what.contains("has ended with status")) {
                throw new IllegalStateException("no room for a message");
            }
        }));
        assertThatThrownBy(() -> done(started)).hasMessageContaining("ended with status 7");
        assertThatThrownBy(() -> done(process.health())).hasMessageContaining("does not run");
    }

    @Test
    void lineOfTheProcessTable_thatMakesNoSense_isOfNoProcess() throws Exception {
        int number = 1;
        for (String line :
                "1 (sh) S 0 1 1 0 -1|2 (a) Z) b) R 1 2 1 0|3 (gone) Z 1 3 3 0||5|6 (x|7 (x) S one 2 3".split("\\|")) {
            Path process = Files.createDirectory(directory.resolve(String.valueOf(number++)));
            Files.writeString(process.resolve("stat"), line);
        }
        assertThat(ProcessTree.entries(directory))
                .containsExactlyInAnyOrder(new ProcessTree.Entry(1, 0, 1), new ProcessTree.Entry(2, 1, 1));
        assertThatThrownBy(() -> ProcessTree.entries(directory.resolve("none")))
                .isInstanceOf(UncheckedIOException.class)
                .hasMessageStartingWith("the process table cannot be read at ");
    }

    /** Main program: starts a process, prints its number on the first line, and exits as Ctrl-C would. */
    static final class Machine {
        private Machine() {}

        public static void main(String[] arguments) throws Exception {
            var process = new ExternalProcess(script(Path.of("."), PATIENCE, "echo ready; exec sleep 1000"));
            done(process.invoke(signals(what -> System.out.println(what.split("[ :]+")[1]))));
            System.exit(0);
        }
    }

    @Test
    void endOfTheVirtualMachine_endsTheProcess() throws Exception {
        String java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        String path = System.getProperty("java.class.path");
        var machine = new ProcessBuilder(java, "-XX:TieredStopAtLevel=1", "-cp", path, Machine.class.getName())
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
}
