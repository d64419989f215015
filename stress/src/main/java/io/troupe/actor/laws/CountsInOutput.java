package io.troupe.actor.laws;

import java.io.ByteArrayOutputStream;
import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.charset.StandardCharsets;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;

/** Passes on what jcstress prints, and keeps the last line with its counts of results. */
final class CountsInOutput extends FilterOutputStream {
    private static final Pattern COUNTS = Pattern.compile(
            "\\(Results: (\\d+) planned; (\\d+) passed, (\\d+) failed, (\\d+) soft errs, (\\d+) hard errs\\)");

    private final ByteArrayOutputStream line = new ByteArrayOutputStream();
    private @Nullable String last;

    CountsInOutput(OutputStream out) {
        super(out);
    }

    @Override
    public void write(int b) throws IOException {
        out.write(b);
        keep(b);
    }

    @Override
    public void write(byte[] bytes, int offset, int length) throws IOException {
        out.write(bytes, offset, length);
        for (int i = offset; i < offset + length; i++) {
            keep(bytes[i]);
        }
    }

    private void keep(int b) {
        if (b != '\n' && b != '\r') { // a carriage return overwrites a progress line
            line.write(b);
            return;
        }
        Matcher counts = COUNTS.matcher(line.toString(StandardCharsets.UTF_8));
        line.reset();
        while (counts.find()) {
            last = counts.group();
        }
    }

    /** Why the last counts prove nothing, or null if every planned law has passed. */
    @Nullable
    String fault() {
        keep('\n');
        if (last == null) {
            return "no law ran: jcstress counted no results";
        }
        Matcher counts = COUNTS.matcher(last);
        if (!counts.matches()) {
            throw new AssertionError(last);
        }
        long planned = Long.parseLong(counts.group(1));
        long passed = Long.parseLong(counts.group(2));
        if (passed > 0 && passed == planned) {
            return null;
        }
        return "expected that every law passes, got " + last
                + (passed == 0 ? ": no law ran to its end" : "; the errors are in the report");
    }
}
