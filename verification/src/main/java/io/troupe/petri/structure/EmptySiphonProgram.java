package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import java.time.Duration;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.ojalgo.optimisation.ExpressionsBasedModel;
import org.ojalgo.optimisation.Optimisation;
import org.ojalgo.optimisation.Variable;

/**
 * One mixed-integer program that asks whether any siphon at all can be emptied, without a list of siphons.
 *
 * <p>Its unknowns are firing counts s, the marking m = m0 + C s, and for every place whether it belongs to a siphon
 * that is empty in m. It looks for the largest such siphon. All places must have a bound by the state equation.
 *
 * <p><b>Cost.</b> A mixed-integer program of the size of the net: seconds for 40 places, minutes for 100. Where the
 * siphons are few enough to be listed, {@link SiphonAnalysis} is faster and its proofs are exact.
 * <p><b>Source.</b> Chu and Xie, Deadlock analysis of Petri nets using siphons and mathematical programming (1997).
 */
public final class EmptySiphonProgram {
    private final PetriNet net;
    private final StateEquation equation;
    private final Needs needs;
    private final ExpressionsBasedModel model = new ExpressionsBasedModel();
    private final List<Variable> empty;
    private final List<Variable> counts;

    private EmptySiphonProgram(PetriNet net, StateEquation equation) {
        this.net = net;
        this.equation = equation;
        this.needs = Needs.ofSiphons(net);
        this.empty = net.places().stream()
                .map(place -> model.newVariable("empty " + place).binary().weight(1))
                .toList();
        this.counts = net.transitions().stream()
                .map(t -> model.newVariable("count " + t).lower(0).integer())
                .toList();
    }

    /**
     * Solves the program.
     *
     * @param limit how long the solver may take, longer than zero
     */
    public static EmptySiphonVerdict solve(PetriNet net, Duration limit) {
        requireNonNull(net, "net");
        if (!limit.isPositive()) {
            throw new IllegalArgumentException("limit is " + limit + ", expected longer than zero");
        }
        if (net.places().isEmpty()) {
            return new EmptySiphonVerdict.NoneCanBeEmptied(!net.transitions().isEmpty());
        }
        var equation = new StateEquation(net);
        var bounds = new ArrayList<Long>();
        for (var place : net.places()) {
            var bound = equation.upperBound(place);
            if (bound.isEmpty()) {
                return new EmptySiphonVerdict.Undecided(
                        "net " + net.name() + ": no bound is known for the tokens of place " + place);
            }
            bounds.add(bound.getAsLong());
        }
        var program = new EmptySiphonProgram(net, equation);
        program.constrain(bounds);
        return program.run(limit);
    }

    private void constrain(List<Long> bounds) {
        var tokens = net.places().stream()
                .map(place -> model.newVariable("tokens " + place).lower(0))
                .toList();
        equation.addEquation(model, tokens, counts);
        var some = model.newExpression("some place").lower(1);
        empty.forEach(place -> some.set(place, 1));
        for (var place : net.places()) {
            var at = place.index();
            var bound = bounds.get(at);
            model.newExpression("empty or marked " + place)
                    .upper(bound)
                    .set(tokens.get(at), 1)
                    .set(empty.get(at), bound);
            for (var need : needs.of(at)) {
                var met = model.newExpression("need " + need + " of " + place).upper(0);
                met.set(empty.get(at), 1);
                need.stream().forEach(helper -> met.set(empty.get(helper), -1));
            }
        }
    }

    private EmptySiphonVerdict run(Duration limit) {
        model.options.time_abort = limit.toMillis();
        var result = model.maximise();
        return switch (result.getState()) {
            case INFEASIBLE ->
                new EmptySiphonVerdict.NoneCanBeEmptied(
                        SiphonAnalysis.whyUnfit(net).isEmpty());
            case OPTIMAL, DISTINCT, FEASIBLE -> candidate(result);
            default -> undecided("ended as " + result.getState() + " within " + limit);
        };
    }

    /** Rounds the solution and checks it in integers. */
    private EmptySiphonVerdict candidate(Optimisation.Result result) {
        var siphon = new BitSet();
        for (Place place : net.places()) {
            siphon.set(place.index(), rounded(result, empty.get(place.index())) == 1);
        }
        var fired = counts.stream().mapToLong(count -> rounded(result, count)).toArray();
        var tokens = equation.tokensAfter(fired);
        var fits = !siphon.isEmpty() && needs.isClosed(siphon);
        for (var at = 0; at < tokens.length; at++) {
            fits &= siphon.get(at) ? tokens[at] == 0 : tokens[at] >= 0;
        }
        if (!fits) {
            return undecided("gave a solution that is none in integers");
        }
        Map<Transition, Long> firings = new HashMap<>();
        net.transitions().stream().filter(t -> fired[t.index()] > 0).forEach(t -> firings.put(t, fired[t.index()]));
        return new EmptySiphonVerdict.MayBeEmptied(new PlaceSet(net, siphon), firings);
    }

    private long rounded(Optimisation.Result result, Variable variable) {
        return Math.round(result.doubleValue(model.indexOf(variable)));
    }

    private EmptySiphonVerdict undecided(String what) {
        return new EmptySiphonVerdict.Undecided("net " + net.name() + ": the solver " + what);
    }
}
