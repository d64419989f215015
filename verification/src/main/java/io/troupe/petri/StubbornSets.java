package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.Arrays;
import java.util.BitSet;
import java.util.List;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Follows only the transitions of one strong stubborn set from each marking (Valmari 1988).
 *
 * <p>A set is stubborn if it contains a transition that may fire, and firings outside it can neither disable its
 * transitions nor make others of it ready. So every firing sequence to a dead marking has a permutation that starts
 * inside the set, and no dead marking is missed. A set is closed under two rules:
 *
 * <ul>
 *   <li>for a ready member, add all transitions that take tokens which it needs, or put tokens where they inhibit it;
 *       and all transitions that need the tokens that it takes, or are inhibited by the tokens that it puts;
 *   <li>for a member that is not ready, add all transitions that put tokens on one place that lacks them, or that take
 *       tokens from one place that inhibits it.
 * </ul>
 *
 * <p>The set is computed from each ready transition, and the one with the fewest ready members is used. With
 * priorities, firings outside the set have further effects; then there is no reduction.
 */
final class StubbornSets implements Chooser {
    private final CompiledNet rules;
    /** By transition: the transitions that may disable it, or that it may disable. */
    private final int[][] rivals;
    /** By place: the transitions that put more tokens on it than they take. */
    private final int[][] feeders;
    /** By place: the transitions that take more tokens from it than they put. */
    private final int[][] drainers;

    private final int[] ready;
    private final int[] members;
    private final int[] readyMembers;
    private final boolean[] isMember;
    private int size;
    private int readyCount;

    StubbornSets(PetriNet net) {
        rules = net.compiled();
        var transitions = net.transitions();
        var users = lists(net);
        var puts = lists(net);
        var takes = lists(net);
        var inhibited = lists(net);
        for (var t : transitions) {
            for (var arc : t.inputs()) {
                users[arc.place().index()].add(t.index());
                if (takesFrom(arc.place(), t)) {
                    takes[arc.place().index()].add(t.index());
                }
            }
            for (var arc : t.outputs()) {
                if (putsOn(arc.place(), t)) {
                    puts[arc.place().index()].add(t.index());
                }
            }
            t.inhibitors().forEach(arc -> inhibited[arc.place().index()].add(t.index()));
        }
        feeders = Arrays.stream(puts).map(IntList::toArray).toArray(int[][]::new);
        drainers = Arrays.stream(takes).map(IntList::toArray).toArray(int[][]::new);
        rivals = transitions.stream()
                .map(t -> rivals(t, transitions, users, inhibited))
                .toArray(int[][]::new);
        ready = new int[transitions.size()];
        members = new int[transitions.size()];
        readyMembers = new int[transitions.size()];
        isMember = new boolean[transitions.size()];
    }

    private static IntList[] lists(PetriNet net) {
        return net.places().stream().map(place -> new IntList(0)).toArray(IntList[]::new);
    }

    /**
     * The transitions that share an input place with t, except where neither changes the tokens on that place; those
     * that inhibit t, and those that t inhibits.
     */
    private int[] rivals(Transition t, List<Transition> transitions, IntList[] users, IntList[] inhibited) {
        var found = new BitSet();
        for (var arc : t.inputs()) {
            var place = arc.place();
            var takes = takesFrom(place, t);
            for (var other : users[place.index()].toArray()) {
                if (takes || takesFrom(place, transitions.get(other))) {
                    found.set(other);
                }
            }
        }
        for (var arc : t.inhibitors()) {
            IntStream.of(feeders[arc.place().index()]).forEach(found::set);
        }
        for (var arc : t.outputs()) {
            if (putsOn(arc.place(), t)) {
                IntStream.of(inhibited[arc.place().index()].toArray()).forEach(found::set);
            }
        }
        return found.stream().toArray();
    }

    private static boolean putsOn(Place place, Transition transition) {
        return weight(transition.outputs(), place) > weight(transition.inputs(), place);
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
    public int choose(TokenGame game, int[] chosen) {
        var count = ALL.choose(game, ready);
        readyCount = count;
        if (rules.isPrioritised || count <= 1) {
            System.arraycopy(ready, 0, chosen, 0, count);
            return count;
        }
        var fewest = Integer.MAX_VALUE;
        for (var i = 0; i < count && fewest > 1; i++) {
            var closed = close(ready[i], game, fewest);
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
    int widen(TokenGame game, int[] chosen, int count, boolean[] looping) {
        if (rules.isPrioritised || count == readyCount) {
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
                var closed = close(ready[i], game, added.length == 0 ? Integer.MAX_VALUE : added.length);
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
    private int close(int start, TokenGame game, int enough) {
        Arrays.fill(isMember, false);
        size = 0;
        add(start);
        var found = 0;
        for (var i = 0; i < size; i++) {
            var t = members[i];
            if (game.isReady(t)) {
                readyMembers[found++] = t;
                if (found >= enough) {
                    return found;
                }
                add(rivals[t]);
            } else {
                add(enablers(t, game));
            }
        }
        return found;
    }

    /**
     * The transitions that can remove one reason why t is not ready: of all reasons, the one that adds fewest members.
     */
    private int[] enablers(int t, TokenGame game) {
        int @Nullable [] best = null;
        var fewest = Integer.MAX_VALUE;
        for (var i = 0; i < rules.inputs[t].length; i++) {
            var place = rules.inputs[t][i];
            if (game.tokens(place) < rules.inputWeights[t][i] && added(feeders[place]) < fewest) {
                best = feeders[place];
                fewest = added(best);
            }
        }
        for (var i = 0; i < rules.inhibitors[t].length; i++) {
            var place = rules.inhibitors[t][i];
            if (game.tokens(place) >= rules.inhibitorWeights[t][i] && added(drainers[place]) < fewest) {
                best = drainers[place];
                fewest = added(best);
            }
        }
        return requireNonNull(best, "a transition that is not ready has a reason");
    }

    private int added(int[] transitions) {
        var count = 0;
        for (var t : transitions) {
            count += isMember[t] ? 0 : 1;
        }
        return count;
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
