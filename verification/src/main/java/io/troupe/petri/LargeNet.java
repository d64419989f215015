package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/**
 * A net with places that hold more tokens than a {@link PetriNet} can: more than {@link Integer#MAX_VALUE}. Their
 * tokens are counted as {@code long}.
 *
 * {@snippet :
 * var large = Pnml.readLarge(file, warnings::add);
 * var result = LargeDeadlockCheck.decide(large, SearchLimits.markings(1_000_000));
 * }
 *
 * <p><b>Role.</b> Read by {@link Pnml#readLarge}. Searches take a {@code PetriNet}: {@link #withoutLargePlaces} is one,
 * and {@link #after} and {@link #enabled} tell what a trace of it does in this net.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> A place or transition of another net, and a negative number of tokens, throw
 * {@link IllegalArgumentException}.
 */
public final class LargeNet {
    private final PetriNet net;
    private final Map<Place, Long> large = new LinkedHashMap<>();

    private LargeNet(PetriNet net, Map<Place, Long> tokens) {
        this.net = net;
        for (var place : net.places()) {
            var held = tokens.get(place);
            if (held != null) {
                if (held < 0) {
                    throw new IllegalArgumentException(
                            "place " + place + " has " + held + " tokens, expected 0 or more");
                }
                large.put(place, held);
            }
        }
        if (large.size() < tokens.size()) {
            var others = tokens.keySet().stream()
                    .filter(place -> !large.containsKey(place))
                    .toList();
            throw new IllegalArgumentException("places " + others + " are not of net " + net.name());
        }
    }

    /**
     * The net, in which the large places start with {@code tokens} and all other places with their own.
     *
     * @param tokens 0 or more tokens by large place
     */
    public static LargeNet of(PetriNet net, Map<Place, Long> tokens) {
        return new LargeNet(requireNonNull(net, "net"), tokens);
    }

    /** The places, transitions and arcs. The initial tokens of its large places have no meaning. */
    public PetriNet net() {
        return net;
    }

    /** The places whose tokens are counted as {@code long}, in the order of the net. */
    public List<Place> largePlaces() {
        return List.copyOf(large.keySet());
    }

    /**
     * The net in which no transition waits for tokens of a large place: these places and their arcs are left out, and
     * so are the transitions that large places inhibit from the start.
     */
    public PetriNet withoutLargePlaces() {
        var smaller = PetriNet.builder(net.name());
        net.places().stream()
                .filter(place -> !large.containsKey(place))
                .forEach(place -> smaller.place(place.name(), place.tokens()));
        for (var t : net.transitions()) {
            if (isInhibitedByLarge(t)) {
                continue;
            }
            smaller.transition(t.name()).priority(t.name(), t.priority());
            small(t.inputs()).forEach(arc -> smaller.arc(arc.place().name(), t.name(), arc.weight()));
            small(t.outputs()).forEach(arc -> smaller.arc(t.name(), arc.place().name(), arc.weight()));
            small(t.inhibitors()).forEach(arc -> smaller.inhibitor(arc.place().name(), t.name(), arc.weight()));
        }
        return smaller.build();
    }

    private boolean isInhibitedByLarge(Transition transition) {
        return transition.inhibitors().stream().anyMatch(arc -> large.getOrDefault(arc.place(), -1L) >= arc.weight());
    }

    private List<Arc> small(List<Arc> arcs) {
        return arcs.stream().filter(arc -> !large.containsKey(arc.place())).toList();
    }

    public LargeMarking initialMarking() {
        return new LargeMarking(
                net.places(),
                net.places().stream()
                        .mapToLong(place -> large.getOrDefault(place, (long) place.tokens()))
                        .toArray());
    }

    /** The enabled transitions, by the same rules as {@link PetriNet#enabled}. */
    public List<Transition> enabled(LargeMarking marking) {
        marking.requirePlaces(net);
        var tokens = marking.toArray();
        return net.transitions().stream().filter(t -> mayFire(tokens, t)).toList();
    }

    /**
     * The marking after all firings of {@code trace}, in order, from the initial marking; empty if one of them is not
     * enabled.
     *
     * @param trace transitions of {@link #net}
     * @throws ArithmeticException if a place would hold more than {@link Long#MAX_VALUE} tokens
     */
    public Optional<LargeMarking> after(List<Transition> trace) {
        var tokens = initialMarking().toArray();
        for (var t : trace) {
            if (!t.equals(net.transition(t.name()))) {
                throw new IllegalArgumentException("transition " + t + " is another one in net " + net.name());
            }
            if (!mayFire(tokens, t)) {
                return Optional.empty();
            }
            t.inputs().forEach(arc -> tokens[arc.place().index()] -= arc.weight());
            for (var arc : t.outputs()) {
                var place = arc.place();
                if (tokens[place.index()] > Long.MAX_VALUE - arc.weight()) {
                    throw new ArithmeticException(
                            "place " + place + " would hold more than " + Long.MAX_VALUE + " tokens");
                }
                tokens[place.index()] += arc.weight();
            }
        }
        return Optional.of(new LargeMarking(net.places(), tokens));
    }

    private boolean mayFire(long[] tokens, Transition transition) {
        return isReady(tokens, transition)
                && (!net.isPrioritised()
                        || net.transitions().stream()
                                .noneMatch(t -> t.priority() > transition.priority() && isReady(tokens, t)));
    }

    /** Whether a transition has its tokens and is not inhibited; priorities are ignored. */
    private static boolean isReady(long[] tokens, Transition transition) {
        return transition.inputs().stream().allMatch(arc -> tokens[arc.place().index()] >= arc.weight())
                && transition.inhibitors().stream()
                        .allMatch(arc -> tokens[arc.place().index()] < arc.weight());
    }

    /** The name, the size, and the large places with their tokens. */
    @Override
    public String toString() {
        return net + " with large places " + large;
    }
}
