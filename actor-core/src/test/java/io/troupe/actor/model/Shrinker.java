package io.troupe.actor.model;

import java.util.List;
import java.util.function.Predicate;

/** Reduces a failing program by removing parts while it still fails: first halves, finally single acts. */
final class Shrinker {
    private Shrinker() {}

    static List<Act> shrink(List<Act> program, Predicate<List<Act>> fails) {
        var smallest = program;
        int part = Math.max(1, Act.count(program) / 2);
        while (true) {
            var smaller = withoutParts(smallest, part, fails);
            boolean progress = Act.count(smaller) < Act.count(smallest);
            smallest = smaller;
            if (part == 1 && !progress) {
                return smallest;
            }
            part = progress ? part : Math.max(1, part / 2);
        }
    }

    private static List<Act> withoutParts(List<Act> program, int part, Predicate<List<Act>> fails) {
        var smallest = program;
        int from = 0;
        while (from < Act.count(smallest)) {
            var candidate = Act.without(smallest, from, from + part);
            if (fails.test(candidate)) {
                smallest = candidate;
            } else {
                from += part;
            }
        }
        return smallest;
    }
}
