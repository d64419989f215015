package io.troupe.actor;

import io.troupe.actor.RecorderEvents.DeadLetterEvent;
import io.troupe.actor.RecorderEvents.ErrorEvent;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.ArrayDeque;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CancellationException;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;

/**
 * Reports and counts a space's unhandled errors and dead letters. Any thread.
 *
 * <p>A promise is settled, and a callback ended, before anything is reported: a text that cannot be made loses no
 * outcome. What a handler sends is marked ({@link HandlerTurn}), so that no handler receives what it has caused.
 */
final class Reports {
    /**
     * What failed, in words that end before the name of an actor or a space. Objects, not string constants: the first
     * use of a constant allocates, and these are reported when memory may be short.
     */
    enum Trouble {
        AN_ENTRY("an entry of space"),
        A_TASK("a task of space"),
        A_DELAY("a delay requested by another thread, in space"),
        A_SEQUENTIAL_BODY("a sequential body"),
        A_REJECTION("a rejected promise without a listener:"),
        A_STEP_OF_THE_END("the end of space"),
        THE_DEAD_LETTER_HANDLER("the dead-letter handler, about"),
        THE_END_OF_A_CALLBACK("the end of a callback argument of"),
        THE_END_OF_A_REQUEST("the rejection of a request of"),
        THE_LOOP("the loop of space"),
        THE_LOOP_WHICH_ENDS("the loop, which cannot go on: closed is space"),
        THE_OBSERVER("the call observer of"),
        THE_SUPERVISION("the supervision of"),
        THE_WATCHDOG("the watchdog of space"),
        STOPPED("stopped() of"),
        TURNING_AWAY("rejecting what waited in space");

        private final String words;

        Trouble(String words) {
            this.words = words;
        }

        @Override
        public String toString() {
            return words;
        }
    }

    private static final System.Logger LOG = System.getLogger(ActorSpace.class.getName());
    // no constants of the compiler: the first use of those allocates
    private static final String OF = String.valueOf(" of");
    private static final String NOTHING = String.valueOf("");
    private static final String SPACE = String.valueOf(" ");

    private final SpaceHome space;
    private final SpaceSettings settings;
    private final AtomicLong errors = new AtomicLong(); // never allocates
    private final LongAdder deadLetters = new LongAdder();
    private final LongAdder abandoned = new LongAdder();
    private final LongAdder expired = new LongAdder();

    Reports(SpaceHome space, SpaceSettings settings) {
        this.space = space;
        this.settings = settings;
    }

    long errors() {
        return errors.get();
    }

    long deadLetters() {
        return deadLetters.sum();
    }

    long abandoned() {
        return abandoned.sum();
    }

    long expired() {
        return expired.sum();
    }

    /** Counts a time limit that has passed. */
    void limitExpired() {
        expired.increment();
    }

    /** Reports an error to the space's handler: see {@link #failed}. */
    void error(Object what, Object whose, Throwable error) {
        report(what, NOTHING, whose, error, null);
    }

    /** Reports an error to the actor's handler if it has one: see {@link #failed}. */
    void report(Trouble trouble, Object whose, Throwable error, @Nullable ErrorHandler first) {
        report(trouble, NOTHING, whose, error, first);
    }

    /**
     * Reports an error to the actor's handler if it has one, else to the space's. Never throws, whatever the error is
     * and whatever handlers throw, because the thread of the space depends on it. If there is no memory even for the
     * log, the error is only counted. An error in what an error handler has sent goes to the log, not to a handler.
     *
     * @param what what failed: a call, or its text
     * @param first the handler of the actor
     */
    void failed(Object what, Object whose, Throwable error, @Nullable ErrorHandler first) {
        report(what, OF, whose, error, first);
    }

    private void report(Object what, String of, Object whose, Throwable error, @Nullable ErrorHandler first) {
        try {
            errors.incrementAndGet();
            String where = place(what, of, whose);
            try {
                new ErrorEvent(settings.name(), where, error).commit();
            } finally {
                handle(first != null ? first : settings.onError(), where, error);
            }
        } catch (Throwable broken) {
            logBrokenHandler(what, error, broken);
        }
    }

