package io.troupe.services.component.application;

import io.troupe.services.broker.Need;
import io.troupe.services.bus.BusTopic;
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
 * An application before it runs: which components there are, who needs which service, which topics are connected, and
 * what is replaced when.
 *
 * <p><b>Role.</b> Made in code by {@link #named(String)}, or read from a file by {@link ApplicationReader}. Immutable;
 * the same plan may run many times.
 *
 * @param components by their names on the bus, in the order in which they are registered
 * @param needs what the broker is asked for, in this order; the user of a need is its {@code by}: a robot or a
 *     component, whose topics are connected with those of the provider, or the application itself
 * @param wires what is connected all the time
 * @param replacements who takes another's place
 */
public record ApplicationPlan(
        String name,
        Map<String, Component<?, ?>> components,
        List<Need> needs,
        List<Wire<?>> wires,
        List<Replacement> replacements) {
    /**
     * What is published on one topic is published on the other, too.
     *
     * @param <T> the type of both
     */
    public record Wire<T extends Record>(BusTopic<T> from, BusTopic<T> to) {
        @Override
        public String toString() {
            return from.name() + " -> " + to.name();
        }
    }

    /**
     * A component that is put in another's place, under the name of its service.
     *
     * @param after by the clock of the application's space, from its start
     */
    public record Replacement(Duration after, String old, String by) {}

    public ApplicationPlan {
        components = Collections.unmodifiableMap(new LinkedHashMap<>(components));
        needs = List.copyOf(needs);
        wires = List.copyOf(wires);
        replacements = List.copyOf(replacements);
    }

    /** An application of nothing. */
    public static ApplicationPlan named(String name) {
        return new ApplicationPlan(name, Map.of(), List.of(), List.of(), List.of());
    }

    /**
     * With one more component.
     *
     * @param component as its maker was given the same name
     */
    public ApplicationPlan with(String component, Component<?, ?> what) {
        if (components.containsKey(component)) {
            throw new IllegalArgumentException(name + " has two components named " + component + ", expected one");
        }
        Map<String, Component<?, ?>> more = new LinkedHashMap<>(components);
        more.put(component, what);
        return new ApplicationPlan(name, more, needs, wires, replacements);
    }

    /** With one more need, of a service by its name. */
    public ApplicationPlan needing(String user, String service) {
        return needing(Need.ofService(user, service));
    }

    /**
     * With one more need.
     *
     * @throws IllegalArgumentException if the user is neither the application, nor a component, nor an owner of topics
     */
    public ApplicationPlan needing(Need need) {
        List<String> users = users();
        if (!users.contains(need.by())) {
            throw new IllegalArgumentException(
                    "\"" + need.by() + "\" is neither the application nor a component nor a robot of one; "
                            + Hints.of(need.by(), users));
        }
        return new ApplicationPlan(name, components, plus(needs, need), wires, replacements);
    }

    /** Whose needs there can be. */
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
                .flatMap(each -> Stream.concat(each.hears().stream(), each.publishes().stream()))
                .<BusTopic<?>>map(topic -> topic)
                .distinct()
                .toList();
    }

    private static String owner(BusTopic<?> topic) {
        int slash = topic.name().indexOf('/');
        return slash < 0 ? topic.name() : topic.name().substring(0, slash);
    }

    /**
     * With two topics connected.
     *
     * @throws IllegalArgumentException if they are already, or if values would go round in a circle
     */
    public <T extends Record> ApplicationPlan connecting(BusTopic<T> from, BusTopic<T> to) {
        var wire = new Wire<>(from, to);
        if (wires.contains(wire)) {
            throw new IllegalArgumentException(wire + " is there already, expected it once");
        }
        checkEnds(wire, wires);
        return new ApplicationPlan(name, components, needs, plus(wires, wire), replacements);
    }

    /** @throws IllegalArgumentException if a value that went over this wire would come back to it over the others */
    static void checkEnds(Wire<?> wire, Collection<? extends Wire<?>> others) {
        Set<BusTopic<?>> reached = new LinkedHashSet<>(Set.of(wire.to()));
        Deque<BusTopic<?>> open = new ArrayDeque<>(reached);
        while (!open.isEmpty()) {
            BusTopic<?> at = open.remove();
            if (at.equals(wire.from())) {
                throw new IllegalArgumentException(
                        "over " + wire + " values would go round in a circle, expected wires that end somewhere");
            }
            others.stream()
                    .filter(other -> other.from().equals(at) && reached.add(other.to()))
                    .forEach(other -> open.add(other.to()));
        }
    }

    /**
     * With a replacement; the component that takes over is registered only then.
     *
     * @throws IllegalArgumentException if one of them is unknown
     */
    public ApplicationPlan replacing(Duration after, String old, String by) {
        for (String each : List.of(old, by)) {
            if (!components.containsKey(each)) {
                throw new IllegalArgumentException(
                        "\"" + each + "\" is no component of " + name + "; " + Hints.of(each, components.keySet()));
            }
        }
        if (replacements.stream().anyMatch(each -> each.by().equals(by)) || old.equals(by)) {
            throw new IllegalArgumentException("\"" + by + "\" cannot take a place twice, or its own");
        }
        return new ApplicationPlan(name, components, needs, wires, plus(replacements, new Replacement(after, old, by)));
    }

    /** Whether a component is registered from the beginning: unless it takes a place before it gives one up. */
    boolean isOffered(String component) {
        return replacements.stream()
                .filter(each -> each.old().equals(component) || each.by().equals(component))
                .min(Comparator.comparing(Replacement::after))
                .map(first -> first.old().equals(component))
                .orElse(true);
    }

    private static <T> List<T> plus(List<T> list, T more) {
        List<T> longer = new ArrayList<>(list);
        longer.add(more);
        return longer;
    }
}
