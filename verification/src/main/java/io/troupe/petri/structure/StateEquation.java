package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.OptionalLong;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.ojalgo.optimisation.ExpressionsBasedModel;
import org.ojalgo.optimisation.Optimisation;
import org.ojalgo.optimisation.Variable;

/**
 * Bounds on tokens by linear programs over the state equation: markings m = m0 + C s with m and s not negative, where C
 * is the incidence matrix and s counts firings.
 *
 * <p><b>Role.</b> Every reachable marking satisfies the equation, but not every solution m is reachable, and s need not
 * be integer. So a bound holds for all reachable markings, but need not be tight. Priorities only exclude markings, so
 * the bounds hold with them, too.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> One or two linear programs for each bound.
 */
public final class StateEquation {
    private static final int MAX_SCALE = 1000;
    private static final double TOLERANCE = 1e-6;
    private static final Duration FOR_EVER = Duration.ofDays(365);

    private final PetriNet net;
    private final IncidenceMatrix effects;
    private final Supplier<Duration> left;

    public StateEquation(PetriNet net) {
        this(net, () -> FOR_EVER);
    }

    /** Limits each program to the time that {@code left} returns at its start; after that the solver fails. */
    StateEquation(PetriNet net, Supplier<Duration> left) {
        this.net = requireNonNull(net, "net");
        this.left = left;
        this.effects = new IncidenceMatrix(net);
    }

    /**
     * The fewest tokens that the set holds in a marking of the state equation, as computed by the solver in floating
     * point.
     *
     * <p>A value near 0 means that the state equation does not exclude an empty set. A larger value means that the set
     * is never empty, up to the accuracy of the solver; {@link #lowerBound} is the exact proof. Empty if the solver
     * failed.
     */
    public OptionalDouble leastTokens(PlaceSet set) {
        set.requirePlacesOf(net);
        var model = newModel();
        var counts = net.transitions().stream()
                .map(t -> model.newVariable("count " + t).lower(0))
                .toList();
        var tokens = net.places().stream()
                .map(place -> model.newVariable("tokens " + place).lower(0).weight(set.has(place.index()) ? 1.0 : 0.0))
                .toList();
        addEquation(model, tokens, counts);
        var result = model.minimise();
        return result.getState().isOptimal() ? OptionalDouble.of(result.getValue()) : OptionalDouble.empty();
    }

    /**
     * A proof that the set is never empty. Empty if the state equation does not exclude it, or if the solver's result
     * was too inaccurate for a proof in integers.
     */
    public Optional<TokenBound> lowerBound(PlaceSet set) {
        set.requirePlacesOf(net);
        var model = newModel();
        var weights = net.places().stream()
                .map(place -> model.newVariable("weight " + place)
                        .upper(set.has(place.index()) ? 1 : 0)
                        .weight(place.tokens()))
                .toList();
        for (var t : net.transitions()) {
            var change = model.newExpression("change " + t).lower(0);
            effects.ofTransitions().get(t.index()).forEach((place, by) -> change.set(weights.get(place), by));
        }
        var result = model.maximise();
        if (!result.getState().isOptimal() || result.getValue() < TOLERANCE) {
            return Optional.empty();
        }
        return IntStream.rangeClosed(1, MAX_SCALE)
                .mapToObj(scale -> scaled(result, scale).flatMap(scaled -> proof(set, scaled, scale)))
                .flatMap(Optional::stream)
                .findFirst();
    }

    private ExpressionsBasedModel newModel() {
        var model = new ExpressionsBasedModel();
        model.options.time_abort = Math.clamp(left.get().toMillis(), 1, FOR_EVER.toMillis());
        return model;
    }

    private Optional<TokenBound> proof(PlaceSet set, long[] scaled, int scale) {
        Map<Place, Long> weights = new HashMap<>();
        for (var place : net.places()) {
            if (scaled[place.index()] != 0) {
                weights.put(place, scaled[place.index()]);
            }
        }
        try {
            return Optional.of(new TokenBound(set, weights, scale)).filter(bound -> bound.tokens() > 0);
        } catch (IllegalArgumentException | ArithmeticException notQuite) {
            return Optional.empty(); // rounded to a wrong value; a larger scale may fit
        }
    }

    /** The most tokens that a place can hold, proved in integers; empty if it has no such bound, or none was found. */
    OptionalLong upperBound(Place place) {
        var model = newModel();
        var weights = net.places().stream()
                .map(other -> model.newVariable("weight " + other)
                        .lower(other.equals(place) ? 1 : 0)
                        .weight(other.tokens()))
                .toList();
        for (var t : net.transitions()) {
            var change = model.newExpression("change " + t).upper(0);
            effects.ofTransitions().get(t.index()).forEach((at, by) -> change.set(weights.get(at), by));
        }
        var result = model.minimise();
        if (!result.getState().isOptimal()) {
            return OptionalLong.empty();
        }
        return IntStream.rangeClosed(1, MAX_SCALE)
                .mapToObj(scale -> scaled(result, scale)
                        .filter(scaled -> isUpperProof(place, scaled, scale))
                        .map(scaled -> Math.floorDiv(IncidenceMatrix.initialSum(net, at -> scaled[at]), (long) scale)))
                .flatMap(Optional::stream)
                .mapToLong(Long::longValue)
                .findFirst();
    }

    private boolean isUpperProof(Place place, long[] weights, int scale) {
        return weights[place.index()] >= scale
                && IntStream.range(0, weights.length).allMatch(at -> weights[at] >= 0)
                && effects.ofTransitions().stream()
                        .allMatch(effect -> IncidenceMatrix.sum(effect, at -> weights[at]) <= 0);
    }

    /** The values times scale, if these are integers up to rounding errors. */
    private static Optional<long[]> scaled(Optimisation.Result result, int scale) {
        var scaled = new long[result.size()];
        for (var i = 0; i < scaled.length; i++) {
            var value = result.doubleValue(i) * scale;
            scaled[i] = Math.round(value);
            if (Math.abs(value - scaled[i]) > TOLERANCE * Math.max(1, Math.abs(value))) {
                return Optional.empty();
            }
        }
        return Optional.of(scaled);
    }

    /** Adds tokens = m0 + C counts. */
    void addEquation(ExpressionsBasedModel model, List<Variable> tokens, List<Variable> counts) {
        for (var place : net.places()) {
            var balance = model.newExpression("balance " + place).level(place.tokens());
            balance.set(tokens.get(place.index()), 1);
            effects.onPlaces().get(place.index()).forEach((t, by) -> balance.set(counts.get(t), -by));
        }
    }
}
