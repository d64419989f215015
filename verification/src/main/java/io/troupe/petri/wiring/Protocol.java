package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.ArrayDeque;
import java.util.HashSet;
import java.util.List;
import java.util.TreeSet;

/**
 * The behaviour of one kind of component: its states, the calls that it makes and offers in them, its private steps,
 * and where it may stop.
 *
 * <p>Several steps out of one state are a choice. The component chooses a private step or a request at any time; an
 * offer is taken when another component calls. A component that made a request waits until it is answered; one that
 * offers a call in a state waits there for it.
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
 * <p><b>Role.</b> Added to a {@link Wiring} under a name, as often as required.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> {@link ProtocolBuilder} throws {@link IllegalArgumentException} for a call that is offered twice, a
 * step to an undeclared state, an unreachable state, and a state without a way out.
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

    /** Starts a declaration; a component starts in the state that is declared first. */
    public static ProtocolBuilder of(String name) {
        return new ProtocolBuilder(name);
    }

    /** A private step; the label describes it in the counterexamples. */
    public static Branch.Builder does(String label) {
        return new Branch.Builder(Branch.Kind.DOES, label);
    }

    /** A call, written {@code component.call}; the component waits for its answer. */
    public static Branch.Builder requests(String target) {
        return new Branch.Builder(Branch.Kind.REQUESTS, target);
    }

    /** A call that other components may make while the component is in this state. */
    public static Branch.Builder provides(String call) {
        return new Branch.Builder(Branch.Kind.PROVIDES, call);
    }

    /** Allows the component to stop here: it goes back to its first state. */
    public static Branch stops() {
        return new Branch(Branch.Kind.STOPS, "", "");
    }

    public String name() {
        return name;
    }

    /** The states in the order of their declaration. */
    public List<String> states() {
        return states;
    }

    /** The calls that are offered, in the order of their declaration. */
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

    /** The states in which it may stop, in the order of their declaration. */
    List<String> stopStates() {
        return steps.stream()
                .filter(Step.Stops.class::isInstance)
                .map(Step::from)
                .toList();
    }

    /**
     * The states in which it takes part in a synchronised stop: where it waits for its next call after it could stop.
     * That is the state of the stop itself if only calls lead out of it, otherwise the waiting states that private
     * steps lead to. If there are none, it is the state of the stop.
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
