package io.troupe.checks.builds;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** A whole build as read from its files; modules by name. */
record Build(String tool, String group, String version, Map<String, Module> modules) {
    /** All differences from the other build, each described in one line; empty if they agree. */
    List<String> differencesTo(Build other) {
        var found = new ArrayList<String>();
        compare("group", group, other, other.group, found);
        compare("version", version, other, other.version, found);
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
        compare(name + ": description", mine.description(), other, theirs.description(), found);
        compare(name + ": release level", mine.release(), other, theirs.release(), found);
        compare(name + ": Automatic-Module-Name", mine.automaticName(), other, theirs.automaticName(), found);
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
