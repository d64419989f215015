package io.troupe.petri;

import java.util.Arrays;
import java.util.BitSet;
import java.util.List;
import java.util.stream.IntStream;

/**
 * Follows only the transitions of one strong stubborn set from each marking (Valmari 1988).
 *
 * <p>A set is stubborn if it contains a transition that may fire, and firings outside it can neither disable its
 * transitions nor make others of it ready. So every firing sequence to a dead marking has a permutation that starts
 * inside the set, and no dead marking is missed. A set is closed under two rules:
 *
 * <ul>
 *   <li>for a ready member, add all transitions that take tokens which it needs; and, of the places that it takes
 *       tokens from, all users;
 *   <li>for a member that is not ready, add all transitions that put tokens on one place that lacks them.
 * </ul>
 *
 * <p>The set is computed from each ready transition, and the one with the fewest ready members is used. With
 * priorities, firings outside the set have further effects; then there is no reduction.
 */
final class StubbornSets implements Expansion {
    private final FiringRules rules;
    /** By transition: the transitions that may disable it or that need the tokens it takes. */
    private final int[][] rivals;
    /** By place: the transitions that put more tokens on it than they take. */
    private final int[][] feeders;

    private final int[] ready;
    private final int[] members;
    private final int[] readyMembers;
    private final boolean[] isReady;
    private final boolean[] isMember;
    private int size;
    private int readyCount;

    StubbornSets(PetriNet net) {
        rules = new FiringRules(net);
        var transitions = net.transitions();
        var takers = new IntList[net.places().size()];
        var puts = new IntList[net.places().size()];
        for (var place = 0; place < takers.length; place++) {
            takers[place] = new IntList(0);
            puts[place] = new IntList(0);
        }
        for (var t : transitions) {
            for (var arc : t.inputs()) {
                takers[arc.place().index()].add(t.index());
            }
            for (var arc : t.outputs()) {
                if (arc.weight() > weight(t.inputs(), arc.place())) {
                    puts[arc.place().index()].add(t.index());
                }
            }
        }
        feeders = Arrays.stream(puts).map(IntList::toArray).toArray(int[][]::new);
        rivals = transitions.stream().map(t -> rivals(t, transitions, takers)).toArray(int[][]::new);
        ready = new int[transitions.size()];
        members = new int[transitions.size()];
        readyMembers = new int[transitions.size()];
        isReady = new boolean[transitions.size()];
        isMember = new boolean[transitions.size()];
    }

    /** The transitions that share an input place with t, except where neither changes the tokens on that place. */
    private static int[] rivals(Transition t, List<Transition> transitions, IntList[] takers) {
        var found = new BitSet();
        for (var arc : t.inputs()) {
            var place = arc.place();
            var takes = arc.weight() > weight(t.outputs(), place);
            for (var other : takers[place.index()].toArray()) {
                if (takes || takesFrom(place, transitions.get(other))) {
                    found.set(other);
                }
            }
        }
        return found.stream().toArray();
    }

    private static boolean takesFrom(Place place, Transition transition) {
        return weight(transition.inputs(), place) > weight(transition.outputs(), place);
    }

    private static int weight(List<Arc> arcs, Place place) {
        for (var arc : arcs) {
            if (arc.place().index() == place.index()) {
                return arc.weight();
            }
        }
        return 0;
    }

    @Override
    public int choose(int[] tokens, int[] chosen) {
        var count = rules.choose(tokens, ready);
        readyCount = count;
        if (rules.isPrioritised() || count <= 1) {
            System.arraycopy(ready, 0, chosen, 0, count);
            return count;
        }
        Arrays.fill(isReady, false);
        for (var i = 0; i < count; i++) {
            isReady[ready[i]] = true;
        }
        var fewest = Integer.MAX_VALUE;
        for (var i = 0; i < count && fewest > 1; i++) {
            var closed = close(ready[i], tokens, fewest);
            if (closed < fewest) {
                fewest = closed;
                System.arraycopy(readyMembers, 0, chosen, 0, closed);
            }
        }
        Arrays.sort(chosen, 0, fewest);
        return fewest;
    }

    /**
     * Called after {@link #choose}. If only transitions of {@code looping} were chosen, adds the smallest stubborn set
     * with a ready transition outside of {@code looping}, if there is one. The union of stubborn sets is stubborn.
     */
    int widen(int[] tokens, int[] chosen, int count, boolean[] looping) {
        if (rules.isPrioritised() || count == readyCount) {
            return count;
        }
        for (var i = 0; i < count; i++) {
            if (!looping[chosen[i]]) {
                return count;
            }
        }
        var added = new int[0];
        for (var i = 0; i < readyCount; i++) {
            if (!looping[ready[i]]) {
                var closed = close(ready[i], tokens, added.length == 0 ? Integer.MAX_VALUE : added.length);
                added = added.length == 0 || closed < added.length ? Arrays.copyOf(readyMembers, closed) : added;
            }
        }
        var union = IntStream.concat(IntStream.of(chosen).limit(count), IntStream.of(added))
                .distinct()
                .sorted()
                .toArray();
        System.arraycopy(union, 0, chosen, 0, union.length);
        return union.length;
    }

    /** Fills {@code readyMembers} from the closure of {@code start}; gives up once there are {@code enough} of them. */
    private int close(int start, int[] tokens, int enough) {
        Arrays.fill(isMember, false);
        size = 0;
        add(start);
        var found = 0;
        for (var i = 0; i < size; i++) {
            var t = members[i];
            if (isReady[t]) {
                readyMembers[found++] = t;
                if (found >= enough) {
                    return found;
                }
                add(rivals[t]);
            } else {
                add(feeders[lacking(t, tokens)]);
            }
        }
        return found;
    }

    /** Of the places that lack tokens for t, the one that adds the fewest members. */
    private int lacking(int t, int[] tokens) {
        var best = -1;
        var fewest = Integer.MAX_VALUE;
        for (var i = 0; i < rules.inputs[t].length; i++) {
            var place = rules.inputs[t][i];
            if (tokens[place] < rules.inputWeights[t][i]) {
                var added = (int) IntStream.of(feeders[place])
                        .filter(feeder -> !isMember[feeder])
                        .count();
                if (added < fewest) {
                    fewest = added;
                    best = place;
                }
            }
        }
        return best;
    }

    private void add(int[] transitions) {
        for (var t : transitions) {
            add(t);
        }
    }

    private void add(int t) {
        if (!isMember[t]) {
            isMember[t] = true;
            members[size++] = t;
        }
    }
}
