package io.troupe.petri.bip;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * A model in three layers: the behaviour of components ({@link AtomType}), their interactions ({@link Connector}), and
 * priorities between interactions.
 *
 * {@snippet :
 * var lamp = AtomType.starting("Lamp", "off").on("press", "off", "lit").on("press", "lit", "off");
 * var model = BipModel.named("two_lamps")
 *         .component("left", lamp)
 *         .component("right", lamp)
 *         .connector("both", "left.press", "right.press")
 *         .build();
 * assertThat(BipStates.explore(model).size()).isEqualTo(2);
 * }
 *
 * <p><b>Role.</b> {@link BipStates} searches its states, {@link BipText} writes it in the BIP language, {@link BipNet}
 * translates it to a Petri net.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Everything keeps the order in which it was added.
 *
 * <p><b>Errors.</b> A connector end without its port, an unknown connector in a priority, a circle of priorities, a
 * place that no steps reach, and a name that is used twice throw {@link IllegalArgumentException}.
 */
public final class BipModel {
    private final String name;
    private final Map<String, AtomType> components;
    private final Map<String, Connector> connectors;
    private final List<Priority> priorities;
    /** By connector: those that go before it, directly or through others. */
    private final Map<String, Set<String>> above;

    /**
     * A rule between two connectors: an interaction of {@code low} may not happen while one of {@code high} can.
     * Priorities are transitive.
     */
    public record Priority(String low, String high) {
        @Override
        public String toString() {
            return low + " < " + high;
        }
    }

    private BipModel(Builder from) {
        name = from.name;
        components = Collections.unmodifiableMap(new LinkedHashMap<>(from.components));
        connectors = Collections.unmodifiableMap(new LinkedHashMap<>(from.connectors));
        priorities = List.copyOf(from.priorities);
        above = closure();
    }

    /** Starts a model without components. */
    public static Builder named(String name) {
        return new Builder(name);
    }

    public String name() {
        return name;
    }

    /** The types of the components by their names. */
    public Map<String, AtomType> components() {
        return components;
    }

    /** The types of the components, each once. */
    public List<AtomType> types() {
        return components.values().stream().distinct().toList();
    }

    public List<Connector> connectors() {
        return List.copyOf(connectors.values());
    }

    /** The priorities as they were given. */
    public List<Priority> priorities() {
        return priorities;
    }

    /** All priorities that follow from those given. */
    public List<Priority> allPriorities() {
        var all = new ArrayList<Priority>();
        above.forEach((low, higher) -> higher.forEach(high -> all.add(new Priority(low, high))));
        return all;
    }

    /** The ports that no connector joins: their steps never happen. */
    public List<String> unconnectedPorts() {
        var joined = new LinkedHashSet<String>();
        connectors.values().forEach(each -> each.ends().forEach(end -> joined.add(end.toString())));
        var open = new ArrayList<String>();
        components.forEach((component, type) -> type.ports().stream()
                .map(port -> component + "." + port)
                .filter(port -> !joined.contains(port))
                .forEach(open::add));
        return open;
    }

    /** All interactions of all connectors. */
    List<Interaction> interactions() {
        return connectors.values().stream()
                .flatMap(connector -> connector.interactions().stream())
                .toList();
    }

    /**
     * The smallest interactions before which this one has to wait while one of them can happen: those with one port
     * more, and the smallest of each connector of higher priority.
     */
    List<Interaction> smallestAbove(Interaction interaction) {
        var before = new ArrayList<Interaction>();
        var connector = interaction.connector();
        for (var each : connector.interactions()) {
            if (each.ends().size() == interaction.ends().size() + 1
                    && each.ends().containsAll(interaction.ends())) {
                before.add(each);
            }
        }
        for (var high : above.getOrDefault(connector.name(), Set.of())) {
            var higher = connector(high);
            higher.interactions().stream()
                    .filter(each -> higher.isRendezvous() || each.ends().size() == 1)
                    .forEach(before::add);
        }
        return before;
    }

