package io.troupe.actor.soak;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class SoakTest {
    @Test
    @Timeout(120)
    void shortSoak_losesNothing_andKeepsTheOrder() throws InterruptedException {
        var lines = new ArrayList<String>();
        var options = SoakOptions.parse(List.of("--messages", "200_000", "--window", "1_000", "--capacity", "100"));
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
            Sink sink = test.spawn(Sink.class, () -> new Receiver("sink", 2));
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
        var heap = new HeapWatch(4);
        var kept = new byte[16 << 20];
        assertThat(heap.sampleMib()).isPositive();
        assertThat(heap.isExceeded())
                .as(heap + " with " + kept.length + " bytes kept")
                .isTrue();
    }

    @Test
    void optionsThatMakeNoSense_areRejected() {
        assertThatThrownBy(() -> SoakOptions.parse(List.of("--messages", "many")))
                .hasMessage("--messages is many, expected a whole number");
        assertThatThrownBy(() -> SoakOptions.parse(List.of("--producers", "0")))
                .hasMessage("--producers is 0, expected 1 or more");
        assertThatThrownBy(() -> SoakOptions.parse(List.of("--message", "1"))).hasMessageContaining("--message, exp");
        assertThatThrownBy(() -> SoakOptions.parse(List.of("--window"))).hasMessageContaining("has no value");
    }
}
