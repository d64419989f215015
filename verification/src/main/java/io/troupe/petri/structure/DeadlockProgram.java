package io.troupe.petri.structure;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import io.troupe.petri.structure.DeadlockProof.Contradiction;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/**
 * The linear program of one case of {@link DeadlockEquation}: the state equation, bounds on the tokens of places, and
 * the conditions of some traps.
 */
final class DeadlockProgram {
    static final double TOLERANCE = 1e-6;
    private static final double MAX_SCALE = 1e6;
    private static final double MAX_DENOMINATOR = 1_000;

    /** An arc that can disable a transition: an input that lacks tokens, or an inhibitor that has them. */
    record DisablingArc(Place place, int weight, boolean isInput) {}

    /** What the programs of all cases of one net share. */
    static final class Columns {
        private final PetriNet net;
        private final List<Map<Integer, Long>> effects;
        /** By column: a transition; those with the same effect share one, those without have none. */
        private final List<Transition> transitions = new ArrayList<>();

        Columns(PetriNet net) {
            this.net = net;
            effects = IncidenceMatrix.of(net);
            var byEffect = new LinkedHashMap<Map<Integer, Long>, Transition>();
            net.transitions().forEach(t -> byEffect.putIfAbsent(effects.get(t.index()), t));
            byEffect.remove(Map.of());
            transitions.addAll(byEffect.values());
        }

        /** The size of a tableau. */
        long cells() {
            return (long) transitions.size() * net.places().size();
        }
    }

    private final Columns columns;
    private final BoundedSimplex simplex;
    /** The traps of the further rows, as positions in the list of all traps. */
    private final List<Integer> traps;

    /** The program without bounds. */
    DeadlockProgram(Columns columns) {
        this.columns = columns;
        traps = new ArrayList<>();
        var places = columns.net.places();
        var rows = new double[places.size()][columns.transitions.size()];
        for (var column = 0; column < columns.transitions.size(); column++) {
            var at = column;
            columns.effects.get(columns.transitions.get(column).index()).forEach((place, by) -> rows[place][at] = by);
        }
        var constants = places.stream().mapToDouble(Place::tokens).toArray();
        var costs = new double[columns.transitions.size()];
        Arrays.fill(costs, 1); // solutions with few firings
        simplex = new BoundedSimplex(rows, constants, costs);
    }

    /** A copy with separate bounds. */
    DeadlockProgram(DeadlockProgram other) {
        columns = other.columns;
        simplex = new BoundedSimplex(other.simplex);
        traps = new ArrayList<>(other.traps);
    }

    BoundedSimplex.Outcome solve() {
        return simplex.solve();
    }

    long work() {
        return simplex.work();
    }

    private int variable(Place place) {
        return columns.transitions.size() + place.index();
    }

    double tokens(Place place) {
        return simplex.value(variable(place));
    }

    /** Whether the arc disables its transition by the bounds. */
    boolean mustDisable(DisablingArc arc) {
        var variable = variable(arc.place);
        return arc.isInput ? simplex.upper(variable) < arc.weight : simplex.lower(variable) >= arc.weight;
    }

    /** Whether the bounds allow that the arc disables its transition. */
    boolean mayDisable(DisablingArc arc) {
        var variable = variable(arc.place);
        return arc.isInput ? simplex.lower(variable) < arc.weight : simplex.upper(variable) >= arc.weight;
    }

    /** How far the solution is from one in which the arc disables its transition, in tokens. */
    double distance(DisablingArc arc) {
        var held = tokens(arc.place);
        return arc.isInput ? held - (arc.weight - 1) : arc.weight - held;
    }

    void setDisabling(DisablingArc arc) {
        if (arc.isInput) {
            setMost(arc.place, arc.weight - 1.0);
        } else {
            setLeast(arc.place, arc.weight);
        }
    }

    void setNotDisabling(DisablingArc arc) {
        if (arc.isInput) {
            setLeast(arc.place, arc.weight);
        } else {
            setMost(arc.place, arc.weight - 1.0);
        }
    }

    void setMost(Place place, double bound) {
        var variable = variable(place);
        if (bound < simplex.upper(variable)) {
            simplex.setUpper(variable, bound);
        }
    }

    void setLeast(Place place, double bound) {
        var variable = variable(place);
        if (bound > simplex.lower(variable)) {
            simplex.setLower(variable, bound);
        }
    }

    /** Whether the trap holds less than a token in the solution. */
    boolean violates(PlaceSet trap) {
        return trap.places().stream().mapToDouble(this::tokens).sum() < 1 - TOLERANCE;
    }

    /** The places without tokens in the solution. */
    BitSet unmarked() {
        var unmarked = new BitSet();
        for (var place : columns.net.places()) {
            unmarked.set(place.index(), tokens(place) < TOLERANCE);
        }
        return unmarked;
    }

    void addTrap(int number, PlaceSet trap) {
        simplex.addSum(trap.places().stream().mapToInt(this::variable).toArray(), 1);
        traps.add(number);
    }

    /**
     * The multipliers of a program without a solution, in integers; empty if rounding errors are too large. Whether
     * they are a contradiction is left to {@link DeadlockProof}.
     *
     * @param all all traps, by number
     */
    Optional<Contradiction> contradiction(List<PlaceSet> all) {
        var count = columns.transitions.size();
        var rounded = integers(simplex.multipliers(), count);
        if (rounded.isEmpty()) {
            return Optional.empty();
        }
        var factors = rounded.get();
        Map<Integer, Long> trapWeights = new HashMap<>();
        Map<Place, Long> weights = new HashMap<>();
        for (var place : columns.net.places()) {
            weights.merge(place, factors[place.index()], Long::sum);
        }
        for (var i = 0; i < traps.size(); i++) {
            var factor = factors[columns.net.places().size() + i];
            if (factor != 0) {
                trapWeights.merge(traps.get(i), -factor, Long::sum);
                all.get(traps.get(i)).places().forEach(place -> weights.merge(place, factor, Long::sum));
            }
        }
        weights.values().removeIf(weight -> weight == 0);
        return Optional.of(new Contradiction(weights, trapWeights));
    }

    /** The values from {@code start} on, times their common denominator. */
    private static Optional<long[]> integers(double[] values, int start) {
        var scale = 1.0;
        for (var i = start; i < values.length && scale <= MAX_SCALE; i++) {
            scale *= denominator(values[i] * scale);
        }
        if (scale > MAX_SCALE) {
            return Optional.empty();
        }
        var result = new long[values.length - start];
        for (var i = 0; i < result.length; i++) {
            result[i] = Math.round(values[start + i] * scale);
        }
        return Optional.of(result);
    }

    /** The smallest number that makes the value an integer, up to rounding errors. */
    private static double denominator(double value) {
        for (var denominator = 1.0; denominator <= MAX_DENOMINATOR; denominator++) {
            var product = value * denominator;
            if (Math.abs(product - Math.rint(product)) < TOLERANCE * Math.max(1, Math.abs(product))) {
                return denominator;
            }
        }
        return MAX_SCALE + 1;
    }

    /** How often the transitions fire in the solution, rounded. */
    Map<Transition, Long> counts() {
        Map<Transition, Long> counts = new HashMap<>();
        for (var column = 0; column < columns.transitions.size(); column++) {
            counts.put(columns.transitions.get(column), Math.round(simplex.value(column)));
        }
        counts.values().removeIf(value -> value == 0);
        return counts;
    }
}
