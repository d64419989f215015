package io.troupe.demo.terminal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileSystemException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import org.junit.jupiter.api.Assumptions;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class FileProblemsTest {
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
