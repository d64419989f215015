package io.troupe.actor;

import java.util.Arrays;

/**
 * How many callbacks of a space precede its messages, for messages that came from the inbox while other entries were
 * queued. Messages and callbacks are numbered from the creation of the space. On the space's thread.
 */
final class Precedence {
    private static final int FEW = 16;

    private long[] messages = new long[FEW]; // ascending, like the callbacks
    private long[] callbacks = new long[FEW];
    private int first;
    private int end;
    private long newest;
    private long passed;

    /** Records that this number of callbacks precedes the message with that number, and all later messages. */
    void note(long message, long callbacksBefore, long messagesTaken) {
        if (callbacksBefore == newest) {
            return; // the same as for the message before
        }
        if (end == messages.length) {
            makeRoom(messagesTaken);
        }
        messages[end] = message;
        callbacks[end] = callbacksBefore;
        end++;
        newest = callbacksBefore;
    }

    /** The number of callbacks that precede the message with that number; to be called with ascending numbers only. */
    long callbacksBefore(long message) {
        while (first < end && messages[first] <= message) {
            passed = callbacks[first++];
        }
        return passed;
    }

    private void makeRoom(long messagesTaken) {
        callbacksBefore(messagesTaken);
        int size = end - first;
        int length = Math.max(FEW, 2 * size);
        long[] freshCallbacks = Arrays.copyOf(Arrays.copyOfRange(callbacks, first, end), length);
        messages = Arrays.copyOf(Arrays.copyOfRange(messages, first, end), length);
        callbacks = freshCallbacks;
        first = 0;
        end = size;
    }
}
