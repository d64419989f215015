package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class TurnTest {
    @Test
    void line_isParsedToTheSameTurn() {
        var turn = new Turn(1.0 / 3, 1e12);
        assertThat(Turn.parse(turn.line())).isEqualTo(turn);
    }

    @Test
    void lineWithoutBytes_isNamed() {
        assertThatThrownBy(() -> Turn.parse("15.7"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a turn is \"15.7\", expected nanoseconds and bytes per operation");
    }

    @Test
    void allocatedBytes_growByWhatWasAllocated() {
        long before = Turn.allocatedBytes();
        var garbage = new byte[1_000_000];
        assertThat(Turn.allocatedBytes() - before).isGreaterThanOrEqualTo(garbage.length);
    }
}
