package io.troupe.petri;

import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.function.IntUnaryOperator;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * The reachable markings of a net, and the firings between them.
 *
 * <p><b>Role.</b> Made by {@link #explore}. If the net has more markings than the limit, or the search is cancelled or
 * out of memory, the graph is incomplete: {@link #isComplete} is false, {@link #summary} describes what is then known,
 * and the Javadoc of each method defines its answer for that case. In an incomplete graph, too, every marking is
 * reachable and every trace is a shortest one. Every marking was tested for being dead, unless the search was cancelled
 * or ran out of memory. {@link Liveness} derives further properties from the graph; {@link DeadlockSearch} finds the
 * dead markings with less work.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> Breadth first; at equal distance in the order of the transitions of the net.
 *
 * <p><b>Cost.</b> For each marking 16 to 24 bytes (while the hash table grows at most 40), and one bit for every place
 * of a safe net (more bits if the tokens require it); 8 bytes for each edge, unless edges are not stored. Time in
 * proportion to markings x transitions.
 */
public final class ReachabilityGraph {
    /** The limit of {@link #explore(PetriNet)}. */
    public static final int DEFAULT_MAX_MARKINGS = 2_000_000;

    private final Exploration found;

    private ReachabilityGraph(Exploration found) {
        this.found = found;
    }

    /** Explores up to {@link #DEFAULT_MAX_MARKINGS} markings. */
    public static ReachabilityGraph explore(PetriNet net) {
        return explore(net, DEFAULT_MAX_MARKINGS);
    }

    /**
     * Explores up to {@code maxMarkings} (1 or more) markings.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ReachabilityGraph explore(PetriNet net, int maxMarkings) {
        return explore(net, SearchLimits.markings(maxMarkings));
    }

    /**
     * Explores within {@code limits}.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ReachabilityGraph explore(PetriNet net, SearchLimits limits) {
        return explore(net, Chooser.ALL, limits);
    }

    /**
     * Explores within {@code limits} without storing the edges, which are most of the memory of a large graph.
     * Successors are computed by firing, each time they are read. {@link Liveness} needs stored edges.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ReachabilityGraph exploreMarkings(PetriNet net, SearchLimits limits) {
        return withoutEdges(net, Chooser.ALL, Symmetry.none(net), limits);
    }

    /**
     * Explores within {@code limits} one marking of each orbit of {@code symmetry}, and stores the edges between these.
     * Every reachable marking differs from one of these only in which of the equal parts is in which state, so the
     * graph has a dead marking if the net has one, at the same distance. An edge leads to the marking that stands for
     * the orbit of the successor. The numbers of markings and edges are those of the orbits; all other results are
     * those of the net. Questions about one of the equal parts need {@link Symmetry#fixing}; {@link Liveness} refuses
     * this graph.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ReachabilityGraph explore(PetriNet net, Symmetry symmetry, SearchLimits limits) {
        return explore(net, Chooser.ALL, symmetry, limits, true);
    }

    /**
     * Explores as {@link #explore(PetriNet, Symmetry, SearchLimits)} does, without storing the edges.
     *
     * @throws ArithmeticException if a place can hold more than {@link Long#MAX_VALUE} tokens
     */
    public static ReachabilityGraph exploreMarkings(PetriNet net, Symmetry symmetry, SearchLimits limits) {
        return withoutEdges(net, Chooser.ALL, symmetry, limits);
    }

    static ReachabilityGraph explore(PetriNet net, Chooser chooser, SearchLimits limits) {
        return explore(net, chooser, Symmetry.none(net), limits, true);
    }

    static ReachabilityGraph withoutEdges(PetriNet net, Chooser chooser, Symmetry symmetry, SearchLimits limits) {
        return explore(net, chooser, symmetry, limits, false);
    }

    /** Ends at the first dead marking; its trace is not always a shortest one. */
    static ReachabilityGraph toFirstDead(PetriNet net, Chooser chooser, Symmetry symmetry, SearchLimits limits) {
        var exploration = new Exploration(net, chooser, requireOf(net, symmetry), limits, false);
        exploration.runToFirstDead();
        return new ReachabilityGraph(exploration);
    }

    static ReachabilityGraph explore(
            PetriNet net, Chooser chooser, Symmetry symmetry, SearchLimits limits, boolean keepsEdges) {
        var exploration = new Exploration(net, chooser, requireOf(net, symmetry), limits, keepsEdges);
        exploration.run();
        return new ReachabilityGraph(exploration);
    }

    private static Symmetry requireOf(PetriNet net, Symmetry symmetry) {
        if (symmetry.net() != net) {
            throw new IllegalArgumentException(
                    "the symmetry is of net " + symmetry.net().name() + ", expected one of net " + net.name());
        }
        return symmetry;
    }

    /** A reachable marking and its position in the graph. */
    public final class State {
        private final int index;

        private State(int index) {
            this.index = index;
        }

        /** Its position in {@link #states}; 0 is the initial marking. */
        public int index() {
            return index;
        }

        public Marking marking() {
            return new Marking(net().places(), tokens(index));
        }

        /** A shortest firing sequence from the initial marking to this one. */
        public List<Transition> shortestTrace() {
            var way = new IntList();
            for (var at = index; at != 0; at = found.parent.get(at)) {
                way.add(at);
            }
            var length = way.size();
            IntUnaryOperator fired = i -> found.parentTransition.get(way.get(length - 1 - i));
            if (found.symmetry.isTrivial()) {
                return IntStream.range(0, length)
                        .map(fired)
                        .mapToObj(net().transitions()::get)
                        .toList();
            }
            return found.symmetry.trace(length, i -> tokens(i == 0 ? 0 : way.get(length - i)), fired);
        }

        private long[] tokens(int id) {
            var tokens = new long[net().places().size()];
            found.store.read(id, tokens);
            return tokens;
        }

        /**
         * Whether successors of this marking are missing: they lie beyond the limit, or the search was cancelled before
         * it computed them.
         */
        public boolean isOpen() {
            return found.isOpen(index);
        }

        /**
         * One edge for each transition that may fire in this marking; some or all are missing if the marking is open.
         */
        public List<Edge> successors() {
            if (!found.keepsEdges()) {
                return computedSuccessors();
            }
            return IntStream.range(found.edgeStart(index), found.edgeEnd(index))
                    .mapToObj(edge -> new Edge(
                            net().transitions().get(found.edgeTransition.get(edge)),
                            new State(found.edgeTarget.get(edge))))
                    .toList();
        }

        private List<Edge> computedSuccessors() {
            var marking = marking();
            return net().enabled(marking).stream()
                    .flatMap(t ->
                            ReachabilityGraph.this.find(net().fire(marking, t)).map(to -> new Edge(t, to)).stream())
                    .toList();
        }

        private ReachabilityGraph graph() {
            return ReachabilityGraph.this;
        }

        @Override
        public boolean equals(Object other) {
            return other instanceof State that && that.index == index && that.graph() == graph();
        }

        @Override
        public int hashCode() {
            return index;
        }

        /** The marking. */
        @Override
        public String toString() {
            return marking().toString();
        }
    }

    /** A firing and the state that it leads to. */
    public record Edge(Transition transition, State target) {}

    public PetriNet net() {
        return found.net;
    }

    /** Whether these are all reachable markings. */
    public boolean isComplete() {
        return found.end == SearchEnd.COMPLETE;
    }

    /** Why the search ended. */
    public SearchEnd end() {
        return found.end;
    }

    /** The number of markings. */
    public int size() {
        return found.store.size();
    }

    /** The bytes that a marking itself takes, without its place in the search. */
    public int bytesPerMarking() {
        return Long.BYTES * found.store.words();
    }

    /** The number of edges between these markings. */
    public int edgeCount() {
        return found.edgeCount();
    }

    /** How many of these markings are {@link State#isOpen open}; 0 if the graph is complete. */
    public int openCount() {
        return found.openCount();
    }

    /** The symmetry whose orbits have one marking each in this graph. */
    public Symmetry symmetry() {
        return found.symmetry;
    }

    /** Whether edges are stored; if not, successors are computed on each access. */
    public boolean hasEdges() {
        return found.keepsEdges();
    }

    Exploration found() {
        return found;
    }

    State state(int index) {
        return new State(index);
    }

    /** All markings, nearest first. */
    public List<State> states() {
        return new ComputedList<>(size(), State::new);
    }

    /**
     * The state of a marking, or of the marking that stands for its orbit; empty if the marking was not reached, which
     * in a complete graph means that it is unreachable.
     */
    public Optional<State> find(Marking marking) {
        marking.requirePlaces(net().places(), net().name());
        var tokens = found.symmetry.representative(marking).toArray();
        if (Arrays.stream(tokens).anyMatch(held -> held > found.store.capacity())) {
            return Optional.empty();
        }
        var index = found.store.find(found.store.pack(tokens));
        return index < 0 ? Optional.empty() : Optional.of(new State(index));
    }

    /**
     * The dead markings, in which no transition may fire, nearest first; if the graph is incomplete, there may be more.
     */
    public List<State> dead() {
        return new ComputedList<>(found.dead.size(), i -> new State(found.dead.get(i)));
    }

    /** Whether no reachable marking is dead. */
    public Verdict deadlockFree() {
        if (found.dead.size() > 0) {
            return Verdict.NO;
        }
        return isComplete() ? Verdict.YES : Verdict.UNKNOWN;
    }

    /**
     * The largest number of tokens found on a place. In a complete graph this is its bound; otherwise the bound may be
     * higher.
     */
    public long mostTokens(Place place) {
        if (!net().places().contains(place)) {
            throw new IllegalArgumentException("place " + place + " is not of net " + net().name());
        }
        return most(place);
    }

    private long most(Place place) {
        return found.symmetry.orbit(place).stream()
                .mapToLong(each -> found.most[each.index()])
                .max()
                .orElseThrow();
    }

    /**
     * The largest number of tokens found on any place, 1 for a safe net; if the graph is incomplete, the bound may be
     * higher.
     */
    public long mostTokens() {
        return Arrays.stream(found.most).max().orElse(0);
    }

    /** Whether no place ever holds more than one token. */
    public Verdict safe() {
        if (mostTokens() > 1) {
            return Verdict.NO;
        }
        return isComplete() ? Verdict.YES : Verdict.UNKNOWN;
    }

    /**
     * The places that never hold a token. In a complete graph these are the dead places; otherwise they may still be
     * marked in markings not visited.
     */
    public List<Place> neverMarked() {
        return net().places().stream().filter(place -> most(place) == 0).toList();
    }

    /**
     * The transitions that never may fire. In a complete graph these are the dead transitions; otherwise they may still
     * fire in markings not visited.
     */
    public List<Transition> neverFired() {
        var fired =
                net().transitions().stream().filter(t -> found.fired[t.index()]).collect(Collectors.toSet());
        var all = found.symmetry.isTrivial() ? fired : found.symmetry.orbits(fired);
        return net().transitions().stream().filter(t -> !all.contains(t)).toList();
    }

    /** In a few lines: the result and, if the search ended early, what is not known. */
    public String summary() {
        var text = new StringBuilder(net().name()).append(": ");
        if (isComplete()) {
            text.append(size())
                    .append(markings())
                    .append(", ")
                    .append(edgeCount())
                    .append(" edges, all of them");
        } else if (end() == SearchEnd.MEMORY) {
            text.append("out of memory at ").append(size()).append(markings()).append("; ");
            text.append(openCount()).append(" of them may have successors that were not visited");
        } else if (end() == SearchEnd.LIMIT) {
            text.append("stopped at the limit of ")
                    .append(size())
                    .append(markings())
                    .append("; ");
            text.append(openCount()).append(" of them have successors beyond it, which were not visited");
        } else {
            text.append("cancelled at ").append(size()).append(markings()).append("; ");
            text.append(openCount()).append(" of them may have successors that were not visited");
        }
        var soFar = isComplete() ? "" : " so far";
        text.append("\n  dead markings").append(soFar).append(": ").append(found.dead.size());
        if (found.dead.size() > 0) {
            var nearest = new State(found.dead.get(0));
            text.append(", the nearest ")
                    .append(nearest)
                    .append(" after ")
                    .append(Shortened.list(nearest.shortestTrace()));
        } else if (!isComplete()) {
            text.append("; whether there are others is not known");
        }
        text.append("\n  most tokens on a place").append(soFar).append(": ").append(mostTokens());
        text.append("\n  places never marked").append(soFar).append(": ").append(Shortened.list(neverMarked()));
        text.append("\n  transitions never enabled").append(soFar).append(": ").append(Shortened.list(neverFired()));
        return text.toString();
    }

    private String markings() {
        return found.symmetry.isTrivial() ? " markings" : " orbits of markings (" + found.symmetry + ")";
    }

    /** The first line of {@link #summary}. */
    @Override
    public String toString() {
        return summary().lines().findFirst().orElseThrow();
    }
}
