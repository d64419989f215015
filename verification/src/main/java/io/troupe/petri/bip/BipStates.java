package io.troupe.petri.bip;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.SearchProgress;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.Predicate;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The reachable states of a model, and the interactions between them, searched directly by the rules of BIP.
 *
 * {@snippet :
 * var states = BipStates.explore(PaperBip.waiting());
 * assertThat(states.find(PaperBip.twoServices(1))).isEmpty();
 * }
 *
 * <p><b>Role.</b> A second opinion on the net of {@link BipNet}, which has the same states. If the search ended early,
 * the states are incomplete: all of them are reachable, and traces are shortest ones, but there may be more.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Breadth first; at equal distance in the order of the connectors.
 *
 * <p><b>Cost.</b> For each state about 150 bytes and 2 for each component; the edges are computed again on each access.
 */
public final class BipStates {
    /** The limit of {@link #explore(BipModel)}. */
    public static final int DEFAULT_MAX_STATES = 1_000_000;

    private static final int STATE_BYTES = 150;

    private final BipModel model;
    private final List<String> components;
    private final List<Rule> rules = new ArrayList<>();
    /** The places of all components in one state, each as a character. */
    private final List<String> found = new ArrayList<>();

    private final Map<String, Integer> indexes = new HashMap<>();
    private final List<Integer> parents = new ArrayList<>();
    private final List<Interaction> parentInteractions = new ArrayList<>();
    private final List<Integer> dead = new ArrayList<>();
    private final BitSet fired = new BitSet();
    private long edges;
    private int expanded;
    private SearchEnd end = SearchEnd.COMPLETE;

    /**
     * An interaction by numbers.
     *
     * @param components the component of each end
     * @param targets by end and place: the place to which the port leads, or -1
     * @param above the interactions that go before it
     */
    private record Rule(Interaction interaction, int[] components, int[][] targets, int[] above) {
        boolean isEnabled(String state) {
            for (var i = 0; i < components.length; i++) {
                if (targets[i][state.charAt(components[i])] < 0) {
                    return false;
                }
            }
            return true;
        }
    }

    private BipStates(BipModel model) {
        this.model = model;
        components = List.copyOf(model.components().keySet());
        var interactions = model.interactions();
        var numbers = new HashMap<Interaction, Integer>();
        interactions.forEach(each -> numbers.put(each, numbers.size()));
        for (var interaction : interactions) {
            rules.add(new Rule(
                    interaction,
                    interaction.ends().stream()
                            .mapToInt(each -> components.indexOf(each.component()))
                            .toArray(),
                    interaction.ends().stream().map(this::targets).toArray(int[][]::new),
                    model.smallestAbove(interaction).stream()
                            .mapToInt(numbers::get)
                            .toArray()));
        }
    }

    private int[] targets(Connector.End end) {
        var type = requireNonNull(model.components().get(end.component()));
        var places = type.places();
        return places.stream()
                .map(place -> type.target(end.port(), place))
                .mapToInt(target -> target == null ? -1 : places.indexOf(target))
                .toArray();
    }

    /** Explores up to {@link #DEFAULT_MAX_STATES} states. */
    public static BipStates explore(BipModel model) {
        return explore(model, SearchLimits.markings(DEFAULT_MAX_STATES));
    }

    /** Explores within {@code limits}, whose markings are the states here. */
    public static BipStates explore(BipModel model, SearchLimits limits) {
        var states = new BipStates(model);
        states.search(limits);
        return states;
    }

    private void search(SearchLimits limits) {
        var initial = new StringBuilder();
        model.components()
                .values()
                .forEach(type -> initial.append((char) type.places().indexOf(type.initial())));
        add(initial.toString(), -1, null);
        while (expanded < found.size()) {
            if (limits.cancelled().getAsBoolean()) {
                end = SearchEnd.CANCELLED;
                return;
            }
            if (found.size() * (STATE_BYTES + 2L * components.size()) > limits.maxBytes()) {
                end = SearchEnd.MEMORY;
                return;
            }
            expand(limits.maxMarkings());
            if (end != SearchEnd.COMPLETE) {
                return;
            }
            if (expanded % limits.markingsPerReport() == 0) {
                limits.report()
                        .accept(new SearchProgress(
                                found.size(), expanded, (int) Math.min(edges, Integer.MAX_VALUE), dead.size()));
            }
        }
    }

