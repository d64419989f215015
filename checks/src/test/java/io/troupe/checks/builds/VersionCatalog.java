package io.troupe.checks.builds;

import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.regex.Pattern;

/** Reads {@code gradle/libs.versions.toml}; it understands versions, and libraries with module and version. */
final class VersionCatalog {
    private static final String FILE = "libs.versions.toml: ";
    private static final Pattern VERSION = Pattern.compile("([\\w-]+)\\s*=\\s*\"([^\"]+)\"");
    private static final Pattern LIBRARY = Pattern.compile(
            "([\\w-]+)\\s*=\\s*\\{\\s*module\\s*=\\s*\"([^\":]+:[^\":]+)\"\\s*,\\s*version\\.ref\\s*=\\s*\"([^\"]+)\"\\s*}");

    private final Map<String, String> versions = new LinkedHashMap<>();
    private final Map<String, Dependency> libraries = new LinkedHashMap<>();
    private final Set<String> used = new HashSet<>();

    VersionCatalog(String toml) {
        var section = "";
        for (String line : toml.lines().map(String::strip).toList()) {
            if (line.isEmpty() || line.startsWith("#")) {
                continue;
            }
            if (line.startsWith("[")) {
                section = line;
            } else if (section.equals("[versions]")) {
                version(line);
            } else if (section.equals("[libraries]")) {
                library(line);
            } else {
                throw new BuildFileException(FILE + "section " + section + " is not understood");
            }
        }
    }

    /**
     * Reads one version. Gradle's "2.57!!" means exactly this version, which Maven assumes for every direct dependency.
     */
    private void version(String line) {
        var match = VERSION.matcher(line);
        if (!match.matches() || versions.put(match.group(1), match.group(2).replaceFirst("!!$", "")) != null) {
            throw new BuildFileException(FILE + "not understood, or given twice: " + line);
        }
    }

    private void library(String line) {
        var match = LIBRARY.matcher(line);
        if (!match.matches()) {
            throw new BuildFileException(FILE + "expected alias = { module = .., version.ref = .. }, found: " + line);
        }
        var version = versions.get(match.group(3));
        if (version == null) {
            throw new BuildFileException(FILE + "no version named " + match.group(3) + ", asked for by: " + line);
        }
        libraries.put(accessor(match.group(1)), new Dependency(Scope.COMPILE, match.group(2), version));
    }

    /** The library that {@code libs.<accessor>} or an alias names, in the given scope. */
    Dependency library(Scope scope, String alias) {
        var library = libraries.get(accessor(alias));
        if (library == null) {
            throw new BuildFileException(FILE + "no library " + alias + "; there are " + libraries.keySet());
        }
        used.add(accessor(alias));
        return new Dependency(scope, library.coordinates(), library.version());
    }

    /** The libraries that were not requested yet. */
    Set<String> unused() {
        var unused = new TreeSet<>(libraries.keySet());
        unused.removeAll(used);
        return unused;
    }

    private static String accessor(String alias) {
        return alias.replace('-', '.').replace('_', '.');
    }
}
