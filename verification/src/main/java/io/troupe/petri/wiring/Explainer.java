package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Marking;
import io.troupe.petri.Transition;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** Explains markings in which components cannot go on, as {@link Counterexample}s. */
final class Explainer {
    private final Wiring wiring;
    private final WiringNet net;

    Explainer(Wiring wiring, WiringNet net) {
        this.wiring = wiring;
        this.net = net;
    }

    /** The counterexample of a marking after which the components {@code stuck} never take a step again. */
    Counterexample explain(Marking marking, List<Transition> trace, boolean isShortest, Set<String> stuck) {
        var waits = waits(marking, stuck);
        var circle = circle(waits);
        var shown = circle.isEmpty() ? List.copyOf(waits.values()) : circle;
        return new Counterexample(
                sentence(shown, stopped(trace)),
                trace.stream().map(net::name).toList(),
                new ToldSteps(trace, net).steps(),
                isShortest,
                List.copyOf(waits.values()),
                circle,
                net.ended(marking));
    }

    /** The state of each component and mailbox in a marking. */
    private record Scene(
            Map<String, String> at,
            Map<String, String> ended,
            Map<String, Step.Requests> asking,
            Map<String, Step.Waiting> decided,
            Map<String, List<String>> mailboxes) {
        static Scene of(Marking marking, WiringNet net) {
            var scene = new Scene(
                    new LinkedHashMap<>(), new HashMap<>(), new HashMap<>(), new HashMap<>(), new HashMap<>());
            for (var place : marking.marked()) {
                switch (net.componentState(place)) {
                    case WiringNet.ComponentState.At(var component, var where) -> scene.at.put(component, where);
                    case WiringNet.ComponentState.Asking(var component, var request) ->
                        scene.asking.put(component, request);
                    case WiringNet.ComponentState.Decided(var component, var step) ->
                        scene.decided.put(component, step);
                    case WiringNet.ComponentState.Served(var component, var request) ->
                        scene.asking.put(component, request);
                    case WiringNet.ComponentState.Holding(var component, var messages) ->
                        scene.mailboxes.put(component, messages);
                    case WiringNet.ComponentState.Unanswered unanswered -> {}
                    case WiringNet.ComponentState.Serving serving -> {}
                    case WiringNet.ComponentState.Ended(var component, var where) -> scene.ended.put(component, where);
                    case WiringNet.ComponentState.Other other -> {}
                }
            }
            return scene;
        }
    }

    private Map<String, Wait> waits(Marking marking, Set<String> stuck) {
        var scene = Scene.of(marking, net);
        var waits = new LinkedHashMap<String, Wait>();
        for (var component : wiring.components()) {
            if (!stuck.contains(component)) {
                continue;
            }
            var asked = scene.asking().get(component);
            var where = scene.at().get(component);
            var decided = scene.decided().get(component);
            if (decided != null) {
                waits.put(component, wait(component, decided.from(), List.of(decided), scene));
            } else if (asked != null) {
                waits.put(component, new Wait.Answer(component, wiring.provider(component, asked), asked.call()));
            } else if (where != null) {
                waits.put(
                        component,
                        wait(component, where, wiring.protocol(component).out(where), scene));
            }
        }
        return waits;
    }

    /** The wait of a component that is in a state and may take none of these steps. */
    private Wait wait(String component, String state, List<? extends Step> steps, Scene scene) {
        var ways = new LinkedHashSet<Wait>();
        var offers = new LinkedHashSet<Wait.Offer>();
        for (var step : steps) {
            switch (step) {
                case Step.Receives receives ->
                    ways.add(new Wait.Message(
                            component,
                            state,
                            receives.call(),
                            wiring.senders(component, receives.call(), net.chosen()),
                            scene.mailboxes().getOrDefault(component, List.of())));
                case Step.Incoming offer ->
                    offers.add(new Wait.Offer(offer.call(), callers(component, offer.call(), scene)));
                case Step.Takes takes -> ways.add(answer(component, takes));
                case Step.Asks asks -> ways.add(answer(component, asks));
                case Step.Sends sends -> {
                    var receiver = wiring.provider(component, sends);
                    var content = scene.mailboxes().getOrDefault(receiver, List.of());
                    ways.add(new Wait.Room(component, receiver, sends.call(), content));
                }
                case Step.Emits emits ->
                    wiring.callers(component, emits.call(), net.chosen())
                            .forEach(caller -> ways.add(new Wait.Room(
                                    component,
                                    caller,
                                    emits.call(),
                                    Collections.nCopies(wiring.window(component, emits.call()), emits.call()))));
                case Step.Acquires acquires -> {
                    var resource = wiring.bound(component, acquires.resource());
                    var holders = holders(resource, scene);
                    var others = holders.stream()
                            .filter(holder -> !holder.equals(component))
                            .toList();
                    ways.add(new Wait.Resource(component, resource, others.isEmpty() ? holders : others));
                }
                default -> {}
            }
        }
        if (!offers.isEmpty()) {
            ways.add(new Wait.Call(component, state, List.copyOf(offers)));
        }
        return switch (ways.size()) {
            case 0 ->
                new Wait.Stop(
                        component, List.copyOf(SynchronisedStop.missing(wiring, component, net.chosen(), scene.at())));
            case 1 -> ways.iterator().next();
            default -> new Wait.AnyOf(component, state, List.copyOf(ways));
        };
    }

