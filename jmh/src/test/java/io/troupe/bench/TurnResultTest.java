package io.troupe.bench;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import org.junit.jupiter.api.Test;

class TurnResultTest {
    @Test
    void line_isParsedToTheSameTurn() {
        var turn = new TurnResult(1.0 / 3, 1e12);
        assertThat(TurnResult.parse(turn.line())).isEqualTo(turn);
    }

    @Test
    void lineWithoutBytes_isNamed() {
        assertThatThrownBy(() -> TurnResult.parse("15.7"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a turn is \"15.7\", expected nanoseconds and bytes per operation");
    }

    @Test
    void allocatedBytes_growByWhatWasAllocated() {
        long before = TurnResult.allocatedBytes();
        var garbage = new byte[1_000_000];
        assertThat(TurnResult.allocatedBytes() - before).isGreaterThanOrEqualTo(garbage.length);
    }
}
