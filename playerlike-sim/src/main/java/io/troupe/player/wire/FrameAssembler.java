package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;

/**
 * Assembles the DATA messages of a stream into frames: one per message in push mode, one per SYNCH in pull mode.
 *
 * <p><b>Threads.</b> The thread that reads the stream; only {@link #wantsData} may be called from any thread.
 */
final class FrameAssembler {
    /** The same bound as a server's queue for a client. */
    private static final int MAX_MESSAGES = 1024;

    private final List<DeviceDataMessage> messages = new ArrayList<>();
    private Delivery mode = Delivery.PUSH;
    private boolean asked;
    private long nextTick;

    /** Switches the mode at this place in the stream; messages collected before form a separate frame. */
    synchronized List<Frame> mode(Delivery newMode) {
        mode = newMode;
        asked = false;
        return messages.isEmpty() ? List.of() : List.of(frame());
    }

    synchronized List<Frame> add(DeviceDataMessage message) {
        if (messages.size() == MAX_MESSAGES) {
            messages.removeFirst();
        }
        messages.add(message);
        return mode == Delivery.PUSH ? List.of(frame()) : List.of();
    }

    /** Ends a requested frame; data that were sent earlier, before a reply, belong to it. */
    synchronized List<Frame> synch() {
        asked = false;
        return mode == Delivery.PUSH ? List.of() : List.of(frame());
    }

    /** The request for data was refused or not sent; it may be repeated. */
    synchronized void refused() {
        asked = false;
    }

    /** True if a client that has seen the frame of that tick must request the next one; true once per frame. */
    synchronized boolean wantsData(long tick) {
        if (mode == Delivery.PUSH || asked || tick < nextTick - 1) {
            return false;
        }
        asked = true;
        return true;
    }

    synchronized Delivery mode() {
        return mode;
    }

    private Frame frame() {
        double time = messages.isEmpty() ? 0 : messages.getLast().timeSeconds();
        var frame = new Frame(nextTick++, time, messages);
        messages.clear();
        return frame;
    }
}
