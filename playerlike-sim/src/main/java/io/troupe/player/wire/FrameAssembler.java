package io.troupe.player.wire;

import java.util.ArrayList;
import java.util.List;

/**
 * Makes frames of the messages of a stream: one of each message in push mode, one of all until SYNCH in pull mode.
 *
 * <p><b>Threads.</b> The reader of the stream; only {@link #wantsData} is for any thread.
 */
final class FrameAssembler {
    /** As many as a server keeps for a client. */
    private static final int MOST_MESSAGES = 1024;

    private final List<DataMessage> messages = new ArrayList<>();
    private Delivery mode = Delivery.PUSH;
    private boolean asked;
    private long nextTick;

    /** From here on in the stream; what has come before is a frame of its own. */
    synchronized List<Frame> mode(Delivery newMode) {
        mode = newMode;
        asked = false;
        return messages.isEmpty() ? List.of() : List.of(frame());
    }

    synchronized List<Frame> add(DataMessage message) {
        if (messages.size() == MOST_MESSAGES) {
            messages.removeFirst();
        }
        messages.add(message);
        return mode == Delivery.PUSH ? List.of(frame()) : List.of();
    }

    /** The end of a frame that was asked for; data that were sent earlier, before a reply, belong to it. */
    synchronized List<Frame> synch() {
        asked = false;
        return mode == Delivery.PUSH ? List.of() : List.of(frame());
    }

    /** The question for data was refused, or did not leave this machine: it may be asked again. */
    synchronized void refused() {
        asked = false;
    }

    /** Whether a client that has seen the frame of that tick has to ask for the next one; true once for each. */
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