    /** The place of an error in words; if there is no memory for that, without the name. */
    private static String place(Object what, String of, Object whose) {
        String words = Message.methodOrWords(what);
        try {
            return words.concat(of).concat(SPACE).concat(whose.toString());
        } catch (Throwable noText) {
            return words;
        }
    }

    private void handle(ErrorHandler handler, String where, Throwable error) throws Exception {
        int before = HandlerTurn.now();
        if ((before & HandlerTurn.ERROR) != 0) {
            LOG.log(System.Logger.Level.ERROR, "in " + where, error);
            return;
        }
        TurnOwner owner = beginHandler(before | HandlerTurn.ERROR);
        try {
            handler.handle(where, error);
        } finally {
            endHandler(owner, before);
        }
    }

    /**
     * Begins a handler's part of the current turn, on the space's own behalf; from any thread.
     *
     * @return the owner of the turn; null on other threads than the space's
     */
    private @Nullable TurnOwner beginHandler(int handlers) {
        HandlerTurn.set(handlers);
        if (!space.isCurrent()) {
            return null;
        }
        TurnOwner before = space.owner();
        space.beginForItself();
        return before;
    }

    private void endHandler(@Nullable TurnOwner owner, int handlersBefore) {
        HandlerTurn.set(handlersBefore);
        if (owner != null) {
            space.begin(owner);
        }
    }

    private void logBrokenHandler(Object what, Throwable error, Throwable broken) {
        try {
            if (broken != error) { // a handler may throw the error that it received
                broken.addSuppressed(error);
            }
            LOG.log(
                    System.Logger.Level.ERROR,
                    "the error handler of space " + settings.name() + " threw about " + Message.methodOrWords(what),
                    broken);
        } catch (Throwable again) {
            // the log fails too, or there is no memory: the error was counted
        }
    }

    /** Reports a dead letter; one that a dead-letter handler has caused is only counted. Never throws. */
    void deadLetter(DeadLetter letter) {
        try {
            deadLetters.increment();
            try {
                new DeadLetterEvent(settings.name(), letter).commit();
            } finally {
                handle(letter);
            }
        } catch (Throwable broken) { // for example an AssertionError in a test
            error(Trouble.THE_DEAD_LETTER_HANDLER, letter, broken);
        }
    }

    private void handle(DeadLetter letter) {
        int before = HandlerTurn.now();
        if ((before & HandlerTurn.DEAD_LETTER) != 0) {
            return;
        }
        TurnOwner owner = beginHandler(before | HandlerTurn.DEAD_LETTER);
        try {
            settings.onDeadLetter().accept(letter);
        } finally {
            endHandler(owner, before);
        }
    }

    /**
     * Rejects a call that no actor will handle: notifies its sender, and the callbacks among its arguments. Throws
     * nothing, except at the end of the caller's stack.
     */
    void rejectCall(QueueEntry call, ActorCell cell, String reason, Throwable error) {
        if (call instanceof Request<?> request) {
            reject(request, error);
        } else {
            lose(call, cell, reason);
        }
        endCallbacks(call, error);
        logArguments(call, reason);
    }

    private void lose(QueueEntry call, ActorCell cell, String reason) {
        DeadLetter letter;
        try {
            var arguments = Collections.unmodifiableList(Arrays.asList(Message.argumentsOf(call)));
            letter = new DeadLetter(cell.toString(), call.toString(), arguments, reason);
        } catch (Throwable noText) {
            error(Trouble.TURNING_AWAY, space, noText);
            return;
        }
        deadLetter(letter);
    }

    /** Rejects a request; false if it was settled. Throws nothing. */
    boolean reject(Request<?> request, Throwable error) {
        try {
            return request.reject(error);
        } catch (Throwable broken) { // a dependent of a future, or no memory
            error(Trouble.THE_END_OF_A_REQUEST, space, broken);
            return true;
        }
    }

