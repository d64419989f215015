package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.ArrayDeque;
import java.util.HashSet;
import java.util.List;
import java.util.TreeSet;

/**
 * What one kind of component does: its states, the calls it makes and offers in them, its private steps, and where it
 * may stop.
 *
 * <p>Several steps out of one state are a choice: a private step and a request are taken when the component likes, an
 * offer when somebody calls. A component that made a request waits until it is answered; one that offers a call in a
 * state waits there for it.
 *
 * {@snippet :
 * var client = Protocol.of("client")
 *         .in("idle", does("look").then("informed"))
 *         .in("informed", requests("planner.plan").then("idle"), stops())
 *         .build();
 * var planner = Protocol.of("planner")
 *         .in("ready", provides("plan").then("ready"))
 *         .build();
 * }
 *
 * <p><b>Role.</b> Put to work under a name in a {@link Wiring}, as often as wanted.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> {@link ProtocolBuilder} throws {@link IllegalArgumentException} for a call that is offered twice, a
 * step to an undeclared state, a state that cannot be reached, and one that nothing leads out of.
 */
public final class Protocol {
    private final String name;
    private final List<String> states;
    private final List<Step> steps;

    Protocol(String name, List<String> states, List<Step> steps) {
        this.name = name;
        this.states = List.copyOf(states);
        this.steps = List.copyOf(steps);
    }

    /** Starts a declaration; the first state that is declared is the one the component starts in. */
    public static ProtocolBuilder of(String name) {
        return new ProtocolBuilder(name);
    }

    /** A private step; the label says what it does, for the stories. */
    public static Way.Open does(String label) {
        return new Way.Open(Way.Kind.DOES, label);
    }

    /** A call, written {@code component.call}, that is waited for. */
    public static Way.Open requests(String target) {
        return new Way.Open(Way.Kind.REQUESTS, target);
    }

    /** A call that others may make while the component is in this state. */
    public static Way.Open provides(String call) {
        return new Way.Open(Way.Kind.PROVIDES, call);
    }

    /** The component may stop here: it goes back to its first state. */
    public static Way stops() {
        return new Way(Way.Kind.STOPS, "", "");
    }

    public String name() {
        return name;
    }

    /** The states as declared, the first one first. */
    public List<String> states() {
        return states;
    }

    /** The calls that are offered, as declared. */
    public List<String> provided() {
        return steps.stream()
                .filter(Step.Provides.class::isInstance)
                .map(step -> ((Step.Provides) step).call())
                .toList();
    }

    /** The calls that are made, each once, as {@code role.call}. */
    public List<String> requested() {
        return requests().stream()
                .map(step -> step.role() + "." + step.call())
                .distinct()
                .toList();
    }

    List<Step> steps() {
        return steps;
    }

    List<Step.Requests> requests() {
        return steps.stream()
                .filter(Step.Requests.class::isInstance)
                .map(Step.Requests.class::cast)
                .toList();
    }

    List<Step> out(String state) {
        return steps.stream().filter(step -> step.from().equals(state)).toList();
    }

    boolean offers(String call) {
        return provided().contains(requireNonNull(call, "call"));
    }

    /** Where it may stop, as declared. */
    List<String> stopStates() {
        return steps.stream()
                .filter(Step.Stops.class::isInstance)
                .map(Step::from)
                .toList();
    }

    /**
     * Where it waits for its next call on the way on from where it may stop: the stop's own state if only calls lead
     * out of it, otherwise those that private steps lead to. Where there is none, the stop stays.
     */
    List<String> synchronisedStops() {
        var found = new TreeSet<Integer>();
        for (var stop : stopStates()) {
            var ahead = new ArrayDeque<>(List.of(stop));
            var seen = new HashSet<>(ahead);
            var waiting = new TreeSet<Integer>();
            while (!ahead.isEmpty()) {
                var state = ahead.remove();
                if (waitsForCall(state)) {
                    waiting.add(states.indexOf(state));
                    continue;
                }
                out(state).stream()
                        .filter(Step.Does.class::isInstance)
                        .map(Step::to)
                        .filter(seen::add)
                        .forEach(ahead::add);
            }
            found.addAll(waiting.isEmpty() ? List.of(states.indexOf(stop)) : waiting);
        }
        return found.stream().map(states::get).toList();
    }

    private boolean waitsForCall(String state) {
        return out(state).stream().allMatch(step -> step instanceof Step.Provides || step instanceof Step.Stops);
    }

    /** The name. */
    @Override
    public String toString() {
        return name;
    }
}
