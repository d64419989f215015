package io.troupe.petri.deadlock;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.stream.IntStream;

/**
 * Whether some place of a net can hold any number of tokens. Then a search of all markings never ends.
 *
 * <p>A net is unbounded if it can reach a marking, and from there another one that has at least its tokens on every
 * place, and more on one: the firings between the two can be repeated for ever. The search goes depth first and
 * compares each marking with those on the way to it. If it finds no growth, all markings are counted. With inhibitor
 * arcs or different priorities more tokens can also prevent firings; for such nets nothing is known.
 *
 * {@snippet :
 * if (Boundedness.of(net, limits) instanceof Boundedness.Unbounded growth) {
 *     assertThat(growth.growing()).containsExactly(net.place("n"));
 * }
 * }
 *
 * <p><b>Cost.</b> Up to the markings of the net, with 16 to 32 bytes for each; of the way, a few thousand markings. For
 * {@link Bounded}, that of {@link ReachabilityGraph#exploreMarkings(PetriNet, SearchLimits)} too.
 *
 * <p><b>Source.</b> Karp and Miller, Parallel program schemata (1969).
 */
public final class Boundedness {
    /** The tokens of the markings on the way are kept, up to so many numbers. */
    private static final int MAX_KEPT = 4_000_000;

    /** A marking is compared with so many before it, and with some that are farther back. */
    private static final int NEAR = 100;

    private static final int FARTHER = 64;

    private final PetriNet net;
    private final SearchLimits limits;
    private final TokenGame game;
    private final FingerprintSet seen = new FingerprintSet();
    private final int[][] kept;
    private final int[][] open;
    private final int[] left;
    private final int[] trace;
    private int depth;
    private boolean isCut;

    private Boundedness(PetriNet net, SearchLimits limits) {
        this.net = net;
        this.limits = limits;
        game = new TokenGame(FlatNet.of(net));
        var most = Math.clamp(
                MAX_KEPT / (1L + net.places().size() + net.transitions().size()), NEAR, 100_000);
        kept = new int[most][];
        open = new int[most][];
        left = new int[most];
        trace = new int[most];
    }

    /** What is known about the bounds of a net. */
    public sealed interface Result {}

    /**
     * Some places can hold any number of tokens.
     *
     * @param before a firing sequence from the initial marking
     * @param repeated a firing sequence that can follow it any number of times
     * @param growing the places that have more tokens after each repetition
     */
    public record Unbounded(List<Transition> before, List<Transition> repeated, List<Place> growing) implements Result {
        public Unbounded {
            before = List.copyOf(before);
            repeated = List.copyOf(repeated);
            growing = List.copyOf(growing);
        }
    }

    /**
     * Every place has a bound.
     *
     * @param markings how many markings are reachable
     */
    public record Bounded(int markings) implements Result {}

    /** Not known, with the reason. */
    public record Unknown(String reason) implements Result {
        public Unknown {
            requireNonNull(reason, "reason");
        }
    }

    /** Searches within {@code limits}. */
    public static Result of(PetriNet net, SearchLimits limits) {
        if (net.hasInhibitors() || FlatNet.of(net).isPrioritised()) {
            return new Unknown("with inhibitor arcs or priorities, more tokens may prevent a firing");
        }
        return new Boundedness(net, limits).search();
    }

    private Result search() {
        enter();
        while (true) {
            if (seen.size() > limits.maxMarkings()) {
                return limited();
            }
            if (limits.cancelled().getAsBoolean()) {
                return cancelled();
            }
            if (left[depth] == 0) {
                if (depth == 0) {
                    return ifFinite();
                }
                game.takeBack(trace[--depth]);
                continue;
            }
            var t = open[depth][--left[depth]];
            if (game.overflows(t) || depth + 1 == trace.length) {
                isCut = true;
            } else if (!seen.has(game.fingerprintAfter(t))) {
                trace[depth++] = t;
                game.fire(t);
                var found = enter();
                if (found.isPresent()) {
                    return found.get();
                }
            }
        }
    }

    /**
     * The result if no way grows. Fingerprints prove nothing, since a marking with that of another one is not entered;
     * so the markings themselves are counted.
     */
    private Result ifFinite() {
        try {
            var graph = ReachabilityGraph.exploreMarkings(net, limits);
            return switch (graph.end()) {
                case COMPLETE -> new Bounded(graph.size());
                case CANCELLED -> cancelled();
                case MEMORY -> new Unknown("the search used up its memory of " + limits.maxBytes() + " bytes");
                case LIMIT -> isCut ? new Unknown("the search met a way that is too long") : limited();
            };
        } catch (ArithmeticException e) {
            return new Unknown(e.getMessage());
        }
    }

    private Unknown limited() {
        return new Unknown("the search ended at its limit of " + limits.maxMarkings() + " markings");
    }

    private static Unknown cancelled() {
        return new Unknown("the search was cancelled");
    }

    /** Enters a new marking; the result, if it has more tokens than one on the way. */
    private Optional<Unbounded> enter() {
        seen.add(game.fingerprint());
        var now = game.tokens();
        kept[depth] = now;
        for (var back = 1; back <= depth; back += back < NEAR ? 1 : Math.max(1, depth / FARTHER)) {
            if (covers(now, kept[depth - back])) {
                return Optional.of(growth(depth - back));
            }
        }
        var enabled = new int[net.transitions().size()];
        left[depth] = game.enabled(enabled);
        open[depth] = Arrays.copyOf(enabled, left[depth]);
        Arrays.sort(open[depth]);
        return Optional.empty();
    }

    private static boolean covers(int[] now, int[] before) {
        for (var p = 0; p < now.length; p++) {
            if (now[p] < before[p]) {
                return false;
            }
        }
        return true;
    }

    private Unbounded growth(int from) {
        var now = kept[depth];
        var all =
                Arrays.stream(trace, 0, depth).mapToObj(net.transitions()::get).toList();
        return new Unbounded(
                all.subList(0, from),
                all.subList(from, depth),
                IntStream.range(0, now.length)
                        .filter(p -> now[p] > kept[from][p])
                        .mapToObj(net.places()::get)
                        .toList());
    }
}