    private void expand(int most) {
        var from = found.get(expanded);
        var enabled = enabled(from);
        var next = new LinkedHashMap<String, Interaction>();
        for (var rule = enabled.nextSetBit(0); rule >= 0; rule = enabled.nextSetBit(rule + 1)) {
            edges++;
            next.putIfAbsent(target(rules.get(rule), from), rules.get(rule).interaction());
        }
        next.keySet().removeIf(indexes::containsKey);
        if (found.size() + next.size() > most) {
            end = SearchEnd.LIMIT;
            return;
        }
        next.forEach((state, interaction) -> add(state, expanded, interaction));
        fired.or(enabled);
        if (enabled.isEmpty()) {
            dead.add(expanded);
        }
        expanded++;
    }

    private void add(String state, int parent, @Nullable Interaction interaction) {
        indexes.put(state, found.size());
        found.add(state);
        parents.add(parent);
        parentInteractions.add(interaction);
    }

    /** The interactions that may happen: those that can while none above them can. */
    private BitSet enabled(String state) {
        var can = new BitSet();
        for (var i = 0; i < rules.size(); i++) {
            can.set(i, rules.get(i).isEnabled(state));
        }
        var may = new BitSet();
        can.stream()
                .filter(i -> Arrays.stream(rules.get(i).above()).noneMatch(can::get))
                .forEach(may::set);
        return may;
    }

    /** The state to which an enabled interaction leads. */
    private static String target(Rule rule, String from) {
        var target = new StringBuilder(from);
        for (var i = 0; i < rule.components().length; i++) {
            var at = rule.components()[i];
            target.setCharAt(at, (char) rule.targets()[i][from.charAt(at)]);
        }
        return target.toString();
    }

    /** A reachable state: the place of each component. */
    public final class State {
        private final int index;

        private State(int index) {
            this.index = index;
        }

        /** Its position in {@link #states}; 0 is the initial state. */
        public int index() {
            return index;
        }

        /** The place in which a component is. */
        public String place(String component) {
            var at = components.indexOf(component);
            if (at < 0) {
                throw new IllegalArgumentException("there is no component " + component + " in " + model);
            }
            return place(at);
        }

        private String place(int component) {
            return model.components()
                    .get(components.get(component))
                    .places()
                    .get(found.get(index).charAt(component));
        }

        /** Whether a component is in one of these places. */
        public boolean isIn(String component, String... places) {
            return List.of(places).contains(place(component));
        }

        /** A shortest sequence of interactions from the initial state to this one. */
        public List<Interaction> trace() {
            var trace = new ArrayList<Interaction>();
            for (var at = index; at != 0; at = parents.get(at)) {
                trace.add(parentInteractions.get(at));
            }
            Collections.reverse(trace);
            return List.copyOf(trace);
        }

        /**
         * One edge for each interaction that may happen in this state; those that lead to states that were not found
         * are missing.
         */
        public List<Edge> successors() {
            var edges = new ArrayList<Edge>();
            var state = found.get(index);
            enabled(state).stream().mapToObj(rules::get).forEach(rule -> {
                var target = indexes.get(target(rule, state));
                if (target != null) {
                    edges.add(new Edge(rule.interaction(), new State(target)));
                }
            });
            return List.copyOf(edges);
        }

        private BipStates owner() {
            return BipStates.this;
        }

        @Override
        public boolean equals(Object other) {
            return other instanceof State that && that.index == index && that.owner() == owner();
        }

        @Override
        public int hashCode() {
            return index;
        }

