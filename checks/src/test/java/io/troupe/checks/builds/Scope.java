package io.troupe.checks.builds;

/** The purpose of a dependency, in Maven's words. */
enum Scope {
    COMPILE,
    PROVIDED,
    RUNTIME,
    TEST,
    PROCESSOR;

    @Override
    public String toString() {
        return name().toLowerCase(java.util.Locale.ROOT);
    }
}
