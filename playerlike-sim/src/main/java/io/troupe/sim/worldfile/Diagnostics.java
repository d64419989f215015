package io.troupe.sim.worldfile;

import io.troupe.common.text.SourcePosition;
import java.lang.System.Logger.Level;
import java.util.HashSet;
import java.util.Set;
import java.util.function.Consumer;

/**
 * Reports problems in a file that need not stop its reading. A feature of Stage or Player that is not simulated here is
 * a warning. An unknown name, or a value that cannot be used, is an error for a strict reader; a lenient one leaves it
 * out with a warning.
 */
final class Diagnostics {
    /** Limit of warnings: a file could cause one per word. */
    static final int MOST_WARNINGS = 1000;

    private final Consumer<WorldFileWarning> warnings;
    private final boolean lenient;
    /** Warnings already reported: a problem in a macro is found in every instance of it. */
    private final Set<WorldFileWarning> reported = new HashSet<>();

    private Diagnostics(Consumer<WorldFileWarning> warnings, boolean lenient) {
        this.warnings = warnings;
        this.lenient = lenient;
    }

    static Diagnostics strict(Consumer<WorldFileWarning> warnings) {
        return new Diagnostics(warnings, false);
    }

    /** Strict, with warnings to the log. No reading without warnings waits for the logger. */
    static Diagnostics logged() {
        return strict(
                warning -> System.getLogger(ScenarioReader.class.getName()).log(Level.WARNING, "{0}", warning));
    }

    static Diagnostics lenient(Consumer<WorldFileWarning> warnings) {
        return new Diagnostics(warnings, true);
    }

    /** As strict as this one, with warnings to another consumer. */
    Diagnostics with(Consumer<WorldFileWarning> others) {
        return new Diagnostics(others, lenient);
    }

    /** Reports a feature of Stage or Player that is left out or changed here. */
    void warn(SourcePosition where, String problem) {
        warn(new WorldFileWarning(where, problem));
    }

    void warn(WorldFileWarning warning) {
        if (reported.size() > MOST_WARNINGS || !reported.add(warning)) {
            return;
        }
        warnings.accept(
                reported.size() <= MOST_WARNINGS
                        ? warning
                        : new WorldFileWarning(
                                warning.where(), "more than " + MOST_WARNINGS + " warnings; no more are shown"));
    }

    boolean isLenient() {
        return lenient;
    }

    /**
     * Reports an unknown name, or something else that a lenient reader leaves out or reads all the same.
     *
     * @throws WorldFileException if the reader is strict
     */
    void refuse(SourcePosition where, String problem) {
        if (!lenient) {
            throw new WorldFileException(where, problem);
        }
        warn(where, problem);
    }
}