        /** {@code component.place} for each component. */
        @Override
        public String toString() {
            return String.join(
                    " ",
                    IntStream.range(0, components.size())
                            .mapToObj(i -> components.get(i) + "." + place(i))
                            .toList());
        }
    }

    /** An interaction and the state that it leads to. */
    public record Edge(Interaction interaction, State target) {}

    public BipModel model() {
        return model;
    }

    /** Why the search ended. */
    public SearchEnd end() {
        return end;
    }

    /** Whether these are all reachable states. */
    public boolean isComplete() {
        return end == SearchEnd.COMPLETE;
    }

    /** The number of states. */
    public int size() {
        return found.size();
    }

    /** How often an interaction can happen: its edges between these states, all interactions together. */
    public long edgeCount() {
        return edges;
    }

    /** All states, nearest first. */
    public List<State> states() {
        return IntStream.range(0, found.size()).mapToObj(State::new).toList();
    }

    /** The states without a further interaction, nearest first; if the search ended early, there may be more. */
    public List<State> dead() {
        return dead.stream().map(State::new).toList();
    }

    /** A nearest state with a property. */
    public Optional<State> find(Predicate<State> property) {
        return IntStream.range(0, found.size())
                .mapToObj(State::new)
                .filter(property)
                .findFirst();
    }

    /** How many states have a property. */
    public long count(Predicate<State> property) {
        return IntStream.range(0, found.size())
                .mapToObj(State::new)
                .filter(property)
                .count();
    }

    /** The connectors none of whose interactions ever happens; if the search ended early, they may happen elsewhere. */
    public List<String> neverFired() {
        var some = fired.stream()
                .mapToObj(i -> rules.get(i).interaction().connector().name())
                .toList();
        return model.connectors().stream()
                .map(Connector::name)
                .filter(each -> !some.contains(each))
                .toList();
    }

    /**
     * The states from which no state with a property can be reached any more, nearest first. Of incomplete states only
     * the edges between them count.
     */
    public List<State> neverAgain(Predicate<State> property) {
        var before = predecessors();
        var reaching = new BitSet();
        var open = new ArrayList<Integer>();
        for (var i = 0; i < found.size(); i++) {
            if (property.test(new State(i))) {
                reaching.set(i);
                open.add(i);
            }
        }
        while (!open.isEmpty()) {
            for (var from : before.get(open.removeLast())) {
                if (!reaching.get(from)) {
                    reaching.set(from);
                    open.add(from);
                }
            }
        }
        return IntStream.range(0, found.size())
                .filter(i -> !reaching.get(i))
                .mapToObj(State::new)
                .toList();
    }

    private List<List<Integer>> predecessors() {
        var before = new ArrayList<List<Integer>>();
        found.forEach(state -> before.add(new ArrayList<>()));
        for (var i = 0; i < expanded; i++) {
            for (var edge : new State(i).successors()) {
                before.get(edge.target().index()).add(i);
            }
        }
        return before;
    }

    /** In a few lines: how many states, and which of them are dead. */
    public String summary() {
        var text = new StringBuilder(model.name()).append(": ");
        text.append(size()).append(size() == 1 ? " state, " : " states, ");
        text.append(edges).append(edges == 1 ? " interaction, " : " interactions, ");
        text.append(
                switch (end) {
                    case COMPLETE -> "all of them";
                    case LIMIT -> "stopped at the limit";
                    case MEMORY -> "out of memory";
                    case CANCELLED -> "cancelled";
                });
        var soFar = isComplete() ? "" : " so far";
        text.append("\n  dead states").append(soFar).append(": ").append(dead.size());
        if (!dead.isEmpty()) {
            text.append(", the nearest ").append(dead().getFirst());
        }
        text.append("\n  connectors that never fire").append(soFar).append(": ");
        return text.append(neverFired().isEmpty() ? "none" : String.join(", ", neverFired()))
                .toString();
    }

    /** The first line of {@link #summary}. */
    @Override
    public String toString() {
        return summary().lines().findFirst().orElseThrow();
    }
}
