package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.demo.evaluate.Measurement.Kind;
import io.troupe.demo.evaluate.Measurement.Quantity;
import io.troupe.services.subsumption.Mode;
import java.io.IOException;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

@Timeout(60)
class MeasuringProcessTest {
    private static final Path WORLD = Path.of("worlds", "paper-arena.cfg");

    private static final Job LOOPS = new Job(Kind.LOOPS, Mode.PROMISE, "both", 2, 1, 1, 0);

    @TempDir
    private Path directory;

    private MeasuringProcess start(int cores, Path world) throws IOException {
        return MeasuringProcess.start(cores, world, directory.resolve("log"));
    }

    @Test
    void jobAndValue_areReadAsTheyAreWritten() {
        var job = new Job(Kind.ALONE, Mode.SYNC, "wallFollower", 20, 2.5, 7, 6665);
        assertThat(Job.parse(job.line())).isEqualTo(job);
        var value = new Job.Result.Value("both", Quantity.DELAY_P99, 0.1);
        assertThat(Job.Result.Value.parse(value.line())).isEqualTo(value);
        assertThatThrownBy(() -> Job.parse("ALONE SYNC")).hasMessageContaining("a job of 2 fields, expected 7");
    }

    @Test
    void jobThatFails_isToldWithItsReason_andTheNextOneIsDone() throws IOException {
        try (var process = start(2, WORLD)) {
            var nobodyThere = new Job(Kind.LOOPS, Mode.PROMISE, "both", 2, 1, 1, 1);
            assertThatThrownBy(() -> process.measure(nobodyThere))
                    .isInstanceOf(IOException.class)
                    .hasMessageContainingAll("promise mode, loops: ", "127.0.0.1:1 cannot be reached");
            assertThat(process.measure(LOOPS).values()).contains(new Job.Result.Value("both", Quantity.TIME, 200));
        }
    }

    /** Two values, of which at most one is the number of processors of this machine. */
    @ParameterizedTest
    @ValueSource(ints = {1, 5})
    void jvmThatMeasures_hasAsManyProcessorsAsItIsTold(int cores) throws IOException {
        try (var process = start(cores, WORLD)) {
            assertThat(process.measure(LOOPS).values()).isNotEmpty(); // rejected if the JVM reports another number
        }
    }

    @Test
    void jvmThatEnds_isToldWithItsStatus() throws IOException {
        try (var process = start(2, directory.resolve("no.world"))) {
            assertThatThrownBy(() -> process.measure(LOOPS))
                    .isInstanceOf(IOException.class)
                    .hasMessageContaining("the JVM that measures (told 2 cores) has ended: exit status 1, see "
                            + directory.resolve("log"));
        }
    }
}
