package io.troupe.services.subsumption;

import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Checks of a table as a whole, for missing and contradictory parts. */
final class TableChecks {
    /** What a finding is about, so that the parser can report where it was written. */
    sealed interface Subject {
        record Whole() implements Subject {}

        record OfState(int colour) implements Subject {}

        record OfColour(int colour) implements Subject {}

        record OfPriority(int colour) implements Subject {}

        record OfService(String name) implements Subject {}
    }

    /** An error in the table. */
    record Finding(Subject subject, String message) {}

    private final SubsumptionTable table;
    private final List<Service> declared;

    TableChecks(SubsumptionTable table, List<Service> declared) {
        this.table = table;
        this.declared = declared;
    }

    /** Returns the first finding, in the order of the checks. */
    Optional<Finding> first() {
        return Stream.<java.util.function.Supplier<@Nullable Finding>>of(
                        this::noState,
                        this::ignoredWithState,
                        this::unusedColour,
                        this::priorityWithoutState,
                        this::neverEnding,
                        this::neverBeginning,
                        this::ambiguousName,
                        this::idleLayer,
                        this::unusedService)
                .<Finding>mapMulti((check, found) -> {
                    Finding finding = check.get();
                    if (finding != null) {
                        found.accept(finding);
                    }
                })
                .findFirst();
    }

    private @Nullable Finding noState() {
        return table.states().isEmpty()
                ? new Finding(
                        new Subject.Whole(),
                        "the table has no state, expected one or more: add one with state(..), in a file with 'state COLOUR : SERVICES'")
                : null;
    }

    private @Nullable Finding ignoredWithState() {
        for (State state : table.states()) {
            String why = table.ignored().get(state.colour());
            if (why != null) {
                return new Finding(
                        new Subject.OfState(state.colour()),
                        table.colourName(state.colour()) + " leads to state " + state.number()
                                + ", but the table ignores it" + (why.isEmpty() ? "" : " (" + why + ")")
                                + ", expected one or the other");
            }
        }
        return null;
    }

    private @Nullable Finding unusedColour() {
        for (int colour : table.declaredColours().keySet()) {
            if (table.state(colour).isEmpty() && !table.ignored().containsKey(colour)) {
                return new Finding(
                        new Subject.OfColour(colour),
                        "the colour " + table.colourName(colour)
                                + " is declared and leads to no state, expected a state for it, or that it is ignored");
            }
        }
        return null;
    }

    private @Nullable Finding priorityWithoutState() {
        for (int colour : table.priorities().keySet()) {
            if (table.state(colour).isEmpty()) {
                return new Finding(
                        new Subject.OfPriority(colour),
                        table.colourName(colour) + " has priority " + table.priority(colour)
                                + " and leads to no state, expected a state for it");
            }
        }
        return null;
    }

    private @Nullable Finding neverEnding() {
        State first = table.first();
        var reachable = first.canEnd() ? table.states() : List.of(first);
        var ends = reachable.stream().filter(state -> !state.canEnd()).toList();
        return ends.isEmpty() || table.allowsFinal()
                ? null
                : new Finding(
                        new Subject.OfState(ends.getFirst().colour()),
                        ends.stream().map(this::name).collect(Collectors.joining(", "))
                                + " can be reached and never ends, because no robot in it looks for colours: put a service that does in charge of one,"
                                + " or call allowFinal(), in a file 'allow final'");
    }

    private @Nullable Finding neverBeginning() {
        if (table.first().canEnd() || table.states().size() == 1) {
            return null;
        }
        State second = table.states().get(1);
        return new Finding(
                new Subject.OfState(second.colour()),
                name(second) + " never begins, because no robot in " + name(table.first())
                        + ", with which the table begins, looks for colours");
    }

    private String name(State state) {
        return "state " + state.number() + " (" + table.colourName(state.colour()) + ")";
    }

    private @Nullable Finding ambiguousName() {
        Map<String, Service> named = new HashMap<>();
        var all = allLayers();
        all.addAll(table.services()); // the combined name of layers counts as well
        for (var service : all) {
            Service other = named.putIfAbsent(service.name(), service);
            if (other != null && !other.equals(service)) {
                return new Finding(
                        new Subject.OfService(service.name()),
                        "two different services are called " + service.name()
                                + ": make it once and use it in every state, or give them different names");
            }
        }
        return null;
    }

    private @Nullable Finding idleLayer() {
        for (State state : table.states()) {
            for (Service service : new LinkedHashSet<>(state.services())) {
                var layers = service.layers();
                var above = new HashSet<Service>();
                for (int layer = 0; layer < layers.size(); layer++) {
                    Service upper = layers.get(layer);
                    if (!above.add(upper)) {
                        return new Finding(
                                new Subject.OfState(state.colour()),
                                "the layers '" + service + "' name " + upper + " twice, expected it once");
                    }
                    if (layer + 1 < layers.size() && upper.neverYields()) {
                        return new Finding(
                                new Subject.OfState(state.colour()),
                                "the layer " + layers.get(layer + 1) + " of '" + service
                                        + "' is never reached, because " + upper
                                        + " always drives: expected it at the bottom");
                    }
                }
            }
        }
        return null;
    }

    private @Nullable Finding unusedService() {
        var used = allLayers();
        for (Service service : declared) {
            if (!used.contains(service) && table.services().stream().noneMatch(service::equals)) {
                return new Finding(
                        new Subject.OfService(service.name()),
                        "the service " + service
                                + " is declared and in charge of no robot in any state, expected it in one");
            }
        }
        return null;
    }

    private LinkedHashSet<Service> allLayers() {
        var all = new LinkedHashSet<Service>();
        for (Service service : table.services()) {
            all.addAll(service.layers());
        }
        return all;
    }
}
