package io.troupe.view.live;

import io.troupe.view.tools.FoxgloveConnection;
import io.troupe.view.tools.FoxgloveConnection.Events;
import io.troupe.view.tools.FoxgloveConnection.Frame;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** What the live page shows, for viewers that are connected by Foxglove's protocol. */
final class FoxgloveSource implements FoxgloveConnection.Source {
    private final ViewBoard board;
    private volatile @Nullable Converted last;

    private record Converted(ViewBoard.Shown from, Frame frame) {}

    FoxgloveSource(ViewBoard board) {
        this.board = board;
    }

    @Override
    public @Nullable Frame newest() {
        ViewBoard.Shown shown = board.newest();
        if (shown == null) {
            return null;
        }
        Converted known = last;
        if (known == null || known.from != shown) {
            var frame = new Frame(shown.world.spec(), shown.frame.snapshot(), services(shown));
            known = new Converted(shown, frame);
            last = known;
        }
        return known.frame;
    }

    private static List<String> services(ViewBoard.Shown shown) {
        List<String> known = shown.world.services();
        List<String> services = new ArrayList<>();
        for (short state : shown.frame.states()) {
            int number = state & 0xFF;
            int index = number - ViewFrame.FIRST_SERVICE;
            services.add(
                    number == ViewFrame.NO_SERVICE
                            ? "none"
                            : index >= 0 && index < known.size() ? known.get(index) : "several");
        }
        return services;
    }

    @Override
    public Events eventsFrom(long number) {
        ViewBoard.Events events = board.eventsFrom(number);
        return new Events(events.last(), events.json());
    }
}
