package io.troupe.actor;

import java.util.stream.Collectors;
import jdk.jfr.Category;
import jdk.jfr.Description;
import jdk.jfr.Event;
import jdk.jfr.Label;
import jdk.jfr.Name;
import jdk.jfr.StackTrace;
import jdk.jfr.Timespan;

/** Flight recorder event: one message has occupied a space's thread for too long. */
@Name("io.troupe.Stall")
@Label("Actor Space Stall")
@Category("Troupe")
@Description("One message has held the thread of an actor space for longer than its stall limit")
@StackTrace(false)
final class StallEvent extends Event {
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
