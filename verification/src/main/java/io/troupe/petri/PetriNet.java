package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;
import java.util.function.UnaryOperator;
import org.jspecify.annotations.Nullable;

/**
 * A place/transition net with weighted arcs, inhibitor arcs, an initial marking and optional priorities of transitions.
 *
 * <p><b>Role.</b> Built by {@link #builder}, read by {@link Pnml}, composed by {@link Composition}, searched by
 * {@link ReachabilityGraph}.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Places and transitions keep the order in which they were added.
 *
 * <p><b>Errors.</b> An unknown name, and a place, transition or marking of another net, throw
 * {@link IllegalArgumentException}.
 */
public final class PetriNet {
    private final String name;
    private final List<Place> places;
    private final List<Transition> transitions;
    private volatile @Nullable CompiledNet compiled;
    private final Map<String, Place> placesByName = new LinkedHashMap<>();
    private final Map<String, Transition> transitionsByName = new LinkedHashMap<>();

    PetriNet(String name, List<Place> places, List<Transition> transitions) {
        this.name = name;
        this.places = List.copyOf(places);
        this.transitions = List.copyOf(transitions);
        places.forEach(place -> placesByName.put(place.name(), place));
        transitions.forEach(transition -> transitionsByName.put(transition.name(), transition));
    }

    /** Starts a net without places and transitions. */
    public static PetriNetBuilder builder(String name) {
        return new PetriNetBuilder(name);
    }

    /** Starts a builder with the contents of this net. */
    public PetriNetBuilder toBuilder() {
        return new PetriNetBuilder(name).add(this);
    }

    /** A copy in which {@code change} gives every place and transition its name. */
    public PetriNet renamed(String newName, UnaryOperator<String> change) {
        return new PetriNetBuilder(newName).add(this, change).build();
    }

    public String name() {
        return name;
    }

    public List<Place> places() {
        return places;
    }

    public List<Transition> transitions() {
        return transitions;
    }

    /** The number of arcs, whatever their weights; inhibitor arcs are included. */
    public int arcCount() {
        return transitions.stream()
                .mapToInt(t ->
                        t.inputs().size() + t.outputs().size() + t.inhibitors().size())
                .sum();
    }

    /** Whether the net has an inhibitor arc. Some theorems about nets do not hold with them. */
    public boolean hasInhibitors() {
        return transitions.stream().anyMatch(t -> !t.inhibitors().isEmpty());
    }

    /** Whether two transitions have different priorities. */
    public boolean isPrioritised() {
        return compiled().isPrioritised;
    }

    /** The net as arrays; made when it is first needed. */
    CompiledNet compiled() {
        var known = compiled;
        if (known == null) {
            known = new CompiledNet(places, transitions);
            compiled = known;
        }
        return known;
    }

    public Place place(String placeName) {
        return known(placesByName.get(requireNonNull(placeName, "placeName")), "place", placeName);
    }

    public Transition transition(String transitionName) {
        return known(
                transitionsByName.get(requireNonNull(transitionName, "transitionName")), "transition", transitionName);
    }

    private <T> T known(@Nullable T found, String kind, String wanted) {
        if (found == null) {
            throw new IllegalArgumentException("net " + name + " has no " + kind + " called " + wanted);
        }
        return found;
    }

    public Marking initialMarking() {
        return new Marking(places, places.stream().mapToLong(Place::tokens).toArray());
    }

    /** The marking with one token for each given name; a name given twice counts twice. */
    public Marking marking(String... placeNames) {
        var tokens = new long[places.size()];
        for (var placeName : placeNames) {
            tokens[place(placeName).index()]++;
        }
        return new Marking(places, tokens);
    }

    /**
     * The enabled transitions: those that have their tokens and are not inhibited, while this is true of no transition
     * of higher priority.
     */
    public List<Transition> enabled(Marking marking) {
        marking.requirePlaces(places, name);
        var tokens = marking.toArray();
        var ready = transitions.stream()
                .filter(t -> compiled().unmet(tokens, t.index()) == 0)
                .toList();
        var top = ready.stream().mapToInt(Transition::priority).max().orElse(0);
        return ready.stream().filter(t -> t.priority() == top).toList();
    }

