package io.troupe.checks.builds;

/** One library or module that a module asks for; {@code coordinates} are {@code group:artifact}. */
record Dependency(Scope scope, String coordinates, String version) {
    /** What makes two entries the same dependency: a library may also be its own annotation processor. */
    String key() {
        return scope == Scope.PROCESSOR ? coordinates + " (processor)" : coordinates;
    }

    @Override
    public String toString() {
        return scope + " " + coordinates + ":" + version;
    }
}
