package io.troupe.demo;

import io.troupe.demo.terminal.Interruption;
import io.troupe.tools.ProgressLine;
import io.troupe.view.RecordedHostedRun;
import io.troupe.view.RecordedRun;
import java.util.Locale;
import java.util.function.Consumer;

/** The progress of a run: a bar on the last line of a terminal, or an occasional line in a log file. */
final class ProgressBar implements AutoCloseable {
    private final ProgressLine line;
    private final String label;
    private final double endSeconds;
    private int shown = -1;

    private ProgressBar(ProgressLine line, String label, double endSeconds) {
        this.line = line;
        this.label = label;
        this.endSeconds = endSeconds;
    }

    static ProgressBar onTerminal(double endSeconds) {
        return onTerminal("", endSeconds);
    }

    /** Creates a bar with a label in front of it. */
    static ProgressBar onTerminal(String label, double endSeconds) {
        return new ProgressBar(ProgressLine.open(), label, endSeconds);
    }

    /**
     * Shows the progress of a run, and ends it when the user interrupts the command.
     *
     * @param changes is called with a line of text for every state change
     */
    RecordedRun.Listener listener(Consumer<String> changes, Interruption interruption) {
        return new RecordedRun.Listener() {
            @Override
            public void stateStarted(String change) {
                changes.accept(change);
            }

            @Override
            public void ticked(long timeMicros) {
                show(timeMicros / 1e6);
            }

            @Override
            public boolean isStopRequested() {
                return interruption.isRequested();
            }
        };
    }

    /** The same for a run over hosts; {@code changes} is also called for every change of a driver. */
    RecordedHostedRun.Listener hostedListener(Consumer<String> changes, Interruption interruption) {
        RecordedRun.Listener inner = listener(changes, interruption);
        return new RecordedHostedRun.Listener() {
            @Override
            public void stateStarted(String change) {
                inner.stateStarted(change);
            }

            @Override
            public void driverChanged(String change) {
                changes.accept(change);
            }

            @Override
            public void ticked(long timeMicros) {
                inner.ticked(timeMicros);
            }

            @Override
            public boolean isStopRequested() {
                return inner.isStopRequested();
            }
        };
    }

    private void show(double seconds) {
        int permille = (int) Math.min(1000, 1000 * seconds / endSeconds);
        if (!line.isVisible() || permille == shown) {
            return;
        }
        shown = permille;
        line.show(
                label,
                String.format(
                        Locale.ROOT,
                        "%s%s %6.1f of %.1f s",
                        label,
                        ProgressLine.bar(permille / 1000.0),
                        seconds,
                        endSeconds));
    }

    /** Prints other output above the bar. */
    void interrupt(Runnable print) {
        line.interrupt(print);
        shown = -1;
    }

    @Override
    public void close() {
        line.close();
    }
}
