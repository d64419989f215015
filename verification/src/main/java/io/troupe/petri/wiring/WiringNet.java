package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Arc;
import io.troupe.petri.Composition;
import io.troupe.petri.Meld;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

/**
 * The net of some components of a wiring. A call from or to a component outside of these stays a private transition, as
 * if it were made, or answered, at any time. The names of places and transitions are sentences, so that a firing
 * sequence can be read.
 */
final class WiringNet {
    /** The components that take part in a transition, and those that stop in it. */
    record Event(Set<String> who, Set<String> stopping) {}

    /** The component of a place, and, if it waits for an answer there, the request. */
    sealed interface ComponentState {
        String component();

        record At(String component, String state) implements ComponentState {}

        record Asking(String component, Step.Requests request) implements ComponentState {}

        record Serving(String component) implements ComponentState {}
    }

    private final Wiring wiring;
    private final Labels labels;
    private final Set<String> chosen;
    private final Map<String, Event> events = new LinkedHashMap<>();
    private final Map<String, ComponentState> componentStates = new LinkedHashMap<>();
    private final List<Meld> melds = new ArrayList<>();
    private final PetriNet net;

    WiringNet(Wiring wiring, Set<String> chosen) {
        this.wiring = wiring;
        labels = new Labels(wiring);
        this.chosen = chosen;
        var components = new ArrayList<PetriNet>();
        var stops = SynchronisedStop.of(wiring, chosen);
        for (var component : wiring.components()) {
            if (chosen.contains(component)) {
                components.add(component(component, stops));
            }
        }
        var whole = Composition.compose(wiring.name(), components, melds);
        for (var i = 0; i < stops.size(); i++) {
            var number = i;
            var who = stops.get(i).states().keySet();
            var parts = who.stream()
                    .map(component -> component + " stops #" + number)
                    .toList();
            whole = Composition.fuse(whole, stops.get(i).name(), parts);
            events.put(stops.get(i).name(), new Event(who, who));
        }
        net = whole;
    }

    PetriNet net() {
        return net;
    }

    /** The name in this net of a transition, which may be of a net that differs from it in names only. */
    String name(Transition transition) {
        return net.transitions().get(transition.index()).name();
    }

    Event event(Transition transition) {
        return requireNonNull(events.get(name(transition)));
    }

    ComponentState componentState(Place place) {
        return requireNonNull(
                componentStates.get(net.places().get(place.index()).name()));
    }

    /** Equal for nets that differ in names only: the tokens of each place, the arcs of each transition. */
    List<List<Integer>> shape() {
        var shape = new ArrayList<List<Integer>>();
        shape.add(net.places().stream().map(Place::tokens).toList());
        for (var transition : net.transitions()) {
            shape.add(arcs(transition.inputs()));
            shape.add(arcs(transition.outputs()));
            shape.add(arcs(transition.inhibitors()));
        }
        return shape;
    }

    private static List<Integer> arcs(List<Arc> arcs) {
        return arcs.stream()
                .flatMap(arc -> Stream.of(arc.place().index(), arc.weight()))
                .toList();
    }

    Set<String> chosen() {
        return chosen;
    }

    private PetriNet component(String component, List<SynchronisedStop> together) {
        var protocol = wiring.protocol(component);
        var builder = PetriNet.builder(component);
        var first = protocol.states().get(0);
        for (var state : protocol.states()) {
            builder.place(Labels.place(component, state), state.equals(first) ? 1 : 0);
            componentStates.put(Labels.place(component, state), new ComponentState.At(component, state));
        }
        for (var step : protocol.steps()) {
            if (step instanceof Step.Requests request && chosen.contains(wiring.provider(component, request))) {
                melds.add(meld(component, request));
            }
            if (step instanceof Step.Stops && wiring.stopsTogether()) {
                continue;
            }
            var label = labels.label(component, protocol, step);
            builder.transition(
                    label, List.of(Labels.place(component, step.from())), List.of(Labels.place(component, step.to())));
            var stopping = step instanceof Step.Stops ? Set.of(component) : Set.<String>of();
            events.put(label, new Event(Set.of(component), stopping));
        }
        for (var i = 0; i < together.size(); i++) {
            var state = together.get(i).states().get(component);
            if (state != null) {
                builder.transition(
                        component + " stops #" + i,
                        List.of(Labels.place(component, state)),
                        List.of(Labels.place(component, first)));
            }
        }
        return builder.build();
    }

    private Meld meld(String component, Step.Requests request) {
        var provider = wiring.provider(component, request);
        var offer = provider + " does " + request.call();
        var where = labels.where(component, request);
        var target = provider + "." + request.call();
        var meld = new Meld(
                labels.request(component, request),
                offer,
                component + " asks " + target + where,
                component + " waits for " + target + where,
                provider + " takes " + request.call() + " from " + component + where,
                component + " is served " + target + where,
                provider + " before " + request.call(),
                provider + " after " + request.call(),
                provider + " answers " + request.call() + " to " + component + where);
        events.put(meld.asking(), new Event(Set.of(component), Set.of()));
        events.put(meld.accept(), new Event(Set.of(component, provider), Set.of()));
        events.put(meld.answer(), new Event(Set.of(component, provider), Set.of()));
        componentStates.put(meld.waiting(), new ComponentState.Asking(component, request));
        componentStates.put(meld.pending(), new ComponentState.Serving(component));
        componentStates.put(meld.before(), new ComponentState.Serving(provider));
        componentStates.put(meld.after(), new ComponentState.Serving(provider));
        return meld;
    }

    /** Names for the places and transitions of a wiring's net, in the words of the declaration. */
    private record Labels(Wiring wiring) {
        String label(String component, Protocol protocol, Step step) {
            return switch (step) {
                case Step.Does does ->
                    component + ": " + does.label() + (isUnique(protocol, does) ? "" : " (in " + step.from() + ")");
                case Step.Requests request -> request(component, request);
                case Step.Provides offer -> component + " does " + offer.call();
                case Step.Stops stop ->
                    component + " stops" + (protocol.stopStates().size() == 1 ? "" : " in " + stop.from());
            };
        }

        private static boolean isUnique(Protocol protocol, Step.Does does) {
            return protocol.steps().stream()
                            .filter(step -> step instanceof Step.Does other
                                    && other.label().equals(does.label()))
                            .count()
                    == 1;
        }

        String request(String component, Step.Requests request) {
            return component + " requests " + wiring.provider(component, request) + "." + request.call()
                    + where(component, request);
        }

        /** The state of a call; empty unless the same call is made in several states. */
        String where(String component, Step.Requests request) {
            var provider = wiring.provider(component, request);
            var same = wiring.protocol(component).requests().stream()
                    .filter(other -> other.call().equals(request.call())
                            && wiring.provider(component, other).equals(provider))
                    .count();
            return same == 1 ? "" : " (in " + request.from() + ")";
        }

        static String place(String component, String state) {
            return component + "." + state;
        }
    }
}
