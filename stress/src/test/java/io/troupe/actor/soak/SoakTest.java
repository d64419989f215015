package io.troupe.actor.soak;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SoakTest {
    @Test
    @Timeout(120)
    void shortSoak_losesNothing_andKeepsTheOrder() throws InterruptedException {
        var lines = new ArrayList<String>();
        var options = SoakMain.options("--messages", "200_000", "--window", "1_000", "--capacity", "100");
        assertThat(new Soak(options, lines::add).run()).isEmpty();
        // a sample may be taken between the last message and the end of a phase: then its line appears twice
        assertThat(lines)
                .filteredOn(line -> line.contains("100,000 of 100,000"))
                .extracting(line -> line.split(" ")[0])
                .containsOnly("unbounded", "bounded");
    }

    @Test
    void messagesLostDoubledOrOvertaken_areFaults() {
        try (var test = new TestSpace()) {
            Soak.Sink sink = test.spawn(Soak.Sink.class, () -> new Soak.Receiver("sink", 2));
            sink.take(0, 0);
            sink.take(1, 0);
            sink.take(0, 2); // 1 is lost
            sink.take(1, 0); // again
            assertThat(test.get(sink.faults()))
                    .containsExactly(
                            "sink: message 2 of producer 0 came where 1 was expected",
                            "sink: message 0 of producer 1 came where 1 was expected");
            assertThat(test.get(sink.takenInAll())).isEqualTo(4);
        }
    }

    @Test
    void heapThatGrows_isSeen() {
        var heap = new Soak.HeapWatch(4);
        var kept = new byte[16 << 20];
        assertThat(heap.sampleMib()).isPositive();
        assertThat(heap.isExceeded())
                .as(heap + " with " + kept.length + " bytes kept")
                .isTrue();
    }

    @Test
    void options_haveTheirDefaults_andAreRead() {
        assertThat(SoakMain.options()).isEqualTo(new SoakOptions(20_000_000, 4, 5_000, 1_000, 24));
        String line = "--messages 99 --producers 2 --window 3 --capacity 4 --heap-bound-mib 5 --window 6";
        assertThat(SoakMain.options(line.split(" "))).isEqualTo(new SoakOptions(99, 2, 6, 4, 5));
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--messages many | soak: --messages is many, expected a whole number",
                "--producers 0 | soak: --producers is 0, expected 1 or more",
                "--producers 5_000_000_000 | soak: --producers is 5_000_000_000, expected a whole number",
                "--messages 15 | soak: --messages is 15, expected 16 or more",
                "--message 1 | '--message'",
                "--window | soak: Missing required parameter for option '--window' (N)"
            })
    void optionsThatMakeNoSense_areRejected_beforeTheUsage(String line, String message) {
        var err = new StringWriter();
        int status = SoakMain.commandLine().setErr(new PrintWriter(err)).execute(line.split(" "));
        assertThat(err.toString()).contains(message).contains("Usage: soak");
        assertThat(status).isEqualTo(2);
    }
}