    /** Counts a request that was cancelled or given up before it began, and ends its callbacks. */
    void skip(Request<?> request) {
        abandoned.increment();
        Throwable error;
        try {
            error = new CancellationException(request.name() + " was cancelled or given up before it began");
        } catch (Throwable noText) {
            error = noText;
        }
        endCallbacks(request, error);
    }

    /** Ends each callback among the arguments of a call, whatever the others do. */
    private void endCallbacks(QueueEntry call, Throwable error) {
        try {
            for (Object argument : Message.argumentsOf(call)) {
                if (argument instanceof ReturningCallback<?> callback) {
                    end(callback, error);
                }
            }
        } catch (Throwable noMemory) {
            error(Trouble.THE_END_OF_A_CALLBACK, space, noMemory);
        }
    }

    private void end(ReturningCallback<?> callback, Throwable error) {
        try {
            callback.abandon(error);
        } catch (Throwable broken) {
            error(Trouble.THE_END_OF_A_CALLBACK, space, broken);
        }
    }

    /**
     * Logs the arguments of a call that was not answered, at the level DEBUG only: they may be secret, and their texts
     * are the user's code. On the space's thread, last of all.
     */
    void logArguments(QueueEntry call, String why) {
        try {
            if (LOG.isLoggable(System.Logger.Level.DEBUG)) {
                LOG.log(
                        System.Logger.Level.DEBUG,
                        Message.methodOrWords(call) + ", " + why + ": its arguments were "
                                + Message.argumentsInWords(call));
            }
        } catch (Throwable broken) {
            // the call was rejected, and its text is only for debugging
        }
    }

    /** Like {@link #logArguments}, from the thread of a timer. */
    void logArgumentsOfLate(QueueEntry call) {
        try {
            if (LOG.isLoggable(System.Logger.Level.DEBUG)) {
                space.enqueueMessage(new Entry(() -> logArguments(call, "not answered in time"), () -> {}));
            }
        } catch (Throwable broken) {
            // as there
        }
    }

    /** The promises that were rejected without a listener, until they are reported. On the space's thread. */
    static final class Rejections {
        private record Lost(Promise<?> promise, Throwable error) {}

        private static final long GRACE_NANOS = 1_000_000_000;

        private final TimerWheel timers;
        private final Reports reports;
        private final ArrayDeque<Lost> lost = new ArrayDeque<>();
        private final Map<Promise<?>, Throwable> held = new LinkedHashMap<>();

        Rejections(TimerWheel timers, Reports reports) {
            this.timers = timers;
            this.reports = reports;
        }

        void add(Promise<?> promise, Throwable error) {
            lost.add(new Lost(promise, error));
        }

        /** Keeps a rejection for a while, because its caller on another thread may be about to register a listener. */
        void hold(Promise<?> promise, Throwable error) {
            held.put(promise, error);
            timers.set(() -> release(promise), GRACE_NANOS, 0);
        }

        private void release(Promise<?> promise) {
            Throwable error = held.remove(promise);
            if (error != null) {
                add(promise, error);
            }
        }

        void releaseAll() {
            List.copyOf(held.keySet()).forEach(this::release);
        }

        /** Reports the promises that still have no listener. */
        void report() {
            for (int left = lost.size(); left > 0; left--) {
                Lost next = lost.remove();
                if (!Promise.isHandled(next.promise)) {
                    reports.rejected(next.promise, next.error);
                }
            }
        }
    }

    /** Reports a promise that was rejected without a listener. */
    void rejected(Promise<?> promise, Throwable error) {
        error(Trouble.A_REJECTION, promise instanceof Request<?> request ? new NameOf(request) : promise, error);
    }

    /** The text of a request without its outcome, made when it is needed. */
    private record NameOf(Request<?> request) {
        @Override
        public String toString() {
            return request.name();
        }
    }
}
