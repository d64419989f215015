package io.troupe.sim.scenario;

import java.util.HashSet;
import java.util.Set;
import java.util.function.Consumer;

/** What becomes of things in a file that need not stop its reading: errors for a strict reader, warnings for a lenient one. */
final class Findings {
    private final Consumer<WorldFileWarning> warnings;
    private final boolean lenient;
    /** What stands in a macro is found in every instance of it. */
    private final Set<WorldFileWarning> told = new HashSet<>();

    private Findings(Consumer<WorldFileWarning> warnings, boolean lenient) {
        this.warnings = warnings;
        this.lenient = lenient;
    }

    static Findings strict() {
        return new Findings(warning -> {}, false);
    }

    static Findings lenient(Consumer<WorldFileWarning> warnings) {
        return new Findings(warnings, true);
    }

    /**
     * Reports a thing whose consequence, if the reader goes on, is that it is left out.
     *
     * @throws WorldFileException if the reader is strict
     */
    void leaveOut(SourcePosition where, String problem) {
        if (!lenient) {
            throw new WorldFileException(where, problem);
        }
        var warning = new WorldFileWarning(where, problem);
        if (told.add(warning)) {
            warnings.accept(warning);
        }
    }
}
