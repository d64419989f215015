package io.troupe.demo.evaluate;

import io.troupe.actor.Clock;
import io.troupe.common.text.Plural;
import io.troupe.tools.ProgressLine;
import java.util.Locale;

/** Shows the progress of an evaluation and the estimated remaining time on the last line of a terminal. */
final class EvaluationProgress implements AutoCloseable {
    private final ProgressLine line;
    private final Clock clock;
    private final long beganNanos;
    private double expected = 1;
    private double done;
    private String doing = "";

    EvaluationProgress(ProgressLine line) {
        this(line, Clock.system());
    }

    /** @param clock for the estimate of the remaining time */
    EvaluationProgress(ProgressLine line, Clock clock) {
        this.line = line;
        this.clock = clock;
        this.beganNanos = clock.nanos();
    }

    /** Sets the total amount of work, in any unit. */
    void expect(double amount) {
        expected = amount;
    }

    void warmsUp(int cores) {
        show("warming up, told " + Plural.of(cores, "core"));
    }

    void begins(Job job, int cores) {
        show(job.title() + ", told " + Plural.of(cores, "core"));
    }

    /** Reports the completed part of the current job. May be called by any thread, one at a time. */
    void within(double amount) {
        show(Math.min(1, (done + amount) / expected));
    }

    void ended(double amount) {
        done += amount;
    }

    private void show(String what) {
        doing = what;
        show(Math.min(1, done / expected));
    }

    private void show(double share) {
        if (!line.isVisible()) {
            return;
        }
        line.show(
                doing,
                String.format(
                        Locale.ROOT, "%s %3.0f %%%s  %s", ProgressLine.bar(share), 100 * share, left(share), doing));
    }

    private String left(double share) {
        if (share < 0.02) {
            return "";
        }
        double passed = (clock.nanos() - beganNanos) / 1e9;
        return String.format(Locale.ROOT, ", %.0f s left", passed * (1 - share) / share);
    }

    @Override
    public void close() {
        line.close();
    }
}
