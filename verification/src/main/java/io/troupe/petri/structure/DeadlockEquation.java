package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.BoundedSimplex.Outcome;
import io.troupe.petri.structure.DeadlockProgram.Columns;
import io.troupe.petri.structure.DeadlockProgram.DisablingArc;
import io.troupe.petri.structure.DeadlockProof.Case;
import io.troupe.petri.structure.DeadlockProof.Disabled;
import io.troupe.petri.structure.DeadlockProof.Excluded;
import io.troupe.petri.structure.DeadlockProof.Halves;
import io.troupe.petri.structure.DeadlockProof.Reason;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.BooleanSupplier;
import java.util.function.Consumer;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Looks for a dead marking among the solutions of the state equation: m = m0 + C s with m and s not negative, in which
 * every transition lacks tokens or is inhibited, and every marked trap is still marked.
 *
 * <p>If there is none, no reachable marking is dead, and the result is a {@link DeadlockProof}. A solution need not be
 * reachable; it is a hint where to search.
 *
 * <p><b>Role.</b> A proof without a search, also with weights, priorities and inhibitor arcs. The linear programs are
 * solved in floating point; what they prove is checked in integers.
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> A linear program for each case, which starts from the solution of the case before. There can be
 * exponentially many cases.
 *
 * <p><b>Source.</b> J. Esparza and S. Melzer, Verification of safety properties using integer programming: beyond the
 * state equation (2000), for the traps.
 */
public final class DeadlockEquation {
    private static final long MAX_CELLS = 4_000_000;
    /** The tableaus of all open cases together, in cells of 8 bytes. */
    private static final long MAX_OPEN_CELLS = 32_000_000;

    private static final int MAX_DEPTH = 400;
    private static final int MAX_TRAPS = 300;

    private final PetriNet net;
    private final BooleanSupplier cancelled;
    private final Consumer<Map<Transition, Long>> hint;
    private final long maxWork;
    private final Columns columns;
    /** By transition. */
    private final List<List<DisablingArc>> arcs;

    private final Needs trapNeeds;
    private final List<PlaceSet> traps = new ArrayList<>();
    private long work;

    private DeadlockEquation(
            PetriNet net, long maxWork, BooleanSupplier cancelled, Consumer<Map<Transition, Long>> hint) {
        this.net = net;
        this.maxWork = maxWork;
        this.cancelled = cancelled;
        this.hint = hint;
        columns = new Columns(net);
        arcs = net.transitions().stream().map(DeadlockEquation::arcs).toList();
        trapNeeds = Needs.ofTraps(net, cancelled);
    }

    private static List<DisablingArc> arcs(Transition t) {
        return Stream.concat(
                        t.inputs().stream().map(arc -> new DisablingArc(arc.place(), arc.weight(), true)),
                        t.inhibitors().stream().map(arc -> new DisablingArc(arc.place(), arc.weight(), false)))
                .toList();
    }

    /**
     * Solves the programs.
     *
     * @param maxWork how many additions the programs may take, roughly; a thousand million take about a second
     * @param cancelled ends the search once it is true; called often, on the calling thread
     * @param hint called with a solution that is a dead marking, which ends the search: how often transitions fire on
     *     the way there, rounded; one stands for all with the same effect
     */
    public static Optional<DeadlockProof> solve(
            PetriNet net, long maxWork, BooleanSupplier cancelled, Consumer<Map<Transition, Long>> hint) {
        try {
            return new DeadlockEquation(net, maxWork, cancelled, hint).solve();
        } catch (Needs.Cancelled end) {
            return Optional.empty();
        }
    }

    private Optional<DeadlockProof> solve() {
        var root = columns.cells() > MAX_CELLS ? null : prove(new DeadlockProgram(columns), 0);
        if (root == null) {
            return Optional.empty();
        }
        try {
            return Optional.of(new DeadlockProof(net, traps, root));
        } catch (IllegalArgumentException roundingErrors) {
            return Optional.empty();
        }
    }

    /** The proof for the case with the bounds of {@code program}; null if the search has stopped. */
    private @Nullable Case prove(DeadlockProgram program, int depth) {
        if (cancelled.getAsBoolean() || depth > MAX_DEPTH || depth * columns.cells() > MAX_OPEN_CELLS) {
            return null;
        }
        var forced = new ArrayList<Forced>();
        var ready = force(program, forced);
        var inner = ready.isPresent() ? withoutReasons(ready.get()) : solve(program, depth);
        for (var i = forced.size() - 1; i >= 0 && inner != null; i--) {
            inner = around(forced.get(i), inner);
        }
        return inner;
    }

    /** A transition that only one of its arcs can disable. */
    private record Forced(Transition transition, int arc) {}

    private Case around(Forced forced, Case inner) {
        var t = forced.transition;
        var reasons = new ArrayList<>(List.of(new Reason(forced.arc, inner)));
        for (var i = 0; i < arcs(t.index()).size(); i++) {
            if (i != forced.arc) {
                reasons.add(excluded(t, i));
            }
        }
        return new Disabled(t, reasons);
    }

    private Reason excluded(Transition t, int arc) {
        return new Reason(arc, new Excluded(arcs(t.index()).get(arc).place()));
    }

    private List<DisablingArc> arcs(int transition) {
        return arcs.get(transition);
    }

