package io.troupe.actor;

import jdk.jfr.Category;
import jdk.jfr.Description;
import jdk.jfr.Event;
import jdk.jfr.Label;
import jdk.jfr.Name;
import jdk.jfr.StackTrace;
import jdk.jfr.Timespan;
import org.jspecify.annotations.Nullable;

/** Flight recorder event: the metrics of a space, recorded periodically. */
@Name("io.troupe.SpaceFigures")
@Label("Actor Space Figures")
@Category("Troupe")
@Description("What SpaceMetrics says, at every look of the stall watchdog")
@StackTrace(false)
final class SpaceFiguresEvent extends Event {
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
    }
}
