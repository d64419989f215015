package io.troupe.petri.deadlock;

import io.troupe.petri.PetriNet;
import io.troupe.petri.TokenGame;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Optional;
import java.util.PriorityQueue;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * Looks for a dead marking near a solution of the state equation: best first, where the best marking is the one after
 * which the fewest of the solution's firings are left. A firing that the solution does not have costs as much as two
 * that it has.
 *
 * <p>It proves nothing: it keeps only fingerprints of markings, and ends after a number of firings.
 */
final class GuidedSearch {
    private static final int COST_OF_OTHERS = 2;

    /** A firing that leads to a marking, and the one before it; null in the initial marking. */
    private record Node(@Nullable Node before, int transition, int depth, long cost, long number) {}

    private final PetriNet net;
    private final BooleanSupplier cancelled;
    private final TokenGame game;
    /** By transition: the number of its effect. Firings with the same effect stand for each other. */
    private final int[] effects;

    /** By effect: how many firings of the solution are left. */
    private final int[] left;

    private int[] path = new int[100];
    private int length;
    private @Nullable Node here;

    /**
     * Creates a search.
     *
     * @param counts by transition: how often the solution fires it, or another with the same effect
     */
    GuidedSearch(PetriNet net, int[] counts, BooleanSupplier cancelled) {
        this.net = net;
        this.cancelled = cancelled;
        game = new TokenGame(net);
        effects = new int[net.transitions().size()];
        left = new int[net.transitions().size()];
        var known = new HashMap<List<Integer>, Integer>();
        for (var t = 0; t < effects.length; t++) {
            effects[t] = known.computeIfAbsent(game.effect(t), effect -> known.size());
            left[effects[t]] += counts[t];
        }
    }

    /** A trace to a dead marking, if one was found within so many {@code firings}. */
    Optional<int[]> run(long firings) {
        var open = new PriorityQueue<Node>(
                (a, b) -> a.cost == b.cost ? Long.compare(b.number, a.number) : Long.compare(a.cost, b.cost));
        var seen = new FingerprintSet();
        seen.add(game.fingerprint());
        open.add(new Node(null, -1, 0, Arrays.stream(left).asLongStream().sum(), 0));
        var enabled = new int[net.transitions().size()];
        var number = 0L;
        while (!open.isEmpty() && number < firings && !cancelled.getAsBoolean()) {
            var node = open.remove();
            goTo(node);
            if (game.isDead()) {
                return Optional.of(Arrays.copyOf(path, length));
            }
            var count = game.enabled(enabled);
            for (var i = 0; i < count; i++) {
                var t = enabled[i];
                if (!game.overflows(t) && !seen.has(game.fingerprintAfter(t))) {
                    seen.add(game.fingerprintAfter(t));
                    var cost = node.cost + (left[effects[t]] > 0 ? -1 : COST_OF_OTHERS);
                    open.add(new Node(node, t, node.depth + 1, cost, ++number));
                }
            }
        }
        return Optional.empty();
    }

    /** Changes the marking from that of {@code path} to that of {@code node}; mostly this is one firing more. */
    private void goTo(Node node) {
        if (node.before != null && node.before == here) {
            fire(node.transition);
        } else {
            var wanted = new int[node.depth];
            for (var at = node; at.before != null; at = at.before) {
                wanted[at.depth - 1] = at.transition;
            }
            var common = Arrays.mismatch(path, 0, length, wanted, 0, wanted.length);
            common = common < 0 ? length : common;
            while (length > common) {
                var t = path[--length];
                game.takeBack(t);
                left[effects[t]]++;
            }
            while (length < wanted.length) {
                fire(wanted[length]);
            }
        }
        here = node;
    }

    private void fire(int t) {
        if (length == path.length) {
            path = Arrays.copyOf(path, 2 * length);
        }
        path[length++] = t;
        game.fire(t);
        left[effects[t]]--;
    }
}
