package io.troupe.checks.builds;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.SequencedCollection;

/** A module as described by a build; {@code automaticName} is empty if its jar sets no module name. */
record Module(String description, String release, String automaticName, SequencedCollection<Dependency> dependencies) {
    /** The artifact id of the module in a folder: with the name of the project, since jars meet in one folder. */
    static String artifact(String folder) {
        return "troupe-" + folder;
    }

    Map<String, Dependency> byKey() {
        var byKey = new LinkedHashMap<String, Dependency>();
        for (var dependency : dependencies) {
            if (byKey.putIfAbsent(dependency.key(), dependency) != null) {
                throw new BuildFileException(dependency.key() + " is listed twice");
            }
        }
        return byKey;
    }
}
