package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.wiring.WiringNet.ComponentState;
import io.troupe.petri.wiring.WiringNet.Event;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

/**
 * Components that end, and those that are left because all that ever call them have ended. Neither waits for anything.
 *
 * <p>Each gets a token when it has ended. Components that call each other, and otherwise only such as have ended, are
 * left together, where each waits for a call or message and has none; so no token comes too early. One that is left
 * does not fail any more. When all have one, a transition that changes nothing may fire: such a marking is not dead. If
 * nothing else can happen and some have none, it is.
 *
 * <p>A wiring in which no component ends has no such places and transitions.
 */
final class Endings {
    /** The most ways in which components that call each other may be left. */
    private static final int MAX_COMBINATIONS = 1000;

    private final WiringNet net;
    private final Wiring wiring;
    private final WiringNet.Draft draft;
    private final List<String> chosen;

    Endings(WiringNet net) {
        this.net = net;
        wiring = net.wiring();
        draft = net.draft();
        chosen = wiring.components().stream().filter(net.chosen()::contains).toList();
    }

    private boolean ends(String component) {
        return wiring.protocol(component).steps(Step.Ends.class).findAny().isPresent();
    }

    /** Adds them, after everything else. */
    void add() {
        var ended = new LinkedHashSet<String>();
        for (var component : chosen) {
            for (var step : wiring.protocol(component).steps(Step.Ends.class).toList()) {
                ended.add(component);
                end(
                        net.labels().label(component, wiring.protocol(component), step),
                        Map.of(component, step.from()),
                        Set.of());
            }
        }
        if (ended.isEmpty()) {
            return;
        }
        var groups = groups();
        while (groups.removeIf(group -> left(group, ended))) {
            // those that it calls may now be left, too
        }
        ended.forEach(component -> draft.place(token(component), 0));
        if (ended.containsAll(chosen)) {
            var all = chosen.stream().map(Endings::token).toList();
            draft.step("all have ended", new Event(Set.of(), Set.of()), all, all);
        }
    }

    private static String token(String component) {
        return component + " has ended";
    }

    private void end(String label, Map<String, String> states, Set<String> callers) {
        var in = new ArrayList<String>();
        var out = new ArrayList<String>();
        states.forEach((component, state) -> {
            var place = component + " has ended in " + state;
            if (!draft.has(place)) {
                draft.local(component, place, 0, new ComponentState.Ended(component, state));
            }
            in.add(WiringNet.at(component, state));
            out.add(place);
            out.add(token(component));
            nothingLeft(component, state).forEach(free -> {
                in.add(free);
                out.add(free);
            });
        });
        callers.forEach(caller -> {
            in.add(token(caller));
            out.add(token(caller));
        });
        draft.step(label, new Event(states.keySet(), Set.of()), in, out);
    }

    /** The places that are marked while nothing has come, or will, that a component in this state could take. */
    private List<String> nothingLeft(String component, String state) {
        var free = new LinkedHashSet<String>();
        requireNonNull(wiring.openQuestions(component).get(state))
                .forEach(target -> free.add(net.questions().notOpen(component, target)));
        if (wiring.mailbox(component).isPresent() && !(ends(component, state))) {
            free.add(Mailboxes.place(component, List.of()));
        }
        return List.copyOf(free);
    }

    private boolean ends(String component, String state) {
        return wiring.protocol(component).out(state).stream().anyMatch(Step.Ends.class::isInstance);
    }

    /** Adds how components are left that call each other; false if one that calls them never ends. */
    private boolean left(Set<String> group, Set<String> ended) {
        var callers = new TreeSet<String>();
        chosen.stream()
                .filter(caller -> !group.contains(caller) && group.stream().anyMatch(each -> calls(caller, each)))
                .forEach(callers::add);
        if (callers.isEmpty() || !ended.containsAll(callers)) {
            return false;
        }
        var ways = ways(group);
        if (ways.isEmpty()) {
            return false;
        }
        for (var way : ways) {
            var words = new ArrayList<String>();
            way.forEach((component, state) -> words.add(component + " in " + state));
            end("no component calls " + String.join(" and ", words) + " any more", way, callers);
        }
        ended.addAll(group);
        return true;
    }

    /** By component its state: all combinations of those in which each waits for a call or a message. */
    private List<Map<String, String>> ways(Set<String> group) {
        List<Map<String, String>> ways = List.of(Map.of());
        for (var component : group) {
            var states = wiring.protocol(component).states().stream()
                    .filter(state -> waitsForCall(component, state))
                    .toList();
            if ((long) ways.size() * states.size() > MAX_COMBINATIONS) {
                throw new IllegalArgumentException("wiring " + wiring.name() + ": " + group
                        + " call each other, and can"
                        + " be left by their callers in more than " + MAX_COMBINATIONS + " combinations of states;"
                        + " expected fewer states in which they wait for a call");
            }
            ways = ways.stream()
                    .flatMap(way -> states.stream().map(state -> {
                        Map<String, String> more = new LinkedHashMap<>(way);
                        more.put(component, state);
                        return more;
                    }))
                    .toList();
        }
        return ways;
    }

    private boolean waitsForCall(String component, String state) {
        var protocol = wiring.protocol(component);
        var out = protocol.out(state);
        if (protocol.failsIn(state) && !protocol.held(state).isEmpty()) {
            return false; // a failure releases it
        }
        return out.stream().anyMatch(Step.Incoming.class::isInstance)
                && out.stream().allMatch(step -> switch (step) {
                    case Step.Receives receives -> !net.comesFromOutside(component, receives.call());
                    case Step.Incoming offer -> net.isCalled(component, offer.call());
                    case Step.Takes takes -> true;
                    case Step.Stops stops -> wiring.stopsTogether();
                    default -> false;
                });
    }

    private boolean calls(String caller, String provider) {
        return wiring.protocol(caller)
                .outgoing()
                .anyMatch(step -> wiring.provider(caller, step).equals(provider));
    }

    /** Components that call each other, in a circle; each that ends by itself, and each that is in no circle, alone. */
    private List<Set<String>> groups() {
        var groups = new ArrayList<Set<String>>();
        var placed = new LinkedHashSet<String>();
        for (var component : chosen) {
            if (placed.contains(component)) {
                continue;
            }
            var group = new LinkedHashSet<>(Set.of(component));
            if (!ends(component)) {
                var called = reached(component);
                called.stream()
                        .filter(other -> reached(other).contains(component))
                        .forEach(group::add);
            }
            placed.addAll(group);
            groups.add(group);
        }
        return groups;
    }

    /** Those that a component calls, and that these call, among those that do not end by themselves. */
    private Set<String> reached(String component) {
        var reached = new LinkedHashSet<String>();
        var ahead = new ArrayDeque<>(List.of(component));
        while (!ahead.isEmpty()) {
            var caller = ahead.remove();
            chosen.stream()
                    .filter(other -> !ends(other) && calls(caller, other))
                    .filter(reached::add)
                    .forEach(ahead::add);
        }
        return reached;
    }
}
