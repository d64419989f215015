package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.UnaryOperator;
import org.jspecify.annotations.Nullable;

/**
 * Collects places, transitions and arcs for a {@link PetriNet}.
 *
 * <p><b>Role.</b> From {@link PetriNet#builder} or {@link PetriNet#toBuilder}. Add places and transitions before the
 * arcs that name them.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Errors.</b> An illegal argument throws {@link IllegalArgumentException}, which names the net, the place or
 * transition and its value. A name must not be blank, and must have no space around it and no control characters.
 * Places and transitions share one name space.
 */
public final class PetriNetBuilder {
    private final String name;
    private final Map<String, Long> places = new LinkedHashMap<>();
    private final Map<String, Draft> transitions = new LinkedHashMap<>();

    /** A transition that is being built: weights by the name of the place. */
    record Draft(int priority, Map<String, Integer> in, Map<String, Integer> out, Map<String, Integer> inhibitors) {}

    PetriNetBuilder(String name) {
        this.name = requireNonNull(name, "name");
        requireReadable("the net", name);
    }

    /** Adds an empty place. */
    public PetriNetBuilder place(String placeName) {
        return place(placeName, 0);
    }

    /** Adds a place that holds {@code tokens} (0 or more) in the initial marking. */
    public PetriNetBuilder place(String placeName, long tokens) {
        requireNew(placeName);
        require(tokens >= 0, "place " + placeName + " has " + tokens + " tokens, expected 0 or more");
        places.put(placeName, tokens);
        return this;
    }

    /** Adds a transition of priority 0 without arcs. */
    public PetriNetBuilder transition(String transitionName) {
        requireNew(transitionName);
        transitions.put(
                transitionName, new Draft(0, new LinkedHashMap<>(), new LinkedHashMap<>(), new LinkedHashMap<>()));
        return this;
    }

    /** Adds a transition of priority 0 with an arc of weight 1 from each of {@code in} and to each of {@code out}. */
    public PetriNetBuilder transition(String transitionName, Collection<String> in, Collection<String> out) {
        return transition(
                transitionName,
                new Draft(0, weightOne(transitionName, in), weightOne(transitionName, out), new LinkedHashMap<>()));
    }

    PetriNetBuilder transition(String transitionName, Draft draft) {
        requireNew(transitionName);
        draft.in().keySet().forEach(place -> requirePlace(transitionName, place));
        draft.out().keySet().forEach(place -> requirePlace(transitionName, place));
        draft.inhibitors().keySet().forEach(place -> requirePlace(transitionName, place));
        transitions.put(transitionName, draft);
        return this;
    }

    /** Adds an arc of weight 1 between a place and a transition, in either direction. */
    public PetriNetBuilder arc(String from, String to) {
        return arc(from, to, 1);
    }

    /** Adds an arc of weight 1 or more between a place and a transition, in either direction. */
    public PetriNetBuilder arc(String from, String to, int weight) {
        var arc = "arc " + requireNonNull(from, "from") + " -> " + requireNonNull(to, "to");
        for (var end : List.of(from, to)) {
            require(
                    places.containsKey(end) || transitions.containsKey(end),
                    arc + ": there is no place or transition called " + end);
        }
        require(
                places.containsKey(from) != places.containsKey(to),
                arc + " joins two " + (places.containsKey(from) ? "places" : "transitions")
                        + ", expected a place and a transition");
        require(weight > 0, arc + " has weight " + weight + ", expected 1 or more");
        var weights = places.containsKey(from) ? draft(to).in() : draft(from).out();
        var place = places.containsKey(from) ? from : to;
        require(!weights.containsKey(place), arc + " is there already; give it a weight instead");
        weights.put(place, weight);
        return this;
    }

    /** Adds an inhibitor arc of weight 1: the transition may fire only while the place is empty. */
    public PetriNetBuilder inhibitor(String placeName, String transitionName) {
        return inhibitor(placeName, transitionName, 1);
    }

