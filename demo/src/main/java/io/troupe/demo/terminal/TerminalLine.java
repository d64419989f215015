package io.troupe.demo.terminal;

import java.io.PrintStream;
import org.jspecify.annotations.Nullable;

/** One line at the bottom of a terminal, written again and again; nothing when standard error is no terminal. */
public final class TerminalLine implements AutoCloseable {
    private final @Nullable PrintStream terminal;
    private String shown = "";

    private TerminalLine(@Nullable PrintStream terminal) {
        this.terminal = terminal;
    }

    public static TerminalLine open() {
        return new TerminalLine(isTerminal() ? System.err : null);
    }

    /** One on a terminal that is known to be one. */
    public static TerminalLine on(PrintStream terminal) {
        return new TerminalLine(terminal);
    }

    /** One that is never seen. */
    public static TerminalLine hidden() {
        return new TerminalLine(null);
    }

    public boolean isVisible() {
        return terminal != null;
    }

    public void show(String text) {
        if (terminal == null || text.equals(shown)) {
            return;
        }
        terminal.print("\r" + text + "\033[K");
        terminal.flush();
        shown = text;
    }

    /** Lets something else be printed where the line is. */
    public void interrupt(Runnable print) {
        close();
        print.run();
    }

    /** Wipes the line; it may be shown again. */
    @Override
    public void close() {
        if (terminal != null && !shown.isEmpty()) {
            terminal.print("\r\033[K");
            terminal.flush();
            shown = "";
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
