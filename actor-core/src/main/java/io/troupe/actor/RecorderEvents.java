package io.troupe.actor;

import java.util.stream.Collectors;
import jdk.jfr.Category;
import jdk.jfr.Description;
import jdk.jfr.Event;
import jdk.jfr.Label;
import jdk.jfr.Name;
import jdk.jfr.StackTrace;
import jdk.jfr.Timespan;
import org.jspecify.annotations.Nullable;

/** The flight recorder events of a space. */
final class RecorderEvents {
    private RecorderEvents() {}

    /** Flight recorder event: a message was not delivered. */
    @Name("io.troupe.DeadLetter")
    @Label("Dead Letter")
    @Category("Troupe")
    @StackTrace(false)
    static final class DeadLetterEvent extends Event {
        @Label("Space")
        final String space;

        @Label("Receiver")
        final String receiver;

        @Label("Message")
        final String message;

        @Label("Reason")
        final String reason;

        DeadLetterEvent(String space, DeadLetter letter) {
            this.space = space;
            this.receiver = letter.actor();
            this.message = letter.message();
            this.reason = letter.reason();
        }
    }

    /** Flight recorder event: an exception without a caller to receive it. */
    @Name("io.troupe.Error")
    @Label("Actor Error")
    @Category("Troupe")
    @Description("What a one-way message, a timer or a task threw, or a rejection without a listener")
    @StackTrace(false)
    static final class ErrorEvent extends Event {
        @Label("Space")
        final String space;

        @Label("Where")
        final String where;

        @Label("Error")
        final String error;

        ErrorEvent(String space, String where, Throwable error) {
            this.space = space;
            this.where = where;
            this.error = error.getClass().getName() + ": " + text(error);
        }

        private static @Nullable String text(Throwable error) {
            try {
                return error.getMessage();
            } catch (Throwable broken) {
                return "its text cannot be made: " + broken.getClass().getName();
            }
        }
    }

    /** Flight recorder event: the metrics of a space, recorded periodically. */
    @Name("io.troupe.SpaceFigures")
    @Label("Actor Space Figures")
    @Category("Troupe")
    @Description("The values of SpaceMetrics, at every look of the stall watchdog")
    @StackTrace(false)
    static final class SpaceFiguresEvent extends Event {
        @Label("Space")
        @Nullable
        String space;

        @Label("Served")
        long served;

        @Label("Waiting")
        long waiting;

        @Label("Latency")
        @Timespan(Timespan.NANOSECONDS)
        long latencyNanos;

        @Label("Actors")
        int actors;

        @Label("Timers")
        int timers;

        @Label("Errors")
        long errors;

        @Label("Dead Letters")
        long deadLetters;

        @Label("Abandoned Requests")
        long abandoned;

        @Label("Expired Time Limits")
        long expired;

        void fill(SpaceHome from) {
            SpaceMetrics metrics = from.figures();
            space = from.toString();
            served = metrics.served();
            waiting = metrics.waiting();
            latencyNanos = metrics.latency().toNanos();
            actors = metrics.actors();
            timers = metrics.timers();
            errors = metrics.errors();
            deadLetters = metrics.deadLetters();
            abandoned = metrics.abandoned();
            expired = metrics.expired();
        }
    }

    /** Flight recorder event: one message has occupied a space's thread for too long. */
    @Name("io.troupe.Stall")
    @Label("Actor Space Stall")
    @Category("Troupe")
    @Description("One message has held the thread of an actor space for longer than its stall limit")
    @StackTrace(false)
    static final class StallEvent extends Event {
        @Label("Space")
        final String space;

        @Label("At Least")
        @Timespan(Timespan.NANOSECONDS)
        final long atLeastNanos;

        @Label("Stack")
        final String stack;

        StallEvent(Stall stall) {
            this.space = stall.space();
            this.atLeastNanos = stall.atLeast().toNanos();
            this.stack = stall.stack().stream().map(StackTraceElement::toString).collect(Collectors.joining("\n"));
        }
    }
}