    /** Adds an inhibitor arc: the transition may fire only while the place holds fewer than {@code weight} tokens. */
    public PetriNetBuilder inhibitor(String placeName, String transitionName, int weight) {
        var arc = "inhibitor arc " + requireNonNull(placeName, "placeName") + " -> " + transitionName;
        var inhibitors = draft(transitionName).inhibitors();
        require(places.containsKey(placeName), arc + ": there is no place called " + placeName);
        require(weight > 0, arc + " has weight " + weight + ", expected 1 or more");
        require(!inhibitors.containsKey(placeName), arc + " is there already; the smallest weight is enough");
        inhibitors.put(placeName, weight);
        return this;
    }

    /** Sets the priority of a transition; a higher number goes first. */
    public PetriNetBuilder priority(String transitionName, int priority) {
        var draft = draft(transitionName);
        transitions.put(transitionName, new Draft(priority, draft.in(), draft.out(), draft.inhibitors()));
        return this;
    }

    /** Adds all places, transitions and arcs of another net. */
    public PetriNetBuilder add(PetriNet net) {
        return add(net, UnaryOperator.identity());
    }

    PetriNetBuilder add(PetriNet net, UnaryOperator<String> rename) {
        net.places().forEach(place -> place(rename.apply(place.name()), place.tokens()));
        net.transitions()
                .forEach(t -> transition(
                        rename.apply(t.name()),
                        new Draft(
                                t.priority(),
                                weights(t.inputs(), rename),
                                weights(t.outputs(), rename),
                                weights(t.inhibitors(), rename))));
        return this;
    }

    /** Removes a transition and its arcs. */
    public PetriNetBuilder remove(String transitionName) {
        take(transitionName);
        return this;
    }

    Draft take(String transitionName) {
        var draft = draft(transitionName);
        transitions.remove(transitionName);
        return draft;
    }

    private Draft draft(String transitionName) {
        @Nullable Draft draft = transitions.get(requireNonNull(transitionName, "transitionName"));
        if (draft == null) {
            throw new IllegalArgumentException("net " + name + ": there is no transition called " + transitionName);
        }
        return draft;
    }

    /** Builds a net of the current contents; the builder can be used further. */
    public PetriNet build() {
        var built = new LinkedHashMap<String, Place>();
        places.forEach((placeName, tokens) -> built.put(placeName, new Place(built.size(), placeName, tokens)));
        var fired = new ArrayList<Transition>();
        transitions.forEach((transitionName, draft) -> fired.add(new Transition(
                fired.size(),
                transitionName,
                draft.priority(),
                arcs(draft.in(), built),
                arcs(draft.out(), built),
                arcs(draft.inhibitors(), built))));
        return new PetriNet(name, List.copyOf(built.values()), fired);
    }

    private static List<Arc> arcs(Map<String, Integer> weights, Map<String, Place> places) {
        return weights.entrySet().stream()
                .map(arc -> new Arc(requireNonNull(places.get(arc.getKey())), arc.getValue()))
                .toList();
    }

    private static Map<String, Integer> weights(List<Arc> arcs, UnaryOperator<String> rename) {
        var weights = new LinkedHashMap<String, Integer>();
        arcs.forEach(arc -> weights.put(rename.apply(arc.place().name()), arc.weight()));
        return weights;
    }

    private Map<String, Integer> weightOne(String transitionName, Collection<String> placeNames) {
        var weights = new LinkedHashMap<String, Integer>();
        for (var place : placeNames) {
            require(
                    weights.put(place, 1) == null,
                    "transition " + transitionName + " names place " + place
                            + " twice on one side; use an arc with a weight");
        }
        return weights;
    }

    private void requirePlace(String transitionName, String place) {
        require(places.containsKey(place), "transition " + transitionName + ": there is no place called " + place);
    }

    private void requireNew(String newName) {
        requireNonNull(newName, "name");
        requireReadable("a name", newName);
        require(!places.containsKey(newName), newName + " is already the name of a place");
        require(!transitions.containsKey(newName), newName + " is already the name of a transition");
    }

    /** Rejects names that are not fit for XML and traces. */
    private void requireReadable(String what, String text) {
        var readable = !text.isBlank()
                && text.equals(text.strip())
                && text.codePoints()
                        .noneMatch(c -> Character.isISOControl(c)
                                || Character.getType(c) == Character.SURROGATE
                                || c == 0xFFFE
                                || c == 0xFFFF);
        require(readable, what + " is \"" + text + "\", expected text without control characters or space around it");
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw new IllegalArgumentException("net " + name + ": " + message);
        }
    }
}
