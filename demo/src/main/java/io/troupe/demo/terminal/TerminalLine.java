package io.troupe.demo.terminal;

import io.troupe.actor.time.Clock;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;

/**
 * Says on standard error how far a command is.
 *
 * <p>On a terminal that is one line, written again a few times a second at most and no wider than the terminal.
 * Elsewhere, and on a terminal that knows no escapes ({@code TERM=dumb}), it is a plain line now and then, so that a
 * log file shows progress too.
 *
 * <p><b>Threads.</b> Any, one at a time.
 */
public final class TerminalLine implements AutoCloseable {
    static final Duration REDRAW = Duration.ofMillis(250);
    /** Between two plain lines, unless the system property {@value #SECONDS_PROPERTY} says otherwise. */
    static final Duration PLAIN = Duration.ofSeconds(10);

    private static final String SECONDS_PROPERTY = "troupe.progress.seconds";
    /** Of the terminal; the start script sets it. */
    private static final String COLUMNS_PROPERTY = "troupe.columns";

    private static final Pattern NUMBERS = Pattern.compile("[0-9.,]+");
    private static final int COLUMNS = 80;
    private static final int LEAST_COLUMNS = 10;

    private enum Kind {
        HIDDEN,
        PLAIN,
        TERMINAL
    }

    private final Kind kind;
    private final @Nullable PrintStream to;
    private final Clock clock;
    private final Duration interval;
    private final int columns;
    private String shown = "";
    private String stage = "";
    private long nextNanos;

    private TerminalLine(Kind kind, @Nullable PrintStream to, Clock clock, Duration interval, int columns) {
        this.kind = kind;
        this.to = to;
        this.clock = clock;
        this.interval = interval;
        this.columns = columns;
        this.nextNanos = clock.nanos() + (kind == Kind.PLAIN ? interval.toNanos() : 0);
    }

    /** On standard error. */
    public static TerminalLine open() {
        Clock clock = Clock.system();
        return isTerminal() && knowsEscapes(System.getenv("TERM"))
                ? onTerminal(System.err, clock, columns())
                : plain(System.err, clock, plainInterval());
    }

    /** On a terminal of so many columns. */
    static TerminalLine onTerminal(PrintStream terminal, Clock clock, int columns) {
        return new TerminalLine(Kind.TERMINAL, terminal, clock, REDRAW, columns);
    }

    /** In plain lines, one an interval. */
    static TerminalLine plain(PrintStream to, Clock clock, Duration interval) {
        return new TerminalLine(Kind.PLAIN, to, clock, interval, Integer.MAX_VALUE);
    }

    /** On a terminal that is known to be one, without a limit on its width. */
    public static TerminalLine on(PrintStream terminal, Clock clock) {
        return onTerminal(terminal, clock, Integer.MAX_VALUE);
    }

    /** One that is never seen. */
    public static TerminalLine hidden() {
        return new TerminalLine(Kind.HIDDEN, null, Clock.system(), REDRAW, COLUMNS);
    }

    public boolean isVisible() {
        return kind != Kind.HIDDEN;
    }

    /** Shows what is going on now; a text that differs from the last one in its numbers only may wait on a terminal. */
    public void show(String text) {
        show(NUMBERS.matcher(text).replaceAll(""), text);
    }

    /**
     * Shows how far a stage is.
     *
     * @param now what is going on; when it changes, a terminal shows it at once
     */
    public void show(String now, String text) {
        if (to == null) {
            return;
        }
        boolean due = clock.nanos() - nextNanos >= 0;
        if (kind == Kind.PLAIN) {
            if (due) {
                to.println("troupe: " + text);
                nextNanos = clock.nanos() + interval.toNanos();
            }
            return;
        }
        String line = text.length() < columns ? text : text.substring(0, columns - 1); // the last column may wrap
        if (line.equals(shown) || !due && now.equals(stage)) {
            return;
        }
        stage = now;
        to.print("\r" + line + "\033[K");
        to.flush();
        shown = line;
        nextNanos = clock.nanos() + interval.toNanos();
    }

    /** Lets something else be printed where the line is. */
    public void interrupt(Runnable print) {
        close();
        print.run();
    }

    /** Wipes the line; it may be shown again. */
    @Override
    public void close() {
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
        String told = System.getProperty(COLUMNS_PROPERTY, System.getenv("COLUMNS"));
        return told != null && told.matches("[1-9]\\d{0,3}") // 0 where a terminal does not know
                ? Math.max(LEAST_COLUMNS, Integer.parseInt(told))
                : COLUMNS;
    }

    /**
     * Whether standard error is a terminal. Where the system shows what a process has open, that decides; elsewhere a
     * console does, which since Java 22 may be there without a terminal.
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
