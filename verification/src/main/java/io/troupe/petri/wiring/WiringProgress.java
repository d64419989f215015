package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import io.troupe.petri.FairRuns;
import io.troupe.petri.Marking;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Predicate;
import java.util.stream.Stream;

/**
 * Decides what the components of a {@link Wiring} get in the end, if the run is fair: that every request is answered,
 * that a component comes into a state again and again.
 *
 * <p>A run is fair if a step that is possible infinitely often is taken infinitely often ({@link FairRuns}). The
 * answers need all markings and are exact; for a wiring that is too large they are {@link Unknown}.
 *
 * {@snippet :
 * var progress = WiringProgress.of(wiring);
 * assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Holds.class);
 * assertThat(progress.alwaysAgain("robot", "driven")).isInstanceOf(Holds.class);
 * }
 *
 * <p><b>Role.</b> After {@link WiringCheck}, which decides whether components can go on at all.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Cost.</b> That of {@link ReachabilityGraph#explore}, and of one pass over it for each request.
 *
 * <p><b>Errors.</b> An unknown component or state throws {@link IllegalArgumentException}.
 */
public final class WiringProgress {
    private final Wiring wiring;
    private final WiringNet net;
    private final FairRuns runs;

    private WiringProgress(Wiring wiring, SearchLimits limits) {
        this.wiring = wiring;
        net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        runs = FairRuns.of(ReachabilityGraph.explore(net.net(), limits));
    }

    /** Explores up to {@link WiringCheck#DEFAULT_MAX_MARKINGS} markings. */
    public static WiringProgress of(Wiring wiring) {
        return of(wiring, SearchLimits.markings(WiringCheck.DEFAULT_MAX_MARKINGS));
    }

    /** Explores within {@code limits}. */
    public static WiringProgress of(Wiring wiring, SearchLimits limits) {
        return new WiringProgress(wiring, limits);
    }

    /** The answer to a question. */
    public sealed interface Answer {}

    /** It is so in every fair run. */
    public record Holds() implements Answer {}

    /**
     * In some fair run it is not so.
     *
     * @param sentence what does not happen, for example {@code robot waits for player.plan and is never answered}
     * @param firings a firing sequence to where it is lost, in the words of the declaration
     * @param forever the steps that go on for ever without it; empty in a deadlock
     */
    public record Fails(String sentence, List<String> firings, List<String> forever) implements Answer {
        public Fails {
            firings = List.copyOf(firings);
            forever = List.copyOf(forever);
        }

        /** The sentence, the steps one per line, and what goes on. */
        @Override
        public String toString() {
            var text = new StringBuilder(sentence);
            text.append("\n  after ").append(firings.size()).append(" steps:");
            for (var i = 0; i < firings.size(); i++) {
                text.append("\n    ").append(i + 1).append(". ").append(firings.get(i));
            }
            text.append(forever.isEmpty() ? "\n  then nothing happens" : "\n  then for ever only:");
            forever.forEach(step -> text.append("\n    ").append(step));
            return text.toString();
        }
    }

    /**
     * Not known, because there were too many markings.
     *
     * @param end why the search ended
     * @param markings how many were visited
     */
    public record Unknown(SearchEnd end, int markings) implements Answer {}

    /** Whether a component that makes a call always gets its answer, its rejection, or its time-out. */
    public Answer everyRequestIsAnswered() {
        Answer answer = new Holds();
        for (var call : unanswered().entrySet()) {
            Predicate<Marking> isOpen =
                    marking -> call.getValue().stream().anyMatch(place -> marking.tokens(place) > 0);
            var found = answer(runs.leadsTo(isOpen, isOpen.negate()), call.getKey() + " and is never answered");
            if (found instanceof Fails) {
                return found;
            }
            answer = found;
        }
        return answer;
    }

    /** Whether a component comes into a state again and again. */
    public Answer alwaysAgain(String component, String state) {
        var states = wiring.protocol(component).states();
        if (!states.contains(requireNonNull(state, "state"))) {
            throw new IllegalArgumentException("wiring " + wiring.name() + ": " + component + " has no state " + state
                    + "; " + Suggestions.hintWithAll(state, states));
        }
        var place = net.net().place(WiringNet.at(component, state));
        return answer(
                runs.alwaysAgain(marking -> marking.tokens(place) > 0), component + " is never " + state + " again");
    }

    /** By caller and call: the places of a call that is not answered yet. */
    private Map<String, Set<Place>> unanswered() {
        var open = new LinkedHashMap<String, Set<Place>>();
        for (var place : net.net().places()) {
            var call = switch (net.componentState(place)) {
                case WiringNet.ComponentState.Asking(var component, var request) ->
                    component + " waits for " + wiring.provider(component, request) + "." + request.call();
                case WiringNet.ComponentState.Unanswered(var component, var target) ->
                    component + " waits for " + target;
                default -> "";
            };
            if (!call.isEmpty()) {
                open.computeIfAbsent(call, key -> new LinkedHashSet<>()).add(place);
            }
        }
        return open;
    }

    private Answer answer(FairRuns.Answer answer, String sentence) {
        return switch (answer) {
            case FairRuns.Holds holds -> new Holds();
            case FairRuns.Unknown unknown -> new Unknown(unknown.end(), unknown.markings());
            case FairRuns.Fails fails -> {
                var forever = new ArrayList<Transition>(net.net().transitions());
                forever.removeAll(fails.forever().neverFired());
                yield new Fails(
                        sentence,
                        Stream.concat(fails.trace().stream(), fails.way().stream())
                                .map(Transition::name)
                                .toList(),
                        forever.stream().map(Transition::name).toList());
            }
        };
    }
}
