package io.troupe.common.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ProgramsTest {
    private static final String NAME = "nats-server";

    @TempDir
    Path folder;

    private Path put(String place, String name, boolean executable) throws IOException {
        Path file = Files.createDirectories(folder.resolve(place)).resolve(name);
        Files.writeString(file, "#!/bin/sh\n");
        assertThat(file.toFile().setExecutable(executable)).isTrue();
        return file;
    }

    private Stream<String> folders(String... places) {
        return Stream.of(places).map(place -> folder.resolve(place).toString());
    }

    @Test
    void firstFolderThatHasTheProgram_counts_andOnlyPrograms() throws IOException {
        put("a", NAME, false);
        Files.createDirectories(folder.resolve("b").resolve(NAME));
        Path found = put("c", NAME, true);
        put("d", NAME, true);
        assertThat(Programs.find(NAME, folders("missing", "a", "b", "c", "d"), false))
                .contains(found);
        assertThat(Programs.find(NAME, folders("a", "b"), false)).isEmpty();
    }

    @Test
    void exe_isAProgramOfWindowsOnly() throws IOException {
        Path exe = put("a", NAME + ".exe", true);
        assertThat(Programs.find(NAME, folders("a"), true)).contains(exe);
        assertThat(Programs.find(NAME, folders("a"), false)).isEmpty();
    }

    @Test
    void places_areThoseOfPackages() {
        assertThat(Programs.places()).contains("the PATH", "/usr/sbin", "/usr/local/sbin", "/opt/homebrew/bin");
    }
}
