package io.troupe.tools;

import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.function.LongSupplier;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;

/**
 * The progress line of a program, on standard error.
 *
 * <p>On a terminal it is one line, rewritten at most a few times a second and never wider than the terminal. Elsewhere,
 * and on a terminal without escape sequences ({@code TERM=dumb}), it is an occasional plain line, so that a log file
 * shows the progress too.
 *
 * <p><b>Threads.</b> Any thread.
 */
public final class ProgressLine implements AutoCloseable {
    static final Duration REDRAW = Duration.ofMillis(250);
    /** Interval of plain lines, unless the system property {@value #SECONDS_PROPERTY} is set. */
    static final Duration PLAIN = Duration.ofSeconds(10);

    private static final String SECONDS_PROPERTY = "troupe.progress.seconds";
    /** Width of the terminal; set by the start script. */
    private static final String COLUMNS_PROPERTY = "troupe.columns";

    private static final Pattern NUMBERS = Pattern.compile("[0-9.,]+");
    private static final int COLUMNS = 80;
    private static final int BAR = 30;
    private static final int LEAST_COLUMNS = 10;

    private enum Kind {
        HIDDEN,
        PLAIN,
        TERMINAL
    }

    private final Kind kind;
    private final @Nullable PrintStream to;
    private final LongSupplier nanoClock;
    private final Duration interval;
    private final int columns;
    private String shown = "";
    private String stage = "";
    private long nextNanos;

    private ProgressLine(Kind kind, @Nullable PrintStream to, LongSupplier nanoClock, Duration interval, int columns) {
        this.kind = kind;
        this.to = to;
        this.nanoClock = nanoClock;
        this.interval = interval;
        this.columns = columns;
        this.nextNanos = nanoClock.getAsLong() + (kind == Kind.PLAIN ? interval.toNanos() : 0);
    }

    /** Opens the line on standard error. */
    public static ProgressLine open() {
        return isTerminal() && knowsEscapes(System.getenv("TERM"))
                ? onTerminal(System.err, System::nanoTime, columns())
                : plain(System.err, System::nanoTime, plainInterval());
    }

    /** Creates a line on a terminal of the given width. */
    static ProgressLine onTerminal(PrintStream terminal, LongSupplier nanoClock, int columns) {
        return new ProgressLine(Kind.TERMINAL, terminal, nanoClock, REDRAW, columns);
    }

    /** Creates a line that prints plain text once per interval. */
    static ProgressLine plain(PrintStream to, LongSupplier nanoClock, Duration interval) {
        return new ProgressLine(Kind.PLAIN, to, nanoClock, interval, Integer.MAX_VALUE);
    }

    /**
     * Creates a line on a stream that is known to be a terminal, without a limit on its width.
     *
     * @param nanoClock a clock in nanoseconds that never goes back
     */
    public static ProgressLine on(PrintStream terminal, LongSupplier nanoClock) {
        return onTerminal(terminal, nanoClock, Integer.MAX_VALUE);
    }

    /** Creates a line that prints nothing. */
    public static ProgressLine hidden() {
        return new ProgressLine(Kind.HIDDEN, null, System::nanoTime, REDRAW, COLUMNS);
    }

    public boolean isVisible() {
        return kind != Kind.HIDDEN;
    }

    /**
     * Shows the current activity. On a terminal, a text that differs from the previous one only in its numbers may be
     * delayed.
     */
    public synchronized void show(String text) {
        show(NUMBERS.matcher(text).replaceAll(""), text);
    }

    /**
     * Shows the progress of a stage.
     *
     * @param now the current activity; a terminal shows a change of it at once
     */
    public synchronized void show(String now, String text) {
        if (to == null) {
            return;
        }
        boolean due = nanoClock.getAsLong() - nextNanos >= 0;
        if (kind == Kind.PLAIN) {
            if (due) {
                to.println("troupe: " + text);
                nextNanos = nanoClock.getAsLong() + interval.toNanos();
            }
            return;
        }
        String line = text.length() < columns ? text : text.substring(0, columns - 1); // a full last column may wrap
        if (line.equals(shown) || !due && now.equals(stage)) {
            return;
        }
        stage = now;
        to.print("\r" + line + "\033[K");
        to.flush();
        shown = line;
        nextNanos = nanoClock.getAsLong() + interval.toNanos();
    }

    /** A bar of fixed width for a share from 0 to 1. */
    public static String bar(double share) {
        int full = (int) (share * BAR);
        return "[" + "#".repeat(full) + ".".repeat(BAR - full) + "]";
    }

    /** Prints other output in place of the line. */
    public synchronized void interrupt(Runnable print) {
        close();
        print.run();
    }

    /** Erases the line; it may be shown again. */
    @Override
    public synchronized void close() {
        if (to != null && !shown.isEmpty()) {
            to.print("\r\033[K");
            to.flush();
            shown = "";
            stage = "";
        }
    }

    static boolean knowsEscapes(@Nullable String term) {
        return term == null || !term.equals("dumb");
    }

    private static Duration plainInterval() {
        Double seconds = Double.valueOf(System.getProperty(SECONDS_PROPERTY, "" + PLAIN.toSeconds()));
        return Duration.ofMillis(Math.round(seconds * 1000));
    }

    private static int columns() {
        String width = System.getProperty(COLUMNS_PROPERTY, System.getenv("COLUMNS"));
        return width != null && width.matches("[1-9]\\d{0,3}") // 0 if the terminal does not know its width
                ? Math.max(LEAST_COLUMNS, Integer.parseInt(width))
                : COLUMNS;
    }

    /**
     * Whether standard error is a terminal. This is decided by the list of open files of the process, where the system
     * provides it. Otherwise by the presence of a console, which since Java 22 may exist without a terminal.
     */
    private static boolean isTerminal() {
        try {
            String open = Files.readSymbolicLink(Path.of("/proc/self/fd/2")).toString();
            return open.startsWith("/dev/pts/") || open.startsWith("/dev/tty") || open.equals("/dev/console");
        } catch (IOException | UnsupportedOperationException | InvalidPathException elsewhere) {
            return hasConsole();
        }
    }

    private static boolean hasConsole() {
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
