package io.troupe.checks.builds;

import java.util.Collection;
import java.util.SortedSet;
import java.util.TreeSet;

/**
 * One library or module that a module asks for; {@code coordinates} are {@code group:artifact}, and so are those of
 * what it would bring and must not.
 */
record Dependency(Scope scope, String coordinates, String version, SortedSet<String> without) {
    Dependency(Scope scope, String coordinates, String version) {
        this(scope, coordinates, version, new TreeSet<>());
    }

    Dependency excluding(Collection<String> excluded) {
        return new Dependency(scope, coordinates, version, new TreeSet<>(excluded));
    }

    /** What makes two entries the same dependency: a library may also be its own annotation processor. */
    String key() {
        return scope == Scope.PROCESSOR ? coordinates + " (processor)" : coordinates;
    }

    @Override
    public String toString() {
        return scope + " " + coordinates + ":" + version + (without.isEmpty() ? "" : " without " + without);
    }
}
