package io.troupe.petri.bip;

import static java.util.Objects.requireNonNull;
import static java.util.stream.Collectors.toSet;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * The behaviour of a component: an automaton whose steps are labelled with ports. A step happens only as a part of an
 * interaction of a {@link Connector} that joins its port.
 *
 * {@snippet :
 * var lamp = AtomType.starting("Lamp", "off").on("press", "off", "lit").on("press", "lit", "off");
 * }
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Places and ports are in the order in which the steps name them, the initial place first.
 *
 * <p><b>Errors.</b> Names have letters, digits and underscores, and are no words of the BIP language. Two steps from
 * one place have different ports, and no port is called like a place. Anything else throws
 * {@link IllegalArgumentException}.
 *
 * @param name the name of the type
 * @param initial the place in which it starts
 * @param steps its steps
 */
public record AtomType(String name, String initial, List<Step> steps) {
    /** A step from one place to another. */
    public record Step(String port, String from, String to) {
        @Override
        public String toString() {
            return "on " + port + " from " + from + " to " + to;
        }
    }

    public AtomType {
        Names.require("atom type", name);
        Names.require("place of " + name, initial);
        steps = List.copyOf(steps);
        var leaving = new LinkedHashSet<String>();
        for (var step : steps) {
            Names.require("port of " + name, step.port());
            Names.require("place of " + name, step.from());
            Names.require("place of " + name, step.to());
            if (!leaving.add(step.port() + " " + step.from())) {
                throw new IllegalArgumentException(name + " has two steps on " + step.port() + " from " + step.from()
                        + ", expected one; for a choice use two ports");
            }
        }
        var places = steps.stream()
                .flatMap(step -> Stream.of(step.from(), step.to()))
                .collect(toSet());
        for (var step : steps) {
            if (places.contains(step.port()) || step.port().equals(initial)) {
                throw new IllegalArgumentException(
                        name + " has a port and a place called " + step.port() + ", expected different names");
            }
        }
    }

    /** A type without steps. */
    public static AtomType starting(String name, String initial) {
        return new AtomType(name, requireNonNull(initial, "initial"), List.of());
    }

    /** A copy with one more step. */
    public AtomType on(String port, String from, String to) {
        var more = new ArrayList<>(steps);
        more.add(new Step(port, from, to));
        return new AtomType(name, initial, more);
    }

    /** All places. */
    public List<String> places() {
        var places = new LinkedHashSet<>(Set.of(initial));
        for (var step : steps) {
            places.add(step.from());
            places.add(step.to());
        }
        return List.copyOf(places);
    }

    /** All ports. */
    public List<String> ports() {
        return steps.stream().map(Step::port).distinct().toList();
    }

    /** The place to which a port leads from a place; null if the port is not enabled there. */
    @Nullable
    String target(String port, String from) {
        return steps.stream()
                .filter(step -> step.port().equals(port) && step.from().equals(from))
                .map(Step::to)
                .findFirst()
                .orElse(null);
    }

    /** The places in which a port is enabled. */
    List<String> enabling(String port) {
        return steps.stream()
                .filter(step -> step.port().equals(port))
                .map(Step::from)
                .distinct()
                .toList();
    }

    /** The places that the steps cannot reach, whatever the other components do. */
    List<String> unreachable() {
        var reached = new LinkedHashSet<>(Set.of(initial));
        int before;
        do {
            before = reached.size();
            steps.stream().filter(step -> reached.contains(step.from())).forEach(step -> reached.add(step.to()));
        } while (reached.size() > before);
        return places().stream().filter(place -> !reached.contains(place)).toList();
    }
}