    private Wait answer(String component, Step.Outgoing step) {
        return new Wait.Answer(component, wiring.provider(component, step), step.call());
    }

    /** The components that hold a unit of a resource, by the states that they are in. */
    private List<String> holders(String resource, Scene scene) {
        return wiring.components().stream()
                .filter(net.chosen()::contains)
                .filter(component -> {
                    var asked = scene.asking().get(component);
                    var decided = scene.decided().get(component);
                    var state = decided != null
                            ? decided.from()
                            : asked != null
                                    ? asked.from()
                                    : scene.at()
                                            .getOrDefault(
                                                    component, scene.ended().get(component));
                    return state != null
                            && wiring.protocol(component).held(state).stream()
                                    .anyMatch(role ->
                                            wiring.bound(component, role).equals(resource));
                })
                .toList();
    }

    /**
     * The callers that can get to the call without another answer of the component: one that holds a fork can get to
     * putting it down. If there are none, all that make the call. The other callers wait for the component, so it does
     * not wait for them.
     */
    private List<String> callers(String component, String call, Scene scene) {
        var all = wiring.callers(component, call, net.chosen());
        var near = all.stream()
                .filter(caller -> getsTo(component, call, caller, scene))
                .toList();
        return near.isEmpty() ? all : near;
    }

    private boolean getsTo(String component, String call, String caller, Scene scene) {
        var asked = scene.asking().get(caller);
        if (asked != null && wiring.provider(caller, asked).equals(component)) {
            return false;
        }
        var decided = scene.decided().get(caller);
        if (decided instanceof Step.Asks asks && wiring.target(caller, asks).equals(component + "." + call)) {
            return true;
        }
        var start = decided != null
                ? decided.to()
                : asked != null ? asked.to() : scene.at().get(caller);
        if (start == null) {
            return true; // it is being served, or serves a call
        }
        var seen = new HashSet<>(Set.of(start));
        var ahead = new ArrayDeque<>(seen);
        while (!ahead.isEmpty()) {
            for (var step : wiring.protocol(caller).out(ahead.remove())) {
                var isCall = (step instanceof Step.Requests || step instanceof Step.Asks)
                        && wiring.provider(caller, (Step.Outgoing) step).equals(component);
                if (isCall && ((Step.Outgoing) step).call().equals(call)) {
                    return true;
                }
                if (!isCall || step instanceof Step.Asks) {
                    step.targets().filter(seen::add).forEach(ahead::add);
                }
            }
        }
        return false;
    }

    /** A shortest circle; of several, one with the most calls that were made. */
    private static List<Wait> circle(Map<String, Wait> waits) {
        return waits.keySet().stream()
                .map(start -> circle(start, waits))
                .filter(circle -> !circle.isEmpty())
                .min(Comparator.<List<Wait>>comparingInt(List::size)
                        .thenComparing(circle -> -circle.stream()
                                .filter(Wait.Answer.class::isInstance)
                                .count()))
                .orElse(List.of());
    }

    private static List<Wait> circle(String start, Map<String, Wait> waits) {
        var cameFrom = new HashMap<String, String>();
        var ahead = new ArrayDeque<>(List.of(start));
        while (!ahead.isEmpty()) {
            var component = ahead.remove();
            for (var next : on(waits, component)) {
                if (next.equals(start)) {
                    return back(component, start, cameFrom, waits);
                }
                if (waits.containsKey(next) && cameFrom.putIfAbsent(next, component) == null) {
                    ahead.add(next);
                }
            }
        }
        return List.of();
    }

    private static Collection<String> on(Map<String, Wait> waits, String component) {
        return requireNonNull(waits.get(component)).on();
    }

    private static List<Wait> back(String last, String start, Map<String, String> cameFrom, Map<String, Wait> waits) {
        var circle = new ArrayList<Wait>();
        for (var at = last; !at.equals(start); at = requireNonNull(cameFrom.get(at))) {
            circle.add(requireNonNull(waits.get(at)));
        }
        circle.add(requireNonNull(waits.get(start)));
        Collections.reverse(circle);
        return circle;
    }

    /** The components whose last step was a stop. */
    private Set<String> stopped(List<Transition> trace) {
        var stopped = new HashSet<String>();
        for (var transition : trace) {
            var event = net.event(transition);
            stopped.removeAll(event.who());
            stopped.addAll(event.stopping());
        }
        return stopped;
    }

    private static String sentence(List<Wait> shown, Set<String> stopped) {
        var parts = new ArrayList<String>();
        shown.stream()
                .filter(wait -> stopped.contains(wait.component()))
                .forEach(wait -> parts.add(wait.component() + " stops"));
        var allAsk = shown.size() > 1 && shown.stream().allMatch(Wait.Answer.class::isInstance);
        for (var wait : shown) {
            switch (wait) {
                case Wait.Answer answer -> parts.add(answer + (allAsk ? "" : ", which no component will answer"));
                case Wait.Call call -> {
                    if (shown.size() == 1 || !stopped.contains(call.component())) {
                        parts.add(call + ", which no component will do");
                    }
                }
                default -> parts.add(wait.toString());
            }
        }
        return String.join("; ", parts) + (allAsk ? ": all ask and none answers" : "");
    }
}