    private boolean mayFire(Marking marking, Transition transition) {
        if (isPrioritised()) {
            return enabled(marking).contains(transition);
        }
        marking.requirePlaces(places, name);
        return compiled().unmet(marking.toArray(), transition.index()) == 0;
    }

    /**
     * The marking after one firing.
     *
     * @throws IllegalStateException if the transition is not enabled; the message names the missing tokens or the
     *     transition of higher priority
     * @throws ArithmeticException if a place would hold more than {@link Long#MAX_VALUE} tokens
     */
    public Marking fire(Marking marking, Transition transition) {
        if (!transition.equals(transitionsByName.get(transition.name()))) {
            throw new IllegalArgumentException("transition " + transition + " is not of net " + name);
        }
        if (!mayFire(marking, transition)) {
            throw new IllegalStateException(whyNot(marking, transition));
        }
        var tokens = marking.toArray();
        transition.inputs().forEach(arc -> tokens[arc.place().index()] -= arc.weight());
        for (var arc : transition.outputs()) {
            var place = arc.place().index();
            tokens[place] = sum(tokens[place], arc.weight(), arc.place());
        }
        return new Marking(places, tokens);
    }

    /** The sum of tokens on a place, which throws if it is too large. */
    static long sum(long held, long more, Place place) {
        if (held > Long.MAX_VALUE - more) {
            throw new ArithmeticException("place " + place + " would hold more than " + Long.MAX_VALUE + " tokens");
        }
        return held + more;
    }

    /** The marking after all firings of {@code sequence}, in order. */
    public Marking fire(Marking marking, List<Transition> sequence) {
        var now = marking;
        for (var transition : sequence) {
            now = fire(now, transition);
        }
        return now;
    }

    private String whyNot(Marking marking, Transition transition) {
        var reasons = new ArrayList<String>();
        for (var arc : transition.inputs()) {
            var held = marking.tokens(arc.place());
            if (held < arc.weight()) {
                reasons.add(arc.place() + " holds " + held + " of " + arc.weight());
            }
        }
        for (var arc : transition.inhibitors()) {
            var held = marking.tokens(arc.place());
            if (held >= arc.weight()) {
                reasons.add(arc.place() + " holds " + held + ", expected fewer than " + arc.weight());
            }
        }
        if (reasons.isEmpty()) {
            var first = enabled(marking).get(0);
            reasons.add(first + " has priority " + first.priority() + " over " + transition.priority());
        }
        return "transition " + transition + " may not fire in " + marking + ": " + String.join(", ", reasons);
    }

    /**
     * Whether both nets have the same places, tokens, transitions, priorities, arcs and weights by name. The order and
     * the names of the nets are ignored.
     */
    public boolean sameStructureAs(PetriNet other) {
        return structure().equals(other.structure());
    }

    /** One line for each place and transition, sorted: equal for two nets with the same structure. */
    String structure() {
        var lines = new TreeSet<String>();
        places.forEach(place -> lines.add("place " + place + " " + place.tokens()));
        transitions.forEach(t -> lines.add("transition " + t + " " + t.priority() + " " + sorted(t.inputs()) + " -> "
                + sorted(t.outputs()) + (t.inhibitors().isEmpty() ? "" : " unless " + sorted(t.inhibitors()))));
        return String.join("\n", lines);
    }

    private static List<String> sorted(List<Arc> arcs) {
        return arcs.stream()
                .map(arc -> arc.place() + "*" + arc.weight())
                .sorted()
                .toList();
    }

    /** The name and the size. */
    @Override
    public String toString() {
        return name + " (" + places.size() + " places, " + transitions.size() + " transitions, " + arcCount()
                + " arcs)";
    }
}
