package io.troupe.checks.builds;

/** What a dependency is for, in Maven's words. */
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
