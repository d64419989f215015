package io.troupe.actor.laws;

import java.io.PrintStream;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.openjdk.jcstress.Main;

/**
 * Runs jcstress with the given arguments, and fails unless every law (jcstress test) passed.
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
        String fault = run(arguments, Main::main);
        if (fault != null) {
            System.err.println("laws: " + fault);
            System.exit(1);
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
}
