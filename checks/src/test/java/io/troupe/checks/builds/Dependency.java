package io.troupe.checks.builds;

import java.util.Collection;
import java.util.SortedSet;
import java.util.TreeSet;

/**
 * A library or module that a module depends on. {@code coordinates} are {@code group:artifact}, as are the excluded
 * transitive dependencies in {@code without}.
 */
record Dependency(Scope scope, String coordinates, String version, SortedSet<String> without) {
    Dependency(Scope scope, String coordinates, String version) {
        this(scope, coordinates, version, new TreeSet<>());
    }

    Dependency excluding(Collection<String> excluded) {
        return new Dependency(scope, coordinates, version, new TreeSet<>(excluded));
    }

    /** The identity of a dependency: a library may also be its own annotation processor. */
    String key() {
        return scope == Scope.PROCESSOR ? coordinates + " (processor)" : coordinates;
    }

    @Override
    public String toString() {
        return scope + " " + coordinates + ":" + version + (without.isEmpty() ? "" : " without " + without);
    }
}
