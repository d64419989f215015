package io.troupe.actor;

import io.troupe.actor.internal.loop.Home;
import org.jspecify.annotations.Nullable;

/**
 * Which handlers of a space the calling thread is running: those of errors and dead letters, and the call observer. A
 * call that a handler sends is marked with them, and so is the turn in which it is handled. So a handler does not
 * receive what it has caused itself: a monitor that has stopped would otherwise be notified of that for ever.
 *
 * <p><b>Threads.</b> The thread of a space keeps its own set; a thread that only acts for a space uses that of the
 * space, so that senders find it without a thread-local; all others use a thread-local.
 */
final class HandlerTurn {
    static final int ERROR = 1;
    static final int DEAD_LETTER = 2;
    static final int OBSERVER = 4;
    static final int ALL = ERROR | DEAD_LETTER | OBSERVER;

    private static final ThreadLocal<@Nullable Integer> OTHERS = new ThreadLocal<>();

    private HandlerTurn() {}

    /** The set of the calling thread; any thread. */
    static int now() {
        if (Thread.currentThread() instanceof SpaceThread own) {
            return own.handlers();
        }
        if (Home.current() instanceof SpaceHome here) {
            return here.handlers;
        }
        Integer handlers = OTHERS.get();
        return handlers == null ? 0 : handlers;
    }

    /** The marks of a call that the calling thread sends to a space; costs the sender no thread-local. */
    static int ofSender(SpaceHome to) {
        if (Thread.currentThread() instanceof SpaceThread own) {
            return own.handlers();
        }
        return to.isCurrent() ? to.handlers : 0;
    }

    static void set(int handlers) {
        if (Thread.currentThread() instanceof SpaceThread own) {
            own.setHandlers(handlers);
        } else if (Home.current() instanceof SpaceHome here) {
            here.handlers = handlers;
        } else if (handlers == 0) {
            OTHERS.remove();
        } else {
            OTHERS.set(handlers);
        }
    }

    /** Runs what was sent by these handlers. */
    static void run(int handlers, Runnable turn) {
        int before = now();
        set(before | handlers);
        try {
            turn.run();
        } finally {
            set(before);
        }
    }
}
