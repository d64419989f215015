package io.troupe.actor;

import java.util.Arrays;

/**
 * How many callbacks of a space come before its mails, for those mails that came from the inbox while other entries
 * waited. Mails and callbacks are counted since the space was made. On the space's thread.
 */
final class Precedence {
    private static final int FEW = 16;

    private long[] mails = new long[FEW]; // ascending, as the callbacks are
    private long[] callbacks = new long[FEW];
    private int first;
    private int end;
    private long newest;
    private long passed;

    /** So many callbacks come before the mail that comes after so many mails, and before all mails behind it. */
    void note(long mail, long callbacksBefore, long mailsTaken) {
        if (callbacksBefore == newest) {
            return; // the mail in front of it waits for the same
        }
        if (end == mails.length) {
            makeRoom(mailsTaken);
        }
        mails[end] = mail;
        callbacks[end] = callbacksBefore;
        end++;
        newest = callbacksBefore;
    }

    /** How many callbacks come before the mail that comes after so many mails; to be asked with rising numbers only. */
    long callbacksBefore(long mail) {
        while (first < end && mails[first] <= mail) {
            passed = callbacks[first++];
        }
        return passed;
    }

    private void makeRoom(long mailsTaken) {
        callbacksBefore(mailsTaken);
        int size = end - first;
        int length = Math.max(FEW, 2 * size);
        long[] freshCallbacks = Arrays.copyOf(Arrays.copyOfRange(callbacks, first, end), length);
        mails = Arrays.copyOf(Arrays.copyOfRange(mails, first, end), length);
        callbacks = freshCallbacks;
        first = 0;
        end = size;
    }
}
