package io.troupe.petri.bip;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import io.troupe.petri.PetriNetBuilder;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * The Petri net of a model: a place for each place of each component, a transition for each interaction and each
 * combination of steps. Its reachable markings are the states of the model, and its firings are the interactions.
 *
 * <p>Maximal progress and priorities become conditions of transitions, not priorities of the net: those would also hold
 * back interactions that the model does not compare. A transition that has to wait while a port of another component is
 * enabled needs a token on the place {@code no component.port}, which is marked as long as that port is not enabled.
 * Transitions for the same interaction exclude each other, so that each firing is one interaction. The net is 1-safe
 * and has no priorities, so that stubborn sets and siphons can be used.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> A model whose net would have more than {@link #MOST_TRANSITIONS} transitions throws
 * {@link IllegalArgumentException}.
 *
 * @param net the net
 * @param interactions the interaction of each transition, by the name of the transition
 */
public record BipNet(PetriNet net, Map<String, Interaction> interactions) {
    /** The most transitions of a translation. */
    public static final int MOST_TRANSITIONS = 100_000;

    public BipNet {
        interactions = Collections.unmodifiableMap(new LinkedHashMap<>(interactions));
    }

    /** Translates a model. */
    public static BipNet of(BipModel model) {
        return new Translation(model).translate();
    }

    /** The interaction that a transition stands for. */
    public Interaction interaction(Transition transition) {
        var found = interactions.get(transition.name());
        if (found == null) {
            throw new IllegalArgumentException("transition " + transition + " is not of net " + net);
        }
        return found;
    }

    /** The name of the place that holds a token while a component is in one of its places. */
    public static String place(String component, String place) {
        return component + "." + place;
    }

    private static final class Translation {
        private final BipModel model;
        private final List<Firing> firings = new ArrayList<>();
        /** Ports that have to be not enabled for some firing, by component. */
        private final Map<String, Set<String>> watched = new LinkedHashMap<>();

        /** What is known about the components when a transition fires: their places, and ports that are not enabled. */
        private record Known(Map<String, String> places, Map<String, Set<String>> disabled) {
            Known with(String component, String place) {
                var more = new LinkedHashMap<>(places);
                more.put(component, place);
                return new Known(more, disabled);
            }

            Known without(Connector.End end) {
                var more = new LinkedHashMap<String, Set<String>>();
                disabled.forEach((component, ports) -> more.put(component, new LinkedHashSet<>(ports)));
                more.computeIfAbsent(end.component(), each -> new LinkedHashSet<>())
                        .add(end.port());
                return new Known(places, more);
            }

            Set<String> disabled(String component) {
                return disabled.getOrDefault(component, Set.of());
            }
        }

        /** A transition to be: the steps of the components that take part, and what else has to hold. */
        private record Firing(Interaction interaction, Map<String, AtomType.Step> steps, Known known) {}

        Translation(BipModel model) {
            this.model = model;
        }

        private AtomType type(String component) {
            return requireNonNull(model.components().get(component));
        }

        BipNet translate() {
            for (var interaction : model.interactions()) {
                choose(interaction, 0, new LinkedHashMap<>());
            }
            var builder = PetriNet.builder(model.name());
            model.components().forEach((component, type) -> addPlaces(builder, component, type));
            var interactions = new LinkedHashMap<String, Interaction>();
            for (var firing : firings) {
                var name = name(firing, interactions);
                interactions.put(name, firing.interaction());
                add(builder, name, firing);
            }
            return new BipNet(builder.build(), interactions);
        }

        private static String name(Firing firing, Map<String, Interaction> taken) {
            var plain = firing.interaction().toString();
            var name = plain;
            for (var number = 2; taken.containsKey(name); number++) {
                name = plain + " #" + number;
            }
            return name;
        }

        // ---- which transitions

        /** Goes through the combinations of steps for the ends of an interaction, from one end on. */
        private void choose(Interaction interaction, int end, Map<String, AtomType.Step> steps) {
            if (end == interaction.ends().size()) {
                var places = new LinkedHashMap<String, String>();
                steps.forEach((component, step) -> places.put(component, step.from()));
                wait(interaction, steps, model.smallestAbove(interaction), new Known(places, Map.of()));
                return;
            }
            var chosen = interaction.ends().get(end);
            for (var step : type(chosen.component()).steps()) {
                if (step.port().equals(chosen.port())) {
                    var more = new LinkedHashMap<>(steps);
                    more.put(chosen.component(), step);
                    choose(interaction, end + 1, more);
                }
            }
        }

        /** Adds the firings in which none of the interactions above can happen. */
        private void wait(
                Interaction interaction, Map<String, AtomType.Step> steps, List<Interaction> above, Known known) {
            if (above.isEmpty()) {
                if (firings.size() == MOST_TRANSITIONS) {
                    throw new IllegalArgumentException("the net of " + model + " needs more than " + MOST_TRANSITIONS
                            + " transitions, because of connector "
                            + interaction.connector().name());
                }
                firings.add(new Firing(interaction, steps, known));
                return;
            }
            block(interaction, steps, above, 0, known);
        }

        /** Goes through the ways in which the first interaction above cannot happen, from one of its ends on. */
        private void block(
                Interaction interaction,
                Map<String, AtomType.Step> steps,
                List<Interaction> above,
                int number,
                Known known) {
            var first = above.getFirst();
            if (number == first.ends().size()) {
                return; // it can happen, so the transition has to wait
            }
            var end = first.ends().get(number);
            var others = above.subList(1, above.size());
            var type = type(end.component());
            var place = known.places().get(end.component());
            if (place != null) {
                if (type.target(end.port(), place) == null) {
                    wait(interaction, steps, others, known);
                } else {
                    block(interaction, steps, above, number + 1, known);
                }
                return;
            }
            if (known.disabled(end.component()).contains(end.port())) {
                wait(interaction, steps, others, known);
                return;
            }
            if (type.enabling(end.port()).size() < type.places().size()) {
                watched.computeIfAbsent(end.component(), each -> new LinkedHashSet<>())
                        .add(end.port());
                wait(interaction, steps, others, known.without(end));
            }
            if (number == first.ends().size() - 1) {
                return; // enabled here, it can happen
            }
            for (var enabling : type.enabling(end.port())) {
                if (known.disabled(end.component()).stream().allMatch(port -> type.target(port, enabling) == null)) {
                    block(interaction, steps, above, number + 1, known.with(end.component(), enabling));
                }
            }
        }

        // ---- as places and arcs

        private static String missing(String component, String port) {
            return "no " + component + "." + port;
        }

        private static boolean isMissing(AtomType type, String port, String place) {
            return type.target(port, place) == null;
        }

        private void addPlaces(PetriNetBuilder builder, String component, AtomType type) {
            for (var place : type.places()) {
                builder.place(place(component, place), place.equals(type.initial()) ? 1 : 0);
            }
            for (var port : watched.getOrDefault(component, Set.of())) {
                builder.place(missing(component, port), isMissing(type, port, type.initial()) ? 1 : 0);
            }
        }

        private void add(PetriNetBuilder builder, String name, Firing firing) {
            var in = new LinkedHashSet<String>();
            var out = new LinkedHashSet<String>();
            firing.steps().forEach((component, step) -> {
                in.add(place(component, step.from()));
                out.add(place(component, step.to()));
                for (var port : watched.getOrDefault(component, Set.of())) {
                    var before = isMissing(type(component), port, step.from());
                    var after = isMissing(type(component), port, step.to());
                    if (before && !after) {
                        in.add(missing(component, port));
                    } else if (after && !before) {
                        out.add(missing(component, port));
                    }
                }
            });
            var tested = new LinkedHashSet<String>();
            firing.known().places().forEach((component, place) -> {
                if (!firing.steps().containsKey(component)) {
                    tested.add(place(component, place));
                }
            });
            firing.known().disabled().forEach((component, ports) -> {
                if (!firing.known().places().containsKey(component)) {
                    ports.forEach(port -> tested.add(missing(component, port)));
                }
            });
            in.addAll(tested);
            out.addAll(tested);
            builder.transition(name, in, out);
        }
    }
}
