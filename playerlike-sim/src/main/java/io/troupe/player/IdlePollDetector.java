package io.troupe.player;

import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * Decides which unsuccessful {@code isDataReady()} call counts as the program waiting for the next frame.
 *
 * <p>An unsuccessful call alone is not enough. In {@code if (pos.isDataReady()) ..; if (son.isDataReady()) ..} the
 * position poll may return false although unread sonar data follow. The program waits in a call if it has already seen
 * all data, or if it polls the same device unsuccessfully for the second time. That device stays the waiting point
 * until the next frame, and the next frame becomes visible only in a call for that device. So the place in a program's
 * loop where new data appear does not depend on the speed of any thread. If the program later polls another device
 * unsuccessfully twice, and no longer the waiting point, that device becomes the waiting point.
 *
 * <p><b>Threads.</b> Not thread-safe; guarded by the lock of {@link ClientInbox}.
 */
final class IdlePollDetector {
    private final Set<Object> unsuccessfulPolls = Collections.newSetFromMap(new IdentityHashMap<>());
    private @Nullable Object waitingPoint;

    /** True if the program waits in this unsuccessful call. */
    boolean isWaiting(Object polled, boolean everythingSeen) {
        boolean waits =
                polled == waitingPoint || waitingPoint == null && everythingSeen || !unsuccessfulPolls.add(polled);
        if (waits) {
            waitingPoint = polled;
            unsuccessfulPolls.clear();
        }
        return waits;
    }

    /** True if the program has waited since the newest frame. */
    boolean hasWaited() {
        return waitingPoint != null;
    }

    /** The program has read new data. */
    void dataRead() {
        unsuccessfulPolls.clear();
    }

    /** A frame has become visible. */
    void frameShown() {
        waitingPoint = null;
        unsuccessfulPolls.clear();
    }
}
