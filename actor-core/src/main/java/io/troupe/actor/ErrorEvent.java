package io.troupe.actor;

import jdk.jfr.Category;
import jdk.jfr.Description;
import jdk.jfr.Event;
import jdk.jfr.Label;
import jdk.jfr.Name;
import jdk.jfr.StackTrace;
import org.jspecify.annotations.Nullable;

/** Flight recorder event: an exception without a caller to receive it. */
@Name("io.troupe.Error")
@Label("Actor Error")
@Category("Troupe")
@Description("What a one-way message, a timer or a task threw, or a rejection nobody listens to")
@StackTrace(false)
final class ErrorEvent extends Event {
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
