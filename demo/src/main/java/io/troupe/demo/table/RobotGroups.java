package io.troupe.demo.table;

import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

/** Describes the services of many robots briefly: robots with the same service form a group. */
final class RobotGroups {
    /** Up to this number, robots are listed individually. */
    private static final int FEW_ROBOTS = 4;

    private static final int LINE_LENGTH = 44;

    private RobotGroups() {}

    /** Lines such as {@code robot 1: wallFollower}, for a box. */
    static List<String> lines(State state, Function<Service, String> words) {
        return phrases(state, words).stream()
                .flatMap(phrase -> wrap(phrase, LINE_LENGTH).stream())
                .toList();
    }

    /** One phrase per robot for a few robots, otherwise one per service. */
    static List<String> phrases(State state, Function<Service, String> words) {
        var services = state.services();
        if (services.size() <= FEW_ROBOTS) {
            var lines = new ArrayList<String>();
            for (int robot = 0; robot < services.size(); robot++) {
                lines.add("robot " + (robot + 1) + ": " + words.apply(services.get(robot)));
            }
            return lines;
        }
        Map<Service, List<Integer>> groups = new LinkedHashMap<>();
        for (int robot = 0; robot < services.size(); robot++) {
            groups.computeIfAbsent(services.get(robot), service -> new ArrayList<>())
                    .add(robot + 1);
        }
        return groups.entrySet().stream()
                .map(group -> numbers(group.getValue()) + ": " + words.apply(group.getKey()))
                .toList();
    }

    /** Numbers as ranges: {@code robots 1..2, 6..50}. */
    static String numbers(List<Integer> ascending) {
        List<String> parts = new ArrayList<>();
        for (int from = 0; from < ascending.size(); ) {
            int to = from;
            while (to + 1 < ascending.size() && ascending.get(to + 1) == ascending.get(to) + 1) {
                to++;
            }
            parts.add(from == to ? ascending.get(from).toString() : ascending.get(from) + ".." + ascending.get(to));
            from = to + 1;
        }
        return (ascending.size() == 1 ? "robot " : "robots ") + String.join(", ", parts);
    }

    /** Breaks a text into lines of at most this length; a longer word gets a separate line. */
    static List<String> wrap(String text, int length) {
        List<String> lines = new ArrayList<>();
        var line = new StringBuilder();
        for (String word : text.split(" ")) {
            if (!line.isEmpty() && line.length() + 1 + word.length() > length) {
                lines.add(line.toString());
                line.setLength(0);
            }
            line.append(line.isEmpty() ? "" : " ").append(word);
        }
        lines.add(line.toString());
        return lines;
    }
}
