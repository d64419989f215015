package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.api.Test;

class ViewBoardTest {
    private final ViewBoard board = new ViewBoard();

    @Test
    void newestEvents_areKept_andANewWorldHasNone() {
        int all = ViewBoard.MOST_EVENTS + 3;
        for (int number = 0; number < all; number++) {
            board.event("e" + number);
        }
        var kept = board.eventsFrom(0);
        assertThat(kept.first()).isEqualTo(3);
        assertThat(kept.last()).isEqualTo(all);
        assertThat(kept.json())
                .hasSize(ViewBoard.MOST_EVENTS)
                .startsWith("e3", "e4")
                .endsWith("e" + (all - 1));
        assertThat(board.eventsFrom(all - 2).json()).containsExactly("e" + (all - 2), "e" + (all - 1));
        assertThat(board.eventsFrom(all).json()).isEmpty();
        assertThat(board.eventsFrom(all + 5).json()).isEmpty();

        board.world(new ViewedWorld(LiveRuns.ARENA.world(), List.of(), List.of()));
        assertThat(board.eventsFrom(0).json()).isEmpty();
        board.event("next");
        assertThat(board.eventsFrom(0)).isEqualTo(new ViewBoard.Events(all, all + 1, List.of("next")));
    }
}
