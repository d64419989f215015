package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.wiring.PossibleStates.Move;
import io.troupe.petri.wiring.PossibleStates.Part;
import io.troupe.petri.wiring.PossibleStates.Situation;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Collectors;

/**
 * Derives from runs what the components of a program do, and compares it with their declared protocols.
 *
 * {@snippet :
 * var runs = new Conformance(wiring, Set.of());
 * runs.add(all.events());
 * assertThat(runs.problems()).isEmpty();
 * assertThat(runs.unused()).isEmpty();
 * }
 *
 * <p>What is derived is, for each component, the sequences of events in which it took part. A step of the declaration
 * is used if the declaration without it would not accept them all. So the used steps, with their states, are the
 * smallest part of the declaration that explains the runs; and each of them, if it were missing, would be found.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Cost.</b> The events of all different sequences are kept, and read once for each step of the declaration.
 */
public final class Conformance {
    /**
     * A step of a declaration.
     *
     * @param step for example {@code provides plan}
     */
    public record DeclaredStep(String component, String from, String step, String to) {
        @Override
        public String toString() {
            return component + ": \"" + from + "\" " + step + " \"" + to + "\"";
        }
    }

    private final Wiring wiring;
    private final Set<String> observed;
    private final Map<String, Set<List<Move>>> words = new LinkedHashMap<>();

    /** @param observed the labels of the private steps that are observed */
    public Conformance(Wiring wiring, Set<String> observed) {
        this.wiring = wiring;
        this.observed = Set.copyOf(observed);
        wiring.components().forEach(component -> words.put(component, new LinkedHashSet<>()));
    }

    /** Adds the events of a run, in their order. */
    public void add(List<ProtocolEvent> events) {
        var run = new LinkedHashMap<String, List<Move>>();
        for (var event : events) {
            add(run, event.component(), new Move(Part.ofCaller(event.kind()), event.what()));
            if (event.kind() == Kind.TAKEN || event.kind() == Kind.ANSWERED) {
                add(
                        run,
                        event.provider(),
                        new Move(
                                event.kind() == Kind.TAKEN ? Part.TAKES : Part.ANSWERS,
                                event.component() + "." + event.call()));
            }
        }
        run.forEach((component, word) -> requireNonNull(words.get(component)).add(List.copyOf(word)));
    }

    private void add(Map<String, List<Move>> run, String component, Move move) {
        wiring.protocol(component);
        run.computeIfAbsent(component, each -> new ArrayList<>()).add(move);
    }

    /** The number of different sequences of events of a component. */
    public int sequences(String component) {
        wiring.protocol(component);
        return requireNonNull(words.get(component)).size();
    }

    /** The first event of each component that its declaration does not accept, in words; empty if the runs conform. */
    public List<String> problems() {
        return wiring.components().stream()
                .flatMap(component -> problem(wiring, component).stream())
                .toList();
    }

    /** The first event that another declaration of the same components does not accept. */
    public List<String> problemsWith(Wiring other) {
        return wiring.components().stream()
                .flatMap(component -> problem(other, component).stream())
                .toList();
    }

    private Optional<String> problem(Wiring declared, String component) {
        return problem(component, WiringMonitor.statesOf(declared, component, observed));
    }

    private Optional<String> problem(String component, PossibleStates states) {
        for (var word : requireNonNull(words.get(component))) {
            var now = states.first();
            for (var i = 0; i < word.size(); i++) {
                var next = now.after(word.get(i));
                if (next.isImpossible()) {
                    return Optional.of(story(component, word, i, now));
                }
                now = next;
            }
        }
        return Optional.empty();
    }

    private static String story(String component, List<Move> word, int at, Situation before) {
        var shown = word.subList(Math.max(0, at - 6), at).stream()
                .map(Conformance::describe)
                .collect(Collectors.joining(", "));
        return component + " " + describe(word.get(at)) + " as event " + (at + 1) + " of a run"
                + (shown.isEmpty() ? "" : ", after: " + shown) + "; but it " + before + ", where it may "
                + (before.allowed().isEmpty() ? "do nothing" : String.join(", or ", before.allowed()));
    }

    private static String describe(Move move) {
        return switch (move.part()) {
            case ASKS -> "asks " + move.what();
            case IS_TAKEN -> "is accepted by " + move.what();
            case IS_ANSWERED -> "is answered by " + move.what();
            case TAKES -> "takes " + move.what();
            case ANSWERS -> "answers " + move.what();
            case DOES -> "does " + move.what();
        };
    }

    /** The steps of the declaration that the runs do not need: none of them took it, or another explains the same. */
    public List<DeclaredStep> unused() {
        return steps(false);
    }

    /** The steps of the declaration that the runs need: the derived protocols. */
    public List<DeclaredStep> used() {
        return steps(true);
    }

    private List<DeclaredStep> steps(boolean used) {
        var found = new ArrayList<DeclaredStep>();
        for (var component : wiring.components()) {
            for (var step : wiring.protocol(component).steps()) {
                if (without(component, step).isPresent() == used) {
                    found.add(declared(component, step));
                }
            }
        }
        return List.copyOf(found);
    }

    /** What the runs show to be wrong with the declaration from which this step was removed; empty if nothing. */
    public Optional<String> without(DeclaredStep removed) {
        return wiring.protocol(removed.component()).steps().stream()
                .filter(step -> declared(removed.component(), step).equals(removed))
                .findFirst()
                .map(step -> without(removed.component(), step))
                .orElseThrow(() -> new IllegalArgumentException("there is no step " + removed));
    }

    private Optional<String> without(String component, Step removed) {
        var protocol = wiring.protocol(component);
        var others =
                protocol.steps().stream().filter(step -> !step.equals(removed)).toList();
        return problem(
                component,
                new PossibleStates(
                        protocol.states().get(0), others, request -> wiring.provider(component, request), observed));
    }

    private DeclaredStep declared(String component, Step step) {
        var words = step instanceof Step.Requests request
                ? "requests " + wiring.provider(component, request) + "." + request.call()
                : step instanceof Step.Provides offer
                        ? "provides " + offer.call()
                        : step instanceof Step.Does does ? "does " + does.label() : "stops";
        return new DeclaredStep(component, step.from(), words, step.to());
    }
}
