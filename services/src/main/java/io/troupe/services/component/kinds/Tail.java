package io.troupe.services.component.kinds;

import java.util.ArrayDeque;
import java.util.Deque;

/** The last lines of a process's error output. Any thread. */
final class Tail {
    private static final int LINES = 5;
    private static final int LINE_CHARACTERS = 200;

    private final Deque<String> lines = new ArrayDeque<>(); // guarded by this

    synchronized void add(String line) {
        if (lines.size() == LINES) {
            lines.remove();
        }
        lines.add(line.length() > LINE_CHARACTERS ? line.substring(0, LINE_CHARACTERS) + ".." : line);
    }

    /** The lines joined to one; empty if there are none. */
    synchronized String text() {
        return String.join(" | ", lines).strip();
    }
}
