package io.troupe.actor.laws;

import java.io.ByteArrayOutputStream;
import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.io.PrintStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;
import org.openjdk.jcstress.Main;

/**
 * Runs jcstress with the given arguments, and fails unless every law (jcstress test) passed. After {@code --log FILE}
 * as the first two arguments its output goes to that file, and one line is printed.
 *
 * <p><b>Errors.</b> jcstress itself fails only on a forbidden outcome. Its exit status is also 0 when laws ended in an
 * error, for example on a JVM that cannot load them, and when no law ran at all. In these cases the exit status of this
 * program is 1.
 */
public final class LawsMain {
    /** Runs laws and prints to {@link System#out}, as jcstress does. */
    @FunctionalInterface
    interface Runner {
        void run(String[] arguments) throws Exception;
    }

    private LawsMain() {}

    public static void main(String[] arguments) throws Exception {
        String fault = runLogged(arguments, Main::main);
        if (fault != null) {
            System.err.println("laws: " + fault);
            System.exit(1);
        }
    }

    /** As {@link #run}; a fault and an error name the log. */
    static @Nullable String runLogged(String[] arguments, Runner runner) throws Exception {
        if (arguments.length < 2 || !arguments[0].equals("--log")) {
            return run(arguments, runner);
        }
        Path log = Path.of(arguments[1]).toAbsolutePath();
        Files.createDirectories(log.getParent());
        PrintStream console = System.out;
        try (var file = new PrintStream(Files.newOutputStream(log), true, console.charset())) {
            System.setOut(file);
            String fault = run(Arrays.copyOfRange(arguments, 2, arguments.length), runner);
            return fault == null ? null : fault + "; all that jcstress printed is in " + log;
        } catch (Throwable e) {
            throw new IllegalStateException("the laws failed; all that jcstress printed is in " + log, e);
        } finally {
            System.setOut(console);
        }
    }

    /** Why the run proves nothing, or null if all laws passed. */
    static @Nullable String run(String[] arguments, Runner runner) throws Exception {
        PrintStream console = System.out;
        var counts = new CountsInOutput(console);
        System.setOut(new PrintStream(counts, true, console.charset()));
        try {
            runner.run(arguments);
        } finally {
            System.out.flush();
            System.setOut(console);
        }
        boolean listsOnly = List.of(arguments).contains("-l");
        return listsOnly ? null : counts.fault();
    }

    /** Passes on what jcstress prints, and keeps the last line with its counts of results. */
    private static final class CountsInOutput extends FilterOutputStream {
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
}
