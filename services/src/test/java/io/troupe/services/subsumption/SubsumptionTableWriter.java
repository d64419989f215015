package io.troupe.services.subsumption;

import io.troupe.common.text.LineSyntax;
import io.troupe.common.text.NamedColours;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Writes tables in the format that {@link SubsumptionTableReader} reads, to compare them with what it reads. */
final class SubsumptionTableWriter {
    /** Up to this number of robots, services are written one by one instead of in ranges. */
    private static final int FEW_ROBOTS = 4;

    private final SubsumptionTable table;
    private final StringBuilder text = new StringBuilder();

    private SubsumptionTableWriter(SubsumptionTable table) {
        this.table = table;
    }

    /**
     * Returns a text that the reader parses to an equal table.
     *
     * @throws IllegalArgumentException if a service was not made by a {@link ServiceCatalogue}, so that it cannot be
     *     written
     */
    static String write(SubsumptionTable table) {
        return new SubsumptionTableWriter(table).write();
    }

    private String write() {
        line("robots " + table.robots());
        table.declaredColours()
                .forEach((colour, name) -> line("colour " + name
                        + (NamedColours.named(name).orElse(-1) == colour ? "" : " " + NamedColours.hex(colour))));
        table.ignored()
                .forEach((colour, why) ->
                        line("ignore " + table.colourName(colour) + (why.isEmpty() ? "" : " : " + why)));
        services();
        if (table.holdSeconds() > 0) {
            line("hold " + ServiceArguments.plain(table.holdSeconds()) + " s");
        }
        if (table.allowsFinal()) {
            line("allow final");
        }
        table.states().forEach(this::state);
        return text.toString();
    }

    private void services() {
        table.services().stream()
                .flatMap(service -> service.layers().stream())
                .distinct()
                .forEach(service -> {
                    if (!(service.behaviour() instanceof ServiceDefinition definition)
                            || !service.name().matches(LineSyntax.NAME)) {
                        throw new IllegalArgumentException("the service " + service
                                + " cannot be written, expected one that a catalogue made, and a word as its name");
                    }
                    // always explicit: the default depends on the catalogue with which the text is read
                    boolean plain = service.equals(Service.WALL_FOLLOWER) || service.equals(Service.SPACE_WANDERER);
                    if (!plain) {
                        line("service " + service + " = " + definition
                                + (service.findsColours() ? " colours" : " no colours"));
                    }
                });
    }

    private void state(State state) {
        Integer priority = table.priorities().get(state.colour());
        line("state " + table.colourName(state.colour()) + (priority == null ? "" : " priority " + priority) + " : "
                + (table.robots() <= FEW_ROBOTS
                        ? String.join(
                                ", ",
                                state.services().stream().map(Service::name).toList())
                        : byRanges(state.services())));
    }

    /** The most frequent service as the default, then the other services by ranges of robots. */
    private static String byRanges(List<Service> services) {
        Map<Service, Integer> counts = new LinkedHashMap<>();
        services.forEach(service -> counts.merge(service, 1, Integer::sum));
        Service most = counts.entrySet().stream()
                .max(Comparator.comparingInt(Map.Entry::getValue))
                .orElseThrow()
                .getKey();
        List<String> parts = new ArrayList<>();
        parts.add("* = " + most);
        for (int from = 0; from < services.size(); ) {
            int to = from;
            while (to + 1 < services.size() && services.get(to + 1).equals(services.get(from))) {
                to++;
            }
            if (!services.get(from).equals(most)) {
                parts.add((from == to ? "" + (to + 1) : (from + 1) + ".." + (to + 1)) + " = " + services.get(from));
            }
            from = to + 1;
        }
        return String.join(", ", parts);
    }

    private void line(String line) {
        text.append(line).append('\n');
    }
}
