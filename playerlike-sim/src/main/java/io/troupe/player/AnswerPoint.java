package io.troupe.player;

import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * Tells which {@code isDataReady()} that finds nothing is the one by which a program waits.
 *
 * <p>A false alone does not say that: {@code if (pos.isDataReady()) ..; if (son.isDataReady()) ..} asks for the
 * position in vain and goes on to sonar readings it has not seen. So the program waits where everything was seen
 * before, or where it asks the same device in vain again. That place stays the same until the next frame, and the frame
 * becomes visible there and nowhere else: where in its loop a program meets new data does not depend on how fast
 * anybody is. When a program asks elsewhere, in vain and twice, and not at that place any more, the place moves.
 *
 * <p><b>Threads.</b> None of its own; guarded by the lock of {@link Incoming}.
 */
final class AnswerPoint {
    private final Set<Object> askedInVain = Collections.newSetFromMap(new IdentityHashMap<>());
    private @Nullable Object place;

    /** Whether the program waits in this call, by which it has asked for something that is not there. */
    boolean isAt(Object asked, boolean everythingSeen) {
        boolean waits = asked == place || place == null && everythingSeen || !askedInVain.add(asked);
        if (waits) {
            place = asked;
            askedInVain.clear();
        }
        return waits;
    }

    /** Whether the program has waited since the newest frame. */
    boolean isReached() {
        return place != null;
    }

    /** The program has found something new. */
    void newsTaken() {
        askedInVain.clear();
    }

    /** A frame has become visible. */
    void frameShown() {
        place = null;
        askedInVain.clear();
    }
}
