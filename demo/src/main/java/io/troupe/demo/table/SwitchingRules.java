package io.troupe.demo.table;

import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * The rules of a table in the form of the list in section 3.3 of the paper: conditions, and the order of services.
 *
 * <p><b>Source.</b> The paper's list contradicts its Table 4 for blue and red; this follows the table.
 */
final class SwitchingRules {
    private static final int FEW_ROBOTS = 4;
    private static final int NOTE_LENGTH = 100;

    private final SubsumptionTable table;
    private final Map<Service, String> abbreviations = new LinkedHashMap<>();

    SwitchingRules(SubsumptionTable table) {
        this.table = table;
        table.services().stream()
                .flatMap(service -> service.layers().stream())
                .distinct()
                .forEach(service -> {
                    String initials = initials(service.name());
                    abbreviations.put(service, abbreviations.containsValue(initials) ? service.name() : initials);
                });
    }

    /** {@code WF} for {@code wallFollower}; the full name if the abbreviation would be one letter. */
    private static String initials(String name) {
        String initials = name.substring(0, 1).toUpperCase(Locale.ROOT)
                + name.substring(1).replaceAll("[^\\p{Lu}]", "");
        return initials.length() > 1 ? initials : name;
    }

    /**
     * The order of services: the layers of the one in charge, highest first, then all others, such as {@code WF > SW}.
     */
    String order(Service inCharge) {
        var layers = inCharge.layers();
        var others = abbreviations.keySet().stream()
                .filter(service -> !layers.contains(service))
                .map(abbreviations::get)
                .toList();
        String first = layers.stream().map(abbreviations::get).collect(Collectors.joining(" > "));
        return switch (others.size()) {
            case 0 -> first;
            case 1 -> first + " > " + others.getFirst();
            default -> first + " > {" + String.join(", ", others) + "}";
        };
    }

    /** The letter of the condition that leads to a state. A is the condition common to all. */
    String condition(State state) {
        return state.number() < 26 ? String.valueOf((char) ('A' + state.number())) : "B" + state.number();
    }

    /** Explains the letters. */
    List<String> notes() {
        List<String> notes = new ArrayList<>();
        notes.addAll(RobotGroups.wrap("A: " + common(), NOTE_LENGTH));
        for (State state : table.states()) {
            notes.addAll(
                    RobotGroups.wrap(condition(state) + ": " + seen(table.colourName(state.colour())), NOTE_LENGTH));
        }
        var shortened = abbreviations.entrySet().stream()
                .filter(entry -> !entry.getValue().equals(entry.getKey().name()))
                .map(entry -> entry.getValue() + " " + entry.getKey().name())
                .toList();
        if (!shortened.isEmpty()) {
            notes.addAll(RobotGroups.wrap(String.join(", ", shortened), NOTE_LENGTH));
        }
        return notes;
    }

    private String common() {
        var not = new ArrayList<String>();
        table.ignored().keySet().forEach(colour -> not.add("robot.colour ≠ " + table.colourName(colour)));
        not.add("robot.colour ≠ state.colour");
        String hold = table.holdSeconds() == 0
                ? ""
                : " & (the state has lasted " + plain(table.holdSeconds())
                        + " s, or robot.colour has a higher priority than state.colour)";
        return String.join(" & ", not) + hold;
    }

    private String seen(String colour) {
        return table.robots() > FEW_ROBOTS
                ? "any robot.colour = " + colour
                : IntStream.rangeClosed(1, table.robots())
                        .mapToObj(robot -> "robot " + robot + ".colour = " + colour)
                        .collect(Collectors.joining(" or "));
    }

    static String plain(double number) {
        return number == StrictMath.rint(number) ? String.format(Locale.ROOT, "%.0f", number) : Double.toString(number);
    }
}
