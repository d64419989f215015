package io.troupe.petri.structure;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.PetriNet;
import java.math.BigDecimal;
import java.time.Duration;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import org.ojalgo.optimisation.ExpressionsBasedModel;
import org.ojalgo.optimisation.Optimisation;
import org.ojalgo.optimisation.Variable;
import org.ojalgo.optimisation.integer.IntegerStrategy;
import org.ojalgo.optimisation.integer.IntegerStrategy.GMICutConfiguration;

/**
 * A mixed-integer program that decides whether any siphon at all can be emptied, without listing the siphons.
 *
 * <p>Its unknowns are firing counts s, the marking m = m0 + C s, and for every place whether it belongs to a siphon
 * that is empty in m. All places must have a bound by the state equation. The source maximises the siphon; here any
 * siphon will do, which is faster, and a minimal one in it is reported. The firing counts need not be integer: they
 * have no bounds, so branching on them might not terminate. This can only add candidates.
 *
 * <p><b>Cost.</b> A mixed-integer program of the size of the net: about ten seconds for 40 places. If the siphons are
 * few enough to be listed, {@link SiphonAnalysis} is faster and its proofs are exact.
 *
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
                .map(place -> model.newVariable("empty " + place).binary())
                .toList();
        this.counts = net.transitions().stream()
                .map(t -> model.newVariable("count " + t).lower(0))
                .toList();
    }

    /**
     * Solves the program.
     *
     * @param limit the longest time that the solver may take, more than zero
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
        model.options.integer(withoutCuts());
        var result = model.minimise();
        return switch (result.getState()) {
            case INFEASIBLE ->
                new EmptySiphonVerdict.NoneCanBeEmptied(
                        SiphonAnalysis.whyUnfit(net).isEmpty());
            case OPTIMAL, DISTINCT, FEASIBLE -> candidate(result);
            default -> undecided("ended as " + result.getState() + " within " + limit);
        };
    }

    /**
     * Selects branch and bound without cutting planes. The cuts of ojAlgo 56.1.1 remove all solutions of one of our
     * nets in which a siphon really is emptied. They cannot be switched off, so the threshold for them is set to a
     * violation that never occurs.
     */
    private static IntegerStrategy withoutCuts() {
        return IntegerStrategy.newConfigurable()
                .withGMICutConfiguration(new GMICutConfiguration()
                        .withViolation(BigDecimal.valueOf(1_000_000_000))
                        .withFractionality(0.9999));
    }

    /** Rounds the siphon of the solution, and checks that it is a siphon. */
    private EmptySiphonVerdict candidate(Optimisation.Result result) {
        var siphon = new BitSet();
        for (var at = 0; at < empty.size(); at++) {
            siphon.set(at, Math.round(result.doubleValue(model.indexOf(empty.get(at)))) == 1);
        }
        if (siphon.isEmpty() || !needs.isClosed(siphon)) {
            return undecided("gave a solution that is no siphon");
        }
        var minimal = new MinimalSetSearch(needs).smallest(siphon, new BitSet());
        return new EmptySiphonVerdict.MayBeEmptied(new PlaceSet(net, minimal));
    }

    private EmptySiphonVerdict undecided(String what) {
        return new EmptySiphonVerdict.Undecided("net " + net.name() + ": the solver " + what);
    }
}
