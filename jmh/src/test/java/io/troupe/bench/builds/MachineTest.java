package io.troupe.bench.builds;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class MachineTest {
    @TempDir
    Path folder;

    @Test
    void model_isTheFirstThatIsNamed_orNone() throws Exception {
        Path file = folder.resolve("cpuinfo");
        Files.writeString(file, "processor\t: 0\nmodel\t\t: 85\nmodel name\t: Some CPU @ 2 GHz\nmodel name\t: other\n");
        assertThat(Machine.model(file)).contains("Some CPU @ 2 GHz");
        Files.writeString(file, "processor\t: 0\nCPU part\t: 0xd0c\n");
        assertThat(Machine.model(file)).isEmpty();
        assertThat(Machine.model(folder.resolve("none"))).isEmpty();
    }

    @Test
    void text_namesCoresAndJvm() {
        assertThat(Machine.text())
                .contains(Runtime.getRuntime().availableProcessors() + " cores for the JVM")
                .contains(Runtime.version().toString());
    }
}
