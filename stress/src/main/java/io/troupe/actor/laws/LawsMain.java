package io.troupe.actor.laws;

import java.io.PrintStream;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.openjdk.jcstress.Main;

/**
 * Runs jcstress with the arguments given, and fails unless every law passed.
 *
 * <p><b>Errors.</b> jcstress fails by itself on a forbidden outcome only. Its exit status is 0 as well when laws ended
 * in an error, on a JVM that cannot load them for example, and when no law ran at all: then this one's is 1.
 */
public final class LawsMain {
    /** Something that runs laws and prints to {@link System#out}, as jcstress does. */
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
