package io.troupe.petri.deadlock;

import io.troupe.petri.PetriNet;
import io.troupe.petri.TokenGame;
import java.util.Arrays;
import java.util.Optional;
import java.util.SplittableRandom;
import java.util.function.BooleanSupplier;

/**
 * Looks for a dead marking without visiting all markings. It finds one often, and fast, but never proves that there is
 * none.
 *
 * <p>Two searches take turns. A walk always fires the transition after which the fewest are ready, with more and more
 * random steps from walk to walk. The search depth first tries the same order, and takes firings back at markings that
 * it has seen; of these it keeps only fingerprints. Both always do the same for the same net.
 */
final class CounterexampleHunt {
    private static final long SEED = 19;
    private static final int FIRINGS_PER_POLL = 1 << 12;
    /** Of many ready transitions, so many are compared. */
    private static final int MAX_COMPARED = 2_000;

    private static final int MIN_WALK = 100;

    private final PetriNet net;
    private final BooleanSupplier cancelled;
    private final SplittableRandom random = new SplittableRandom(SEED);
    private final int[] enabled;
    private int walks;
    private long firings;
    private long budget;
    private boolean isCancelled;

    CounterexampleHunt(PetriNet net, BooleanSupplier cancelled) {
        this.net = net;
        this.cancelled = cancelled;
        enabled = new int[net.transitions().size()];
    }

    /** Looks on for about so many {@code moreFirings}; a trace to a dead marking, if one was found. */
    Optional<int[]> run(long moreFirings) {
        budget = firings + moreFirings / 2;
        while (mayGoOn()) {
            var trace = walk();
            if (trace.isPresent()) {
                return trace;
            }
        }
        budget = firings + moreFirings / 2;
        return mayGoOn() ? new DepthFirst().run() : Optional.empty();
    }

    private boolean mayGoOn() {
        return firings < budget && !isCancelled;
    }

    private void count(int more) {
        if (firings / FIRINGS_PER_POLL != (firings + more) / FIRINGS_PER_POLL && cancelled.getAsBoolean()) {
            isCancelled = true;
        }
        firings += more;
    }

    /** The first walk is greedy; of the following ones each has more random steps, and is longer. */
    private Optional<int[]> walk() {
        var number = walks++;
        var chance = number == 0 ? 0 : Math.min(0.6, 0.02 * number);
        var steps = MIN_WALK
                + (2L + number % 16) * (net.places().size() + net.transitions().size());
        var game = new TokenGame(net);
        var seen = new FingerprintSet();
        var trace = new int[MIN_WALK];
        for (var length = 0; length < steps && mayGoOn(); length++) {
            if (game.isDead()) {
                return Optional.of(Arrays.copyOf(trace, length));
            }
            seen.add(game.fingerprint());
            var count = game.enabled(enabled);
            var t = random.nextDouble() < chance ? enabled[random.nextInt(count)] : best(game, count, seen);
            if (game.overflows(t)) {
                return Optional.empty();
            }
            game.fire(t);
            count(1);
            if (length == trace.length) {
                trace = Arrays.copyOf(trace, 2 * length);
            }
            trace[length] = t;
        }
        return Optional.empty();
    }

    /** Of the transitions that lead to an unseen marking, one that leaves the fewest ready; or any. */
    private int best(TokenGame game, int count, FingerprintSet seen) {
        var best = enabled[random.nextInt(count)];
        var least = Integer.MAX_VALUE;
        var offset = random.nextInt(count);
        for (var i = 0; i < Math.min(count, MAX_COMPARED); i++) {
            var t = enabled[(i + offset) % count];
            if (game.overflows(t) || seen.has(game.fingerprintAfter(t))) {
                continue;
            }
            game.fire(t);
            if (game.readyCount() < least) {
                least = game.readyCount();
                best = t;
            }
            game.takeBack(t);
        }
        count(Math.min(count, MAX_COMPARED));
        return best;
    }

    /** The search with firings taken back. Each level keeps the transitions that it has not tried yet. */
    private final class DepthFirst {
        private static final int MAX_DEPTH = 100_000;

        private final TokenGame game = new TokenGame(net);
        private final FingerprintSet seen = new FingerprintSet();
        private int[][] open = new int[MIN_WALK][];
        private int[] left = new int[MIN_WALK];
        private int[] trace = new int[MIN_WALK];
        private int depth;

        Optional<int[]> run() {
            enter();
            while (mayGoOn()) {
                if (game.isDead()) {
                    return Optional.of(Arrays.copyOf(trace, depth));
                }
                if (left[depth] == 0) {
                    if (depth == 0) {
                        return Optional.empty();
                    }
                    game.takeBack(trace[--depth]);
                    continue;
                }
                var t = open[depth][--left[depth]];
                count(1);
                if (depth + 1 < MAX_DEPTH && !game.overflows(t) && !seen.has(game.fingerprintAfter(t))) {
                    trace[depth] = t;
                    game.fire(t);
                    depth++;
                    enter();
                }
            }
            return Optional.empty();
        }

        /** Orders the transitions of a new marking, the best one last. */
        private void enter() {
            seen.add(game.fingerprint());
            if (depth == open.length - 1) {
                open = Arrays.copyOf(open, 2 * open.length);
                left = Arrays.copyOf(left, 2 * left.length);
                trace = Arrays.copyOf(trace, 2 * trace.length);
            }
            var count = game.enabled(enabled);
            var keys = new long[count];
            for (var i = 0; i < count; i++) {
                var t = enabled[i];
                if (game.overflows(t)) {
                    keys[i] = (long) Integer.MIN_VALUE << Integer.SIZE | t;
                    continue;
                }
                game.fire(t);
                keys[i] = (long) -game.readyCount() << Integer.SIZE | t;
                game.takeBack(t);
            }
            count(count);
            Arrays.sort(keys);
            open[depth] = Arrays.stream(keys).mapToInt(key -> (int) key).toArray();
            left[depth] = count;
        }
    }
}
