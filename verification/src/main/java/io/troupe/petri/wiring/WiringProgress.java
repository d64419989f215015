package io.troupe.petri.wiring;

import io.troupe.petri.Answer;
import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Unknown;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.FairRuns;
import io.troupe.petri.Marking;
import io.troupe.petri.Place;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.Predicate;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Decides what can happen in a {@link Wiring} and what cannot: that components are never in some of their states at
 * once, or can be; and what they get in the end, if the run is fair: that every request is answered, that a component
 * comes into a state again and again.
 *
 * <p>A run is fair if a step that is possible infinitely often is taken infinitely often ({@link FairRuns}). The
 * answers need all markings and are exact; for a wiring that is too large they are {@link Unknown}, unless what is
 * asked for was met before.
 *
 * {@snippet :
 * var progress = WiringProgress.of(commit);
 * assertThat(progress.never(Map.of("p1", Set.of("committed"), "p2", Set.of("aborted")))).isInstanceOf(Yes.class);
 * assertThat(progress.canReach(Map.of("p1", Set.of("committed")))).isInstanceOf(Yes.class);
 * assertThat(progress.everyRequestIsAnswered()).isInstanceOf(Yes.class);
 * assertThat(progress.alwaysAgain("coordinator", "over")).isInstanceOf(Yes.class);
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
    private final ReachabilityGraph graph;
    private final FairRuns runs;

    private WiringProgress(Wiring wiring, SearchLimits limits) {
        this.wiring = wiring;
        net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        graph = ReachabilityGraph.explore(net.net(), limits);
        runs = FairRuns.of(graph);
    }

    /** Explores up to {@link WiringCheck#DEFAULT_MAX_MARKINGS} markings. */
    public static WiringProgress of(Wiring wiring) {
        return of(wiring, SearchLimits.markings(WiringCheck.DEFAULT_MAX_MARKINGS));
    }

    /** Explores within {@code limits}. */
    public static WiringProgress of(Wiring wiring, SearchLimits limits) {
        return new WiringProgress(wiring, limits);
    }

    /**
     * It is not so; what is asked about the end, in some fair run.
     *
     * @param sentence what is so instead, for example {@code robot waits for player.plan and is never answered}
     * @param firings a firing sequence to where it is lost, in the words of the declaration
     * @param steps the same for a reader, as in a {@link Counterexample}
     * @param forever the steps that go on for ever without it, none in a deadlock; empty if the question is not about
     *     the end
     */
    public record Fails(String sentence, List<String> firings, List<String> steps, Optional<List<String>> forever) {
        public Fails {
            firings = List.copyOf(firings);
            steps = List.copyOf(steps);
            forever = forever.map(List::copyOf);
        }

        /** The sentence, the steps one per line, and what goes on. */
        @Override
        public String toString() {
            var text = new StringBuilder(sentence);
            if (!steps.isEmpty() || forever.isPresent()) {
                text.append(ToldSteps.lines(steps, ""));
            }
            forever.ifPresent(rest -> {
                text.append(rest.isEmpty() ? "\n  then nothing happens" : "\n  then for ever only:");
                rest.forEach(step -> text.append("\n    ").append(step));
            });
            return text.toString();
        }
    }

    /**
     * Whether it never happens that each of these components is in one of its states; a no has a shortest way to where
     * they are.
     *
     * @param states by component; it is in a state until the step out of it is over, also while it waits for an answer
     *     or serves a call there
     */
    public Answer<Fails> never(Map<String, Set<String>> states) {
        wiring.requireStates(states);
        return reached(states)
                .<Answer<Fails>>map(state ->
                        new No<>(fails(sentence(state.marking(), states), state.shortestTrace(), Optional.empty())))
                .orElseGet(() -> complete(new Yes<>("all markings", graph.size())));
    }

    /**
     * Whether it can happen that each of these components is in one of its states, as in {@link #never}; the proof of a
     * yes is a shortest way.
     */
    public Answer<Fails> canReach(Map<String, Set<String>> states) {
        wiring.requireStates(states);
        return reached(states)
                .<Answer<Fails>>map(state -> {
                    var way = fails(sentence(state.marking(), states), state.shortestTrace(), Optional.empty());
                    return new Yes<>(way.toString(), state.index() + 1);
                })
                .orElseGet(() -> {
                    var words = new TreeMap<>(states)
                            .entrySet().stream()
                                    .map(entry -> entry.getKey() + " is "
                                            + String.join(" or ", new TreeSet<>(entry.getValue())))
                                    .collect(Collectors.joining(", "));
                    return complete(new No<>(fails("never at once: " + words, List.of(), Optional.empty())));
                });
    }

    /** The nearest marking in which each of these components is in one of its states. */
    private Optional<ReachabilityGraph.State> reached(Map<String, Set<String>> states) {
        var places = new ArrayList<List<Place>>();
        states.forEach((component, some) -> places.add(net.net().places().stream()
                .filter(place -> net.owner(place).equals(Optional.of(component)))
                .filter(place ->
                        net.componentState(place).in().filter(some::contains).isPresent())
                .toList()));
        return graph.states().stream()
                .filter(state -> places.stream()
                        .allMatch(some ->
                                some.stream().anyMatch(place -> state.marking().tokens(place) > 0)))
                .findFirst();
    }

    private String sentence(Marking marking, Map<String, Set<String>> states) {
        return marking.marked().stream()
                .filter(place -> net.owner(place).filter(states::containsKey).isPresent())
                .map(place -> net.owner(place).orElseThrow() + " is "
                        + net.componentState(place).in().orElseThrow())
                .sorted()
                .collect(Collectors.joining(", "));
    }

    private Fails fails(String sentence, List<Transition> trace, Optional<List<String>> forever) {
        return new Fails(
                sentence, trace.stream().map(Transition::name).toList(), new ToldSteps(trace, net).steps(), forever);
    }

    /** The answer from all markings. */
    private Answer<Fails> complete(Answer<Fails> answer) {
        return graph.isComplete() ? answer : new Unknown<>(graph.end(), graph.size());
    }

    /** Whether a component that makes a call always gets its answer, its rejection, or its time-out. */
    public Answer<Fails> everyRequestIsAnswered() {
        Answer<Fails> answer = new Yes<>("no request", 0);
        for (var call : unanswered().entrySet()) {
            Predicate<Marking> isOpen =
                    marking -> call.getValue().stream().anyMatch(place -> marking.tokens(place) > 0);
            var found = answer(runs.leadsTo(isOpen, isOpen.negate()), call.getKey() + " and is never answered");
            if (found instanceof No) {
                return found;
            }
            answer = found;
        }
        return answer;
    }

    /** Whether a component comes into a state again and again. */
    public Answer<Fails> alwaysAgain(String component, String state) {
        wiring.requireStates(Map.of(component, Set.of(state)));
        var places = net.net().places().stream()
                .filter(place -> switch (net.componentState(place)) {
                    case WiringNet.ComponentState.At at ->
                        at.component().equals(component) && at.state().equals(state);
                    case WiringNet.ComponentState.Ended ended ->
                        ended.component().equals(component) && ended.state().equals(state);
                    default -> false;
                })
                .toList();
        return answer(
                runs.alwaysAgain(marking -> places.stream().anyMatch(place -> marking.tokens(place) > 0)),
                component + " is never " + state + " again");
    }

    /** By caller and call: the places of a call that is not answered yet. */
    private Map<String, Set<Place>> unanswered() {
        var open = new LinkedHashMap<String, Set<Place>>();
        for (var place : net.net().places()) {
            var call = switch (net.componentState(place)) {
                case WiringNet.ComponentState.Asking(var component, var request) ->
                    component + " waits for " + wiring.target(component, request);
                case WiringNet.ComponentState.Served(var component, var request) ->
                    component + " waits for " + wiring.target(component, request);
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

    private Answer<Fails> answer(Answer<FairRuns.Fails> answer, String sentence) {
        return switch (answer) {
            case Yes<FairRuns.Fails>(var proof, var markings) -> new Yes<>(proof, markings);
            case Unknown<FairRuns.Fails>(var end, var markings) -> new Unknown<>(end, markings);
            case No<FairRuns.Fails>(var fails) -> {
                var forever = new ArrayList<Transition>(net.net().transitions());
                forever.removeAll(fails.forever().neverFired());
                yield new No<>(fails(
                        sentence,
                        Stream.concat(fails.trace().stream(), fails.way().stream())
                                .toList(),
                        Optional.of(forever.stream().map(Transition::name).toList())));
            }
        };
    }
}
