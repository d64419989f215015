package io.troupe.services.component.application;

import io.troupe.broker.Need;
import io.troupe.broker.Sharing;
import io.troupe.bus.BusTopic;
import io.troupe.common.text.Suggestions;
import io.troupe.services.component.Component;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.Comparator;
import java.util.Deque;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

/**
 * Description of an application: its components, which services they need, which topics are connected, and which
 * components are replaced when.
 *
 * <p><b>Role.</b> Made in code by {@link #named(String)}, or read from a file by {@link ApplicationReader}. Immutable;
 * a plan may be run many times.
 *
 * @param name the name of the application
 * @param components components by their names on the bus, in the order of their registration
 * @param needs requests to the broker, in this order. The user of a need is its {@code by}: a robot or a component,
 *     whose topics are connected with those of the provider, or the application itself
 * @param wires connections that hold all the time
 * @param replacements replacements of components, with their times
 * @param nodes the processes on the bus that run it; the first one runs the application itself and the components
 *     without a place. Empty for an application inside one process
 * @param places the nodes of components, by the names of the components
 */
public record ApplicationPlan(
        String name,
        Map<String, Component<?, ?>> components,
        List<Need> needs,
        List<Wire<?>> wires,
        List<Replacement> replacements,
        List<String> nodes,
        Map<String, String> places) {
    /**
     * Connection of two topics: values published on the first are also published on the second.
     *
     * @param <T> the type of both topics
     */
    public record Wire<T extends Record>(BusTopic<T> from, BusTopic<T> to) {
        @Override
        public String toString() {
            return from.name() + " -> " + to.name();
        }
    }

    /**
     * Replacement of a component by another, which takes over the name of its service.
     *
     * @param after time since all needs were met, by the clock of the application's space
     */
    public record Replacement(Duration after, String old, String by) {}

    public ApplicationPlan {
        components = Collections.unmodifiableMap(new LinkedHashMap<>(components));
        needs = List.copyOf(needs);
        wires = List.copyOf(wires);
        replacements = List.copyOf(replacements);
        nodes = List.copyOf(nodes);
        places = Map.copyOf(places);
    }

    /** An empty application. */
    public static ApplicationPlan named(String name) {
        return new ApplicationPlan(name, Map.of(), List.of(), List.of(), List.of(), List.of(), Map.of());
    }

    /**
     * A copy with one more component.
     *
     * @param component name of the component, with which it was also created
     */
    public ApplicationPlan with(String component, Component<?, ?> what) {
        if (components.containsKey(component)) {
            throw new IllegalArgumentException(name + " has two components named " + component + ", expected one");
        }
        Map<String, Component<?, ?>> more = new LinkedHashMap<>(components);
        more.put(component, what);
        return new ApplicationPlan(name, more, needs, wires, replacements, nodes, places);
    }

    /**
     * A copy for several processes, before components are placed.
     *
     * @param nodes their names on the bus; the first one runs the application itself
     */
    public ApplicationPlan onNodes(List<String> nodes) {
        if (nodes.stream().distinct().count() < nodes.size()) {
            throw new IllegalArgumentException("the nodes of " + name + " are " + nodes + ", expected each once");
        }
        return new ApplicationPlan(name, components, needs, wires, replacements, nodes, places);
    }

    /** A copy in which all components run in the process of the application. */
    public ApplicationPlan inOneProcess() {
        return new ApplicationPlan(name, components, needs, wires, replacements, List.of(), Map.of());
    }

    /**
     * A copy with the place of a component.
     *
     * @throws IllegalArgumentException if there is no such component or node
     */
    public ApplicationPlan placing(String component, String node) {
        checkComponent(component);
        if (!nodes.contains(node)) {
            throw new IllegalArgumentException(
                    "\"" + node + "\" is no node of " + name + "; " + Suggestions.hintWithSome(node, nodes));
        }
        Map<String, String> more = new LinkedHashMap<>(places);
        more.put(component, node);
        return new ApplicationPlan(name, components, needs, wires, replacements, nodes, more);
    }

    /** The components that run on a node, in their order. */
    public List<String> componentsOn(String node) {
        return components.keySet().stream()
                .filter(each -> !nodes.isEmpty()
                        && places.getOrDefault(each, nodes.getFirst()).equals(node))
                .toList();
    }

    private void checkComponent(String component) {
        if (!components.containsKey(component)) {
            throw new IllegalArgumentException("\"" + component + "\" is no component of " + name + "; "
                    + Suggestions.hintWithSome(component, components.keySet()));
        }
    }

    /** A copy with one more need, for a service by its name. */
    public ApplicationPlan needing(String user, String service) {
        return needing(Need.ofService(user, service));
    }

    /**
     * A copy with one more need.
     *
     * @throws IllegalArgumentException if the user is neither the application, nor a component, nor the owner of a
     *     topic
     */
    public ApplicationPlan needing(Need need) {
        List<String> users = users();
        if (!users.contains(need.by())) {
            throw new IllegalArgumentException(
                    "\"" + need.by() + "\" is neither the application nor a component nor a robot of one; "
                            + Suggestions.hintWithSome(need.by(), users));
        }
        return new ApplicationPlan(name, components, append(needs, need), wires, replacements, nodes, places);
    }

    /**
     * The wires that connect the user of a need with one of these components while it is the provider. They join the
     * topics of both that have the same last name and type.
     */
    public List<Wire<?>> wiresBetween(String user, String provider) {
        return TopicWiring.wiresBetween(components, user, provider);
    }

    /** Permitted users of a need: the application, its components, and the owners of topics. */
    List<String> users() {
        return Stream.concat(
                        Stream.concat(Stream.of(name), components.keySet().stream()),
                        topics().stream().map(ApplicationPlan::owner))
                .distinct()
                .toList();
    }

    /** All topics of all components. */
    List<BusTopic<?>> topics() {
        return components.values().stream()
                .flatMap(each -> Stream.concat(each.subscribes().stream(), each.publishes().stream()))
                .<BusTopic<?>>map(topic -> topic)
                .distinct()
                .toList();
    }

    private static String owner(BusTopic<?> topic) {
        int slash = topic.name().indexOf('/');
        return slash < 0 ? topic.name() : topic.name().substring(0, slash);
    }

    /**
     * A copy with two topics connected.
     *
     * @throws IllegalArgumentException if they are already connected, or if the wire would close a cycle
     */
    public <T extends Record> ApplicationPlan connecting(BusTopic<T> from, BusTopic<T> to) {
        var wire = new Wire<>(from, to);
        if (wires.contains(wire)) {
            throw new IllegalArgumentException(wire + " is there already, expected it once");
        }
        checkAcyclic(wire, wires);
        return new ApplicationPlan(name, components, needs, append(wires, wire), replacements, nodes, places);
    }

    /**
     * Checks that a wire closes no cycle with other wires.
     *
     * @throws IllegalArgumentException if a value sent over this wire would return to it over the others
     */
    static void checkAcyclic(Wire<?> wire, Collection<? extends Wire<?>> others) {
        Set<BusTopic<?>> reached = new LinkedHashSet<>(Set.of(wire.to()));
        Deque<BusTopic<?>> open = new ArrayDeque<>(reached);
        while (!open.isEmpty()) {
            BusTopic<?> at = open.remove();
            if (at.equals(wire.from())) {
                throw new IllegalArgumentException(
                        "the wire " + wire + " closes a cycle, expected wires that end somewhere");
            }
            others.stream()
                    .filter(other -> other.from().equals(at) && reached.add(other.to()))
                    .forEach(other -> open.add(other.to()));
        }
    }

    /**
     * A copy with a replacement. The component that takes over is registered only when the replacement takes place.
     *
     * @throws IllegalArgumentException if a component is unknown, takes a place twice, or would replace itself
     */
    public ApplicationPlan replacing(Duration after, String old, String by) {
        checkComponent(old);
        checkComponent(by);
        if (replacements.stream().anyMatch(each -> each.by().equals(by)) || old.equals(by)) {
            throw new IllegalArgumentException("\"" + by + "\" cannot take a place twice, or its own");
        }
        return new ApplicationPlan(
                name, components, needs, wires, append(replacements, new Replacement(after, old, by)), nodes, places);
    }

    /**
     * True if a component is registered at the start. A component whose first replacement puts it in another's place is
     * registered only then.
     */
    boolean isRegisteredAtStart(String component) {
        return replacements.stream()
                .filter(each -> each.old().equals(component) || each.by().equals(component))
                .min(Comparator.comparing(Replacement::after))
                .map(first -> first.old().equals(component))
                .orElse(true);
    }

    /** The component's service, or before its first replacement puts it in another's place, one that is not needed. */
    String serviceAtStart(String component) {
        return isRegisteredAtStart(component) ? components.get(component).service() : "$" + component;
    }

    /** How the nodes share their components: among themselves, in the order of the components, for the first node. */
    Sharing sharing() {
        List<String> order = List.copyOf(components.keySet());
        return Sharing.defaults()
                .withGroup(name)
                .withRanks(each -> order.contains(each) ? order.indexOf(each) : order.size())
                .withUnusedStopped();
    }

    private static <T> List<T> append(List<T> list, T more) {
        List<T> longer = new ArrayList<>(list);
        longer.add(more);
        return longer;
    }
}