    private Connector connector(String wanted) {
        return requireNonNull(connectors.get(wanted));
    }

    private Map<String, Set<String>> closure() {
        var closure = new LinkedHashMap<String, Set<String>>();
        for (var priority : priorities) {
            closure.computeIfAbsent(priority.low(), low -> new LinkedHashSet<>())
                    .add(priority.high());
        }
        boolean grew;
        do {
            grew = false;
            for (var higher : closure.values()) {
                for (var each : List.copyOf(higher)) {
                    grew |= higher.addAll(closure.getOrDefault(each, Set.of()));
                }
            }
        } while (grew);
        closure.forEach((low, higher) -> {
            if (higher.contains(low)) {
                throw new IllegalArgumentException("in " + name + " connector " + low
                        + " goes before itself by the priorities " + priorities + ", expected no circle");
            }
        });
        return closure;
    }

    /** The name and the size. */
    @Override
    public String toString() {
        return name + " (" + counted(components.size(), "component") + ", " + counted(connectors.size(), "connector")
                + ", " + (priorities.size() == 1 ? "1 priority" : priorities.size() + " priorities") + ")";
    }

    private static String counted(int count, String noun) {
        return count + " " + noun + (count == 1 ? "" : "s");
    }

    /** Collects the parts of a model. Not thread-safe. */
    public static final class Builder {
        private final String name;
        private final Map<String, AtomType> components = new LinkedHashMap<>();
        private final Map<String, Connector> connectors = new LinkedHashMap<>();
        private final List<Priority> priorities = new ArrayList<>();

        private Builder(String name) {
            Names.require("model", name);
            this.name = name;
        }

        /** Adds a component of a type. */
        public Builder component(String component, AtomType type) {
            Names.require("component", component);
            requireNew(component);
            var unreachable = type.unreachable();
            require(
                    unreachable.isEmpty(),
                    "atom type " + type.name() + " has places that no steps reach: " + String.join(", ", unreachable));
            for (var other : components.values()) {
                require(
                        !other.name().equals(type.name()) || other.equals(type),
                        "there are two different atom types called " + type.name() + ", expected one");
            }
            components.put(component, type);
            return this;
        }

        /** Adds a connector, with ends as in {@link Connector#of}; their components have to be there. */
        public Builder connector(String connector, String... ends) {
            return connector(Connector.of(connector, ends));
        }

        /** Adds a connector; the components of its ends have to be there. */
        public Builder connector(Connector connector) {
            requireNew(connector.name());
            for (var end : connector.ends()) {
                @Nullable AtomType type = components.get(end.component());
                if (type == null) {
                    throw new IllegalArgumentException(connector + " ends at " + end + ", but there is no component "
                            + end.component() + "; " + Suggestions.hintWithSome(end.component(), components.keySet()));
                }
                require(
                        type.ports().contains(end.port()),
                        connector + " ends at " + end + ", but " + type.name() + " has no port " + end.port() + "; "
                                + Suggestions.hintWithSome(end.port(), type.ports()));
            }
            connectors.put(connector.name(), connector);
            return this;
        }

        /** Adds a priority: an interaction of {@code low} may not happen while one of {@code high} can. */
        public Builder priority(String low, String high) {
            for (var connector : List.of(low, high)) {
                require(
                        connectors.containsKey(connector),
                        "the priority " + low + " < " + high + " is about " + connector + ", which is no connector; "
                                + Suggestions.hintWithSome(connector, connectors.keySet()));
            }
            var priority = new Priority(low, high);
            require(!priorities.contains(priority), "the priority " + priority + " is there already");
            priorities.add(priority);
            return this;
        }

        public BipModel build() {
            return new BipModel(this);
        }

        private void requireNew(String newName) {
            require(
                    !components.containsKey(newName) && !connectors.containsKey(newName),
                    newName + " is already the name of a component or connector of " + name);
        }

        private static void require(boolean condition, String message) {
            if (!condition) {
                throw new IllegalArgumentException(message);
            }
        }
    }
}
