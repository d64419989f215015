package io.troupe.demo.terminal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import org.junit.jupiter.api.Assumptions;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(60)
class TerminalTest {
    private final Interruption interruption = Interruption.none();

    @Test
    void request_isNoticedByAllWaysToLook_andALateListenerRunsAtOnce() {
        interruption.check();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isFalse();
        var log = new ArrayList<String>();
        interruption.onRequest(() -> log.add("asked"));

        interruption.request();

        assertThat(interruption.isRequested()).isTrue();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isTrue();
        assertThat(log).containsExactly("asked");
        assertThatThrownBy(interruption::check).isInstanceOf(InterruptedCommand.class);

        interruption.onRequest(() -> log.add("late"));
        assertThat(log).containsExactly("asked", "late");
    }

    @Test
    void waitForARequest_endsWithTheRequest_orWhenItsThreadIsInterrupted() throws Exception {
        Thread.currentThread().interrupt();
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isFalse();
        assertThat(Thread.interrupted()).isTrue();

        var waiting = Thread.ofPlatform().start(interruption::request);
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isTrue(); // returns at once
        waiting.join();
    }

    @TempDir
    private Path directory;

    @Test
    void words_haveNoNamesOfClasses() {
        assertThat(FileProblems.message(new NoSuchFileException("a/b"))).isEqualTo("a/b: no such file");
        assertThat(FileProblems.message(new AccessDeniedException("a/b"))).isEqualTo("a/b: permission denied");
        assertThat(FileProblems.message(new FileSystemException("a/b", null, "Is a directory")))
                .isEqualTo("a/b: is a directory");
        assertThat(FileProblems.message(new IOException())).isEqualTo("cannot be read or written");
    }

    @Test
    void fullDisk_isToldWithTheFile() throws IOException {
        Path full = Path.of("/dev/full");
        Assumptions.assumeTrue(Files.exists(full));
        Path file = Files.createSymbolicLink(directory.resolve("picture.svg"), full);
        assertThatThrownBy(() -> OutputFiles.write(file, "x".repeat(100_000)))
                .isInstanceOf(IOException.class)
                .hasMessage(file + ": No space left on device");
    }
}
