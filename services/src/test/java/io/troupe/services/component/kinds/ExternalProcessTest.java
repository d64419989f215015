package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.bus.BusPort;
import io.troupe.services.bus.BusSettings;
import io.troupe.services.bus.InProcessBus;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.Notes;
import io.troupe.services.component.kinds.ProcessComponent.TextLine;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** Real processes, so real threads and real time; every wait has an end that the process brings about. */
@Timeout(60)
class ExternalProcessTest {
    private static final Duration PATIENCE = Duration.ofSeconds(20);
    private static final Path SHELL = Path.of("/bin/sh");

    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("processes"));
    private final InProcessBus bus = InProcessBus.open("here", BusSettings.on(space));
    private final BusPort user = bus.attach("user");
    private final Notes notes = new Notes();
    private final LinkedBlockingQueue<String> lines = new LinkedBlockingQueue<>();

    @TempDir
    private Path directory;

    @BeforeEach
    void aShellIsThere() {
        assumeTrue(Files.isExecutable(SHELL), "there is no " + SHELL + " on this machine");
    }

    @AfterEach
    void nothingIsLeft() throws Exception {
        bus.close();
        space.close();
        for (var process : ProcessHandle.current().children().toList()) {
            process.onExit().get(20, TimeUnit.SECONDS); // one that nobody ends fails the test here
        }
    }

    private ComponentInterface<?, ?> open(Duration startLimit, String... command) throws Exception {
        var component = ProcessComponent.of(
                "script",
                "scripting",
                new ProcessComponent.Settings(List.of(command), directory, startLimit, Duration.ofMillis(200)));
        var opened = new CompletableFuture<ComponentInterface<?, ?>>();
        space.execute(() -> {
            user.subscribe(ProcessComponent.output("script"), (line, from) -> lines.add(line.text()));
            opened.complete(ComponentInterface.open(bus, "script", component, notes));
        });
        return opened.get(20, TimeUnit.SECONDS);
    }

    private ComponentInterface<?, ?> shell(String script) throws Exception {
        return open(PATIENCE, SHELL.toString(), "-c", script);
    }

    private static @Nullable Void done(Promise<@Nullable Void> promise) throws Exception {
        return promise.get(PATIENCE);
    }

    private String line() throws InterruptedException {
        return String.valueOf(lines.poll(20, TimeUnit.SECONDS));
    }

    @Test
    void process_runsFromItsFirstLine_andItsDataAreLines() throws Exception {
        var face = shell("echo ready; while read line; do echo \"heard $line\"; done");
        done(face.start());
        assertThat(line()).isEqualTo("ready");
        done(face.check());
        user.publish(ProcessComponent.input("script"), new TextLine("one"));
        user.publish(ProcessComponent.input("script"), new TextLine("two"));
        assertThat(line()).isEqualTo("heard one");
        assertThat(line()).isEqualTo("heard two");
        done(face.stop());
        assertThatThrownBy(() -> done(face.check())).hasMessage("here/script has been terminated");
    }

    @Test
    void processThatEndsByItself_hasFailed_withItsStatusAndItsLastErrors() throws Exception {
        var face = shell("echo ready; read line; echo 'out of wheels' >&2; exit 7");
        done(face.start());
        assertThat(line()).isEqualTo("ready");
        user.publish(ProcessComponent.input("script"), new TextLine("go"));
        awaitNote("script has failed");
        assertThatThrownBy(() -> done(face.check()))
                .isInstanceOf(ProviderException.class)
                .hasMessageContaining("ended with status 7; it said: out of wheels");
    }

    @Test
    void processThatEndsBeforeItsFirstLine_isNotStarted() throws Exception {
        var face = shell("echo 'no such robot' >&2; exit 1");
        assertThatThrownBy(() -> done(face.start()))
                .hasMessageStartingWith("here/script has failed: ")
                .hasMessageEndingWith("ended with status 1; it said: no such robot");
    }

    @Test
    void programThatDoesNotExist_isNamed() throws Exception {
        var face = open(PATIENCE, "no-such-program-anywhere");
        assertThatThrownBy(() -> done(face.start()))
                .hasMessageContaining("\"no-such-program-anywhere\" cannot be started")
                .message()
                .doesNotEndWith(" ");
    }

    @Test
    void processThatSaysNothing_isGivenUp_andEnded() throws Exception {
        var face = open(Duration.ofMillis(50), SHELL.toString(), "-c", "exec sleep 1000");
        assertThatThrownBy(() -> done(face.start()))
                .hasMessageContaining("has written no line in PT0.05S, expected one when it is ready");
    }

    @Test
    void processThatIsDeafToTermination_isMadeToEnd() throws Exception {
        var face = shell("trap '' TERM; echo ready; while :; do sleep 0.05; done");
        done(face.start());
        done(face.stop());
        done(face.start());
        done(face.stop());
    }

    @Test
    void programThatAScriptHasStarted_endsWithIt() throws Exception {
        var face = shell("sleep 1000 & echo $!; wait");
        done(face.start());
        var started = ProcessHandle.of(Long.parseLong(line())).orElseThrow();
        done(face.stop());
        assertThat(started.isAlive()).isFalse();
    }

    @Test
    void linesThatAProcessDoesNotRead_areTold() throws Exception {
        var face = shell("exec <&-; echo ready; exec sleep 1000");
        done(face.start());
        assertThat(line()).isEqualTo("ready");
        user.publish(ProcessComponent.input("script"), new TextLine("one"));
        awaitNote("reads its standard input no more");
        user.publish(ProcessComponent.input("script"), new TextLine("two"));
        awaitQuiet();
        done(face.stop());
        awaitNote("1 lines for");
    }

    private void awaitNote(String text) {
        while (notes.take().stream().noneMatch(note -> note.contains(text))) {
            Thread.onSpinWait();
        }
    }

    /** What was published before has come to the process. */
    private void awaitQuiet() throws Exception {
        for (int turn = 0; turn < 3; turn++) {
            var over = new CompletableFuture<Boolean>();
            space.execute(() -> over.complete(true));
            over.get(20, TimeUnit.SECONDS);
        }
    }
}
