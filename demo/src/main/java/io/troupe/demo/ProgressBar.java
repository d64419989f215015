package io.troupe.demo;

import java.io.PrintStream;
import java.util.Locale;
import org.jspecify.annotations.Nullable;

/** A line at the bottom of a terminal that says how far a run is; nothing when there is no terminal. */
final class ProgressBar implements AutoCloseable {
    private static final int WIDTH = 40;

    private final @Nullable PrintStream terminal;
    private final double endSeconds;
    private int shown = -1;

    private ProgressBar(@Nullable PrintStream terminal, double endSeconds) {
        this.terminal = terminal;
        this.endSeconds = endSeconds;
    }

    static ProgressBar onTerminal(double endSeconds) {
        return new ProgressBar(isTerminal() ? System.err : null, endSeconds);
    }

    static ProgressBar hidden() {
        return new ProgressBar(null, 1);
    }

    void show(double seconds) {
        int permille = (int) Math.min(1000, 1000 * seconds / endSeconds);
        if (terminal == null || permille == shown) {
            return;
        }
        shown = permille;
        int full = permille * WIDTH / 1000;
        terminal.printf(
                Locale.ROOT,
                "\r[%s%s] %6.1f of %.1f s",
                "#".repeat(full),
                ".".repeat(WIDTH - full),
                seconds,
                endSeconds);
        terminal.flush();
    }

    /** Lets something else be printed above the bar. */
    void interrupt(Runnable print) {
        close();
        print.run();
    }

    @Override
    public void close() {
        if (terminal != null && shown >= 0) {
            terminal.print("\r\033[K");
            terminal.flush();
            shown = -1;
        }
    }

    /** Since Java 22 there is a console without a terminal too, and a method that tells; before, a console meant a terminal. */
    private static boolean isTerminal() {
        var console = System.console();
        if (console == null) {
            return false;
        }
        try {
            return (Boolean) java.io.Console.class.getMethod("isTerminal").invoke(console);
        } catch (ReflectiveOperationException beforeJava22) {
            return true;
        }
    }
}
