package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.IntFunction;
import java.util.function.IntUnaryOperator;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * Equal parts of a net: parts that can be exchanged for each other without a change of the net or of its initial
 * marking. A search then needs one marking of each <em>orbit</em>, that is, of all markings that differ only in which
 * of the equal parts is in which state. Of n equal parts with k states each there are fewer than (n + 1)^(k-1) orbits,
 * but up to k^n markings.
 *
 * {@snippet :
 * var symmetry = Symmetry.find(net);
 * var graph = ReachabilityGraph.exploreMarkings(net, symmetry, LIMITS);
 * }
 *
 * <p><b>Role.</b> Found by {@link #find} or declared by {@link #of}, and checked in both cases: every exchange of two
 * blocks of a group maps transitions to transitions with the same priority, arcs, weights and inhibitor arcs, and keeps
 * the initial marking. Used by {@link ReachabilityGraph#explore(PetriNet, Symmetry, SearchLimits)} and
 * {@link DeadlockSearch}. The turns of a ring are not used, only groups whose blocks may come in any order.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Order.</b> The marking that stands for its orbit has the blocks of each group sorted by their tokens, place by
 * place.
 *
 * <p><b>Cost.</b> To find and check it: in proportion to the arcs, mostly. In a search: a comparison of each block with
 * its neighbour for each firing.
 */
public final class Symmetry {
    private final PetriNet net;
    private final List<Group> groups;
    /** By group and block: the places. */
    private final int[][][] blocks;
    /** By transition: what it does. */
    private final List<Effect> effects = new ArrayList<>();
    /** The transitions that do the same. */
    private final Map<Effect, List<Transition>> transitions = new HashMap<>();
    /** By place: the transitions next to it. */
    private final IntList[] around;

    /**
     * Parts that are equal to each other.
     *
     * @param blocks the places of each part, in corresponding order; two blocks or more
     */
    public record Group(List<List<Place>> blocks) {
        public Group {
            blocks = blocks.stream().map(List::copyOf).toList();
        }
    }

    /** What a transition does: places and weights, sorted. */
    private record Effect(int priority, List<Long> inputs, List<Long> outputs, List<Long> inhibitors) {
        static Effect of(Transition transition, IntUnaryOperator move) {
            return new Effect(
                    transition.priority(),
                    arcs(transition.inputs(), move),
                    arcs(transition.outputs(), move),
                    arcs(transition.inhibitors(), move));
        }

        private static List<Long> arcs(List<Arc> arcs, IntUnaryOperator move) {
            return arcs.stream()
                    .map(arc -> (long) move.applyAsInt(arc.place().index()) << Integer.SIZE | arc.weight())
                    .sorted()
                    .toList();
        }
    }

    private Symmetry(PetriNet net, List<Group> groups) {
        this.net = net;
        this.groups = List.copyOf(groups);
        blocks = groups.stream()
                .map(group -> group.blocks().stream()
                        .map(block -> block.stream().mapToInt(Place::index).toArray())
                        .toArray(int[][]::new))
                .toArray(int[][][]::new);
        around = net.places().stream().map(place -> new IntList(0)).toArray(IntList[]::new);
    }

    /** Called before parts are compared or exchanged. */
    private Symmetry indexed() {
        for (var t : net.transitions()) {
            var effect = Effect.of(t, IntUnaryOperator.identity());
            effects.add(effect);
            transitions.computeIfAbsent(effect, each -> new ArrayList<>(1)).add(t);
        }
        net.transitions()
                .forEach(t -> Stream.of(t.inputs(), t.outputs(), t.inhibitors())
                        .flatMap(List::stream)
                        .map(arc -> arc.place().index())
                        .distinct()
                        .forEach(place -> around[place].add(t.index())));
        return this;
    }

    /** No equal parts: every marking is an orbit by itself. */
    public static Symmetry none(PetriNet net) {
        return new Symmetry(net, List.of());
    }

    /**
     * The symmetry of these groups.
     *
     * @throws IllegalArgumentException if a group has fewer than two blocks, blocks of different sizes, or a place that
     *     is not of the net or is in another block; or if the exchange of two of its blocks changes the net or its
     *     initial marking: the message names a transition or a place that has no counterpart
     */
    public static Symmetry of(PetriNet net, List<Group> groups) {
        var symmetry = new Symmetry(net, groups).indexed();
        symmetry.requireBlocks();
        for (var group : symmetry.blocks) {
            for (var i = 1; i < group.length; i++) {
                var wrong = symmetry.whyNotEqual(group[i - 1], group[i]);
                if (!wrong.isEmpty()) {
                    throw new IllegalArgumentException("net " + net.name() + ": blocks " + symmetry.names(group[i - 1])
                            + " and " + symmetry.names(group[i]) + " are not equal: " + wrong);
                }
            }
        }
        return symmetry;
    }

    /** Looks for groups of equal parts. It may miss some, for example equal parts inside of equal parts. */
    public static Symmetry find(PetriNet net) {
        var none = none(net).indexed();
        var found = new ArrayList<Group>();
        for (var group : new SymmetryFinder(net).groups()) {
            if (none.areEqual(group)) {
                found.add(new Group(group.stream()
                        .map(block ->
                                Arrays.stream(block).mapToObj(net.places()::get).toList())
                        .toList()));
            }
        }
        return found.isEmpty() ? none(net) : new Symmetry(net, found).indexed();
    }

    private void requireBlocks() {
        var seen = new HashSet<Place>();
        for (var group : groups) {
            require(group.blocks().size() > 1, "a group has " + group.blocks().size() + " blocks, expected 2 or more");
            for (var block : group.blocks()) {
                var size = group.blocks().get(0).size();
                require(
                        block.size() == size && size > 0,
                        "block " + block + " has " + block.size() + " places, expected " + Math.max(1, size)
                                + " as in the others of its group");
                for (var place : block) {
                    require(net.places().contains(place), "place " + place + " is not of this net");
                    require(seen.add(place), "place " + place + " is in two blocks, expected one");
                }
            }
        }
    }

    private void require(boolean condition, String message) {
        if (!condition) {
            throw new IllegalArgumentException("net " + net.name() + ": " + message);
        }
    }

    private boolean areEqual(List<int[]> group) {
        for (var i = 1; i < group.size(); i++) {
            if (!whyNotEqual(group.get(i - 1), group.get(i)).isEmpty()) {
                return false;
            }
        }
        return true;
    }

    /** Why the exchange of two blocks is no symmetry; empty if it is one. Such exchanges give all orders of a group. */
    private String whyNotEqual(int[] one, int[] other) {
        var moved = new TreeMap<Integer, Integer>();
        for (var i = 0; i < one.length; i++) {
            var left = net.places().get(one[i]);
            var right = net.places().get(other[i]);
            if (left.tokens() != right.tokens()) {
                return "place " + left + " holds " + left.tokens() + " tokens, place " + right + " " + right.tokens();
            }
            moved.put(one[i], other[i]);
            moved.put(other[i], one[i]);
        }
        for (var place : moved.keySet()) {
            for (var t : around[place].toArray()) {
                var transition = net.transitions().get(t);
                var image = Effect.of(transition, each -> moved.getOrDefault(each, each));
                if (with(image).size() != with(effects.get(t)).size()) {
                    return "transition " + transition + " has no counterpart";
                }
            }
        }
        return "";
    }

    private String names(int[] block) {
        return Arrays.stream(block)
                .mapToObj(p -> net.places().get(p).name())
                .collect(Collectors.joining(", ", "[", "]"));
    }

    public PetriNet net() {
        return net;
    }

    /** The groups of equal parts; no place is in two of them. */
    public List<Group> groups() {
        return groups;
    }

    /** Whether there are no equal parts. */
    public boolean isTrivial() {
        return groups.isEmpty();
    }

    /** The symmetry that is left if the part with {@code place} must stay where it is. */
    public Symmetry fixing(Place place) {
        return new Symmetry(
                        net,
                        groups.stream()
                                .map(group -> new Group(group.blocks().stream()
                                        .filter(block -> !block.contains(place))
                                        .toList()))
                                .filter(group -> group.blocks().size() > 1)
                                .toList())
                .indexed();
    }

    /** Whether every exchange of equal parts maps these transitions to each other. */
    public boolean keeps(Set<Transition> some) {
        return orbits(some).equals(withEqual(some));
    }

    /** Whether the exchange of two equal parts maps {@code ones} to {@code others}, and these to {@code ones}. */
    public boolean exchanges(Set<Transition> ones, Set<Transition> others) {
        var from = effects(ones);
        var wanted = effects(others);
        for (var group : blocks) {
            for (var i : from.equals(wanted) ? numbers(group) : touched(group, ones)) {
                for (var j : numbers(group)) {
                    var exchange = exchange(group[i], group[j]);
                    if (i != j
                            && ones.stream().map(t -> Effect.of(t, exchange)).allMatch(wanted::contains)
                            && others.stream().map(t -> Effect.of(t, exchange)).allMatch(from::contains)) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    /** The marking that stands for the orbit of {@code marking}. */
    public Marking representative(Marking marking) {
        marking.requirePlaces(net.places(), net.name());
        if (isTrivial()) {
            return marking;
        }
        var tokens = marking.toArray();
        new Sorter(this).sort(tokens);
        return new Marking(net.places(), tokens);
    }

    /** The sizes of the groups, for example {@code 20 equal parts}; empty if there are none. */
    @Override
    public String toString() {
        return groups.stream()
                .map(group -> group.blocks().size() + " equal parts")
                .collect(Collectors.joining(" and "));
    }

    /** Sorts the blocks of markings; not thread-safe. */
    static final class Sorter {
        private final int[][][] blocks;
        /** By group: the number of the block that came to each position. */
        private final int[][] order;

        private final long[] copy;

        Sorter(Symmetry symmetry) {
            blocks = symmetry.blocks;
            order = Arrays.stream(blocks).map(group -> new int[group.length]).toArray(int[][]::new);
            copy = new long[symmetry.net.places().size()];
        }

        void sort(long[] tokens) {
            for (var g = 0; g < blocks.length; g++) {
                if (findOrder(blocks[g], order[g], tokens)) {
                    System.arraycopy(tokens, 0, copy, 0, tokens.length);
                    move(blocks[g], order[g], copy, tokens);
                }
            }
        }

        /** By insertion, because a firing changes few blocks of a sorted marking; true if the order changes. */
        private static boolean findOrder(int[][] group, int[] order, long[] tokens) {
            var isMoved = false;
            for (var i = 0; i < group.length; i++) {
                var at = i;
                while (at > 0 && isGreater(group[order[at - 1]], group[i], tokens)) {
                    order[at] = order[at - 1];
                    at--;
                }
                order[at] = i;
                isMoved |= at < i;
            }
            return isMoved;
        }

        private static boolean isGreater(int[] one, int[] other, long[] tokens) {
            for (var i = 0; i < one.length; i++) {
                if (tokens[one[i]] != tokens[other[i]]) {
                    return tokens[one[i]] > tokens[other[i]];
                }
            }
            return false;
        }

        private static void move(int[][] group, int[] order, long[] from, long[] to) {
            for (var k = 0; k < group.length; k++) {
                for (var j = 0; j < group[k].length; j++) {
                    to[group[k][j]] = from[group[order[k]][j]];
                }
            }
        }

        /** Changes {@code places}, the place to which each place is moved, so that the last sorting comes first. */
        private void before(int[] places) {
            var old = places.clone();
            for (var g = 0; g < blocks.length; g++) {
                for (var k = 0; k < blocks[g].length; k++) {
                    for (var j = 0; j < blocks[g][k].length; j++) {
                        places[blocks[g][order[g][k]][j]] = old[blocks[g][k][j]];
                    }
                }
            }
        }
    }

    /**
     * The firing sequence of a search of sorted markings: each follows from the one before it by a firing and by
     * sorting. The sequence here, without sorting, leads from the initial marking to the last of them.
     *
     * @param length the number of firings
     * @param before the sorted marking before a firing, by its number from 0
     * @param fired the transition that the search fired in it
     */
    List<Transition> trace(int length, IntFunction<long[]> before, IntUnaryOperator fired) {
        var sorter = new Sorter(this);
        var moved = new int[net.places().size()];
        Arrays.setAll(moved, place -> place);
        var trace = new ArrayList<Transition>();
        for (var i = length - 1; i >= 0; i--) {
            var t = net.transitions().get(fired.applyAsInt(i));
            var tokens = before.apply(i);
            t.inputs().forEach(arc -> tokens[arc.place().index()] -= arc.weight());
            t.outputs().forEach(arc -> tokens[arc.place().index()] += arc.weight());
            sorter.sort(tokens);
            sorter.before(moved);
            trace.add(image(t, place -> moved[place]));
        }
        Collections.reverse(trace);
        return List.copyOf(trace);
    }

    private Transition image(Transition transition, IntUnaryOperator move) {
        var found = transitions.get(Effect.of(transition, move));
        return requireNonNull(found, "a symmetry maps transitions to others").get(0);
    }

    /** The places that a place can be exchanged for, with itself. */
    List<Place> orbit(Place place) {
        for (var group : groups) {
            for (var block : group.blocks()) {
                var position = block.indexOf(place);
                if (position >= 0) {
                    return group.blocks().stream()
                            .map(each -> each.get(position))
                            .toList();
                }
            }
        }
        return List.of(place);
    }

    /** The transitions of {@code some}, all that these can be exchanged for, and all with the same arcs. */
    Set<Transition> orbits(Set<Transition> some) {
        var known = effects(some);
        var waiting = new ArrayDeque<>(some);
        while (!waiting.isEmpty()) {
            var t = waiting.remove();
            for (var group : blocks) {
                for (var i = 1; i < group.length; i++) {
                    var exchange = exchange(group[i - 1], group[i]);
                    if (known.add(Effect.of(t, exchange))) {
                        waiting.add(image(t, exchange));
                    }
                }
            }
        }
        return with(known);
    }

    /** The transitions of {@code some}, and all with the same arcs. */
    private Set<Transition> withEqual(Set<Transition> some) {
        return with(effects(some));
    }

    private Set<Effect> effects(Set<Transition> some) {
        return some.stream().map(t -> effects.get(t.index())).collect(Collectors.toCollection(HashSet::new));
    }

    private Set<Transition> with(Set<Effect> some) {
        return some.stream().flatMap(effect -> with(effect).stream()).collect(Collectors.toSet());
    }

    private List<Transition> with(Effect effect) {
        return transitions.getOrDefault(effect, List.of());
    }

    /** The numbers of the blocks of a group that have a place next to one of these transitions. */
    private static int[] touched(int[][] group, Set<Transition> some) {
        var places = some.stream()
                .flatMap(t -> Stream.of(t.inputs(), t.outputs(), t.inhibitors()))
                .flatMap(List::stream)
                .map(arc -> arc.place().index())
                .collect(Collectors.toSet());
        return IntStream.range(0, group.length)
                .filter(i -> Arrays.stream(group[i]).anyMatch(places::contains))
                .toArray();
    }

    private static int[] numbers(int[][] group) {
        return IntStream.range(0, group.length).toArray();
    }

    private static IntUnaryOperator exchange(int[] one, int[] other) {
        var moved = new HashMap<Integer, Integer>();
        for (var i = 0; i < one.length; i++) {
            moved.put(one[i], other[i]);
            moved.put(other[i], one[i]);
        }
        return place -> moved.getOrDefault(place, place);
    }
}
