package io.troupe.checks.builds;

import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.SequencedCollection;
import java.util.Set;
import java.util.SortedMap;
import java.util.SortedSet;
import java.util.TreeMap;
import java.util.TreeSet;

/**
 * A whole build as read from its files; modules by name.
 *
 * @param owner whose project it is: name, URL and address of the sources, by their properties
 */
record Build(String tool, String group, String version, SortedMap<String, String> owner, Map<String, Module> modules) {
    /** The beginning of the names of properties that name the owner. */
    static final String OWNER = "owner.";

    /** The purpose of a dependency, in Maven's words. */
    enum Scope {
        COMPILE,
        PROVIDED,
        RUNTIME,
        TEST,
        PROCESSOR
    }

    /**
     * A library or module that a module depends on. {@code coordinates} are {@code group:artifact}, as are the excluded
     * transitive dependencies in {@code without}; of the tests of a module they are {@code group:artifact:tests}.
     */
    record Dependency(Scope scope, String coordinates, String version, SortedSet<String> without) {
        Dependency(Scope scope, String coordinates, String version) {
            this(scope, coordinates, version, new TreeSet<>());
        }

        Dependency excluding(Collection<String> excluded) {
            return new Dependency(scope, coordinates, version, new TreeSet<>(excluded));
        }

        @Override
        public String toString() {
            var name = scope.name().toLowerCase(Locale.ROOT) + " " + coordinates + ":" + version;
            return name + (without.isEmpty() ? "" : " without " + without);
        }
    }

    /**
     * A module as described by a build; {@code automaticName} is empty if its jar sets no module name.
     *
     * @param kotlin the version of Kotlin's compiler and its arguments, those for one of main and test alone with its
     *     name in front; empty for a module in Java
     * @param programs what a user can start: by the name of Gradle's task, which is the id of Maven's execution, the
     *     options of the JVM and the main class; {@code run} is the main job
     */
    record Module(
            String description,
            String release,
            String automaticName,
            SortedSet<String> kotlin,
            SortedMap<String, String> programs,
            SequencedCollection<Dependency> dependencies) {
        Module(String description, String release, String automaticName, SequencedCollection<Dependency> dependencies) {
            this(description, release, automaticName, new TreeSet<>(), new TreeMap<>(), dependencies);
        }

        /** The artifact id of the module in a folder: with the name of the project, since jars meet in one folder. */
        static String artifact(String folder) {
            return "troupe-" + folder;
        }

        /**
         * The dependencies by their identity: a library may also be its own annotation processor, and a module may
         * compile against what all modules have for their tests.
         */
        private Map<String, Dependency> byKey() {
            var byKey = new LinkedHashMap<String, Dependency>();
            for (var dependency : dependencies) {
                var key = dependency.coordinates + (dependency.scope == Scope.PROCESSOR ? " (processor)" : "");
                var other = byKey.put(key, dependency);
                if (other != null && (other.scope != Scope.TEST || dependency.scope != Scope.PROVIDED)) {
                    throw new NotUnderstood(key + " is listed twice");
                }
            }
            return byKey;
        }
    }

    /** A part of a build file that its reader does not understand, and therefore cannot compare. */
    static final class NotUnderstood extends RuntimeException {
        private static final long serialVersionUID = 1;

        NotUnderstood(String message) {
            super(message);
        }

        static void unless(boolean understood, String message) {
            if (!understood) {
                throw new NotUnderstood(message);
            }
        }
    }

    /** All differences from the other build, each described in one line; empty if they agree. */
    List<String> differencesTo(Build other) {
        var found = new ArrayList<String>();
        compare("group", group, other, other.group, found);
        compare("version", version, other, other.version, found);
        compareEach("", owner, other, other.owner, found);
        for (String name : union(modules.keySet(), other.modules.keySet())) {
            var mine = modules.get(name);
            var theirs = other.modules.get(name);
            if (mine == null || theirs == null) {
                found.add("module " + name + ": only in " + (mine == null ? other.tool : tool));
            } else {
                compareModules(name, mine, other, theirs, found);
            }
        }
        return found;
    }

    private void compareModules(String name, Module mine, Build other, Module theirs, List<String> found) {
        compare(name + ": description", mine.description, other, theirs.description, found);
        compare(name + ": release level", mine.release, other, theirs.release, found);
        compare(name + ": Automatic-Module-Name", mine.automaticName, other, theirs.automaticName, found);
        compare(name + ": Kotlin", mine.kotlin.toString(), other, theirs.kotlin.toString(), found);
        compareEach(name + ": ", mine.programs, other, theirs.programs, found);
        var ours = mine.byKey();
        var others = theirs.byKey();
        for (String key : union(ours.keySet(), others.keySet())) {
            var here = ours.get(key);
            var there = others.get(key);
            if (here == null || there == null) {
                found.add(name + ": only " + (here == null ? other.tool + " has " + there : tool + " has " + here));
            } else {
                compare(name + ": dependency", here.toString(), other, there.toString(), found);
            }
        }
    }

    private void compareEach(
            String where, Map<String, String> mine, Build other, Map<String, String> theirs, List<String> found) {
        for (String name : union(mine.keySet(), theirs.keySet())) {
            String here = mine.getOrDefault(name, "");
            compare(where + name, here, other, theirs.getOrDefault(name, ""), found);
        }
    }

    private void compare(String what, String mine, Build other, String theirs, List<String> found) {
        if (!mine.equals(theirs)) {
            found.add(what + " is \"" + mine + "\" in " + tool + ", \"" + theirs + "\" in " + other.tool);
        }
    }

    private static Set<String> union(Set<String> left, Set<String> right) {
        var union = new LinkedHashSet<>(left);
        union.addAll(right);
        return union;
    }
}