    /** Sets the bounds that follow from the others; a transition that nothing can disable, if there is one. */
    private Optional<Transition> force(DeadlockProgram program, List<Forced> forced) {
        for (var changed = true; changed; ) {
            changed = false;
            for (var t : net.transitions()) {
                var possible = isDisabled(program, t) ? 2 : countPossible(program, t);
                if (possible == 0) {
                    return Optional.of(t);
                }
                if (possible == 1) {
                    var only = firstPossible(program, t);
                    program.setDisabling(arcs(t.index()).get(only));
                    forced.add(new Forced(t, only));
                    changed = true;
                }
            }
        }
        return Optional.empty();
    }

    private boolean isDisabled(DeadlockProgram program, Transition t) {
        for (var arc : arcs(t.index())) {
            if (program.mustDisable(arc)) {
                return true;
            }
        }
        return false;
    }

    private int countPossible(DeadlockProgram program, Transition t) {
        var count = 0;
        for (var arc : arcs(t.index())) {
            count += program.mayDisable(arc) ? 1 : 0;
        }
        return count;
    }

    private int firstPossible(DeadlockProgram program, Transition t) {
        var first = 0;
        while (!program.mayDisable(arcs(t.index()).get(first))) {
            first++;
        }
        return first;
    }

    private Case withoutReasons(Transition t) {
        return new Disabled(
                t,
                IntStream.range(0, arcs(t.index()).size())
                        .mapToObj(arc -> excluded(t, arc))
                        .toList());
    }

    private @Nullable Case solve(DeadlockProgram program, int depth) {
        do {
            var before = program.work();
            var outcome = program.solve();
            work += program.work() - before;
            if (outcome == Outcome.INFEASIBLE) {
                return program.contradiction(traps).orElse(null); // null after rounding errors
            }
            if (outcome == Outcome.FAILED || work > maxWork) {
                return null;
            }
        } while (addTrap(program));
        return split(program, depth);
    }

    /** Splits by the reasons of the transition with the fewest, among those that are enabled in the solution. */
    private @Nullable Case split(DeadlockProgram program, int depth) {
        @Nullable Transition best = null;
        var fewest = Integer.MAX_VALUE;
        for (var t : net.transitions()) {
            if (isEnabled(program, t)) {
                var count = countPossible(program, t);
                if (count < fewest) {
                    fewest = count;
                    best = t;
                }
            }
        }
        if (best != null) {
            return splitReasons(program, best, depth);
        }
        for (var place : net.places()) {
            var held = program.tokens(place);
            if (Math.abs(held - Math.rint(held)) > DeadlockProgram.TOLERANCE) {
                return halve(program, place, depth);
            }
        }
        hint.accept(program.counts());
        return null;
    }

    private boolean isEnabled(DeadlockProgram program, Transition t) {
        for (var arc : arcs(t.index())) {
            if (program.distance(arc) < DeadlockProgram.TOLERANCE) {
                return false;
            }
        }
        return true;
    }

    private @Nullable Case splitReasons(DeadlockProgram program, Transition t, int depth) {
        var all = arcs(t.index());
        var order = IntStream.range(0, all.size())
                .boxed()
                .sorted(Comparator.comparingDouble(i -> program.distance(all.get(i))))
                .toList();
        var reasons = new ArrayList<Reason>();
        for (var i : order) {
            var arc = all.get(i);
            if (!program.mayDisable(arc)) {
                reasons.add(excluded(t, i));
                continue;
            }
            var copy = copy(program);
            copy.setDisabling(arc);
            var then = prove(copy, depth + 1);
            if (then == null) {
                return null;
            }
            reasons.add(new Reason(i, then));
            program.setNotDisabling(arc);
        }
        return new Disabled(t, reasons);
    }

    private @Nullable Case halve(DeadlockProgram program, Place place, int depth) {
        var most = (long) Math.floor(program.tokens(place));
        var copy = copy(program);
        copy.setMost(place, most);
        var upToMost = prove(copy, depth + 1);
        if (upToMost == null) {
            return null;
        }
        program.setLeast(place, most + 1.0);
        var more = prove(program, depth + 1);
        return more == null ? null : new Halves(place, most, upToMost, more);
    }

    private DeadlockProgram copy(DeadlockProgram program) {
        var copy = new DeadlockProgram(program);
        work += copy.work();
        return copy;
    }

    /** Adds the condition of a trap that the solution violates, if there is one. */
    private boolean addTrap(DeadlockProgram program) {
        for (var i = 0; i < traps.size(); i++) {
            if (program.violates(traps.get(i))) {
                program.addTrap(i, traps.get(i));
                return true;
            }
        }
        if (traps.size() == MAX_TRAPS) {
            return false;
        }
        var unmarked = program.unmarked();
        trapNeeds.shrinkToLargest(unmarked);
        if (!isMarkedAtFirst(unmarked)) {
            return false;
        }
        traps.add(new PlaceSet(net, smallerTrap(unmarked)));
        program.addTrap(traps.size() - 1, traps.getLast());
        return true;
    }

    private boolean isMarkedAtFirst(BitSet places) {
        return places.stream().anyMatch(place -> net.places().get(place).tokens() > 0);
    }

    /** A trap within this one that is marked at first, and from which no further place can be left out. */
    private BitSet smallerTrap(BitSet trap) {
        var small = trap;
        for (var place = small.nextSetBit(0); place >= 0; place = small.nextSetBit(place + 1)) {
            var less = (BitSet) small.clone();
            less.clear(place);
            trapNeeds.shrinkToLargest(less);
            if (isMarkedAtFirst(less)) {
                small = less;
            }
        }
        return small;
    }
}
