package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;

/**
 * Assembles the DATA messages of a stream into frames: one per message in push mode, one per SYNCH in pull mode. In
 * pull mode a server sends waiting data before a reply, too. If no data were requested, no SYNCH follows them, and they
 * are a separate frame: the client's next request for data answers it.
 *
 * <p><b>Threads.</b> The thread that reads the stream; only {@link #wantsData} may be called from any thread.
 */
final class FrameAssembler {
    /** The same bound as a server's queue for a client. */
    private static final int MAX_MESSAGES = 1024;

    private final List<DeviceDataMessage> messages = new ArrayList<>();
    private Delivery mode = Delivery.PUSH;
    private boolean asked;
    private boolean granted; // the server has received the request for data; a SYNCH will follow
    private long nextTick;

    /** Switches the mode at this place in the stream; messages collected before form a separate frame. */
    synchronized List<Frame> mode(Delivery newMode) {
        mode = newMode;
        asked = false;
        granted = false;
        return messages.isEmpty() ? List.of() : List.of(frame());
    }

    synchronized List<Frame> add(DeviceDataMessage message) {
        if (messages.size() == MAX_MESSAGES) {
            messages.removeFirst();
        }
        messages.add(message);
        return mode == Delivery.PUSH ? List.of(frame()) : List.of();
    }

    /** A reply has arrived: data before it were not requested. */
    synchronized List<Frame> reply() {
        return mode == Delivery.PUSH || granted || messages.isEmpty() ? List.of() : List.of(frame());
    }

    /** The reply to the request for data has arrived; the data follow. */
    synchronized List<Frame> granted() {
        List<Frame> early = reply();
        granted = true;
        return early;
    }

    /** Ends a requested frame. */
    synchronized List<Frame> synch() {
        asked = false;
        granted = false;
        return mode == Delivery.PUSH ? List.of() : List.of(frame());
    }

    /** The request for data was refused or not sent; it may be repeated. */
    synchronized void refused() {
        asked = false;
        granted = false;
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
