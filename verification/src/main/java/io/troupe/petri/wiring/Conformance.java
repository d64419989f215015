package io.troupe.petri.wiring;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
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
 * <p>A step of the declaration is used if the declaration without it would not accept all runs. So the used steps, with
 * their states, are the smallest part of the declaration that explains the runs; and each of them, if it were missing,
 * would be found.
 *
 * <p><b>Threads.</b> Not thread-safe.
 *
 * <p><b>Cost.</b> The events of all different runs are kept, and read up to once for each step of the declaration.
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
    private final WiringNet net;
    private final Set<List<ProtocolEvent>> runs = new LinkedHashSet<>();

    /** @param observed the labels of the private steps that are observed */
    public Conformance(Wiring wiring, Set<String> observed) {
        this.wiring = wiring;
        this.observed = Set.copyOf(observed);
        this.net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
    }

    /** Adds the events of a run, in their order. */
    public void add(List<ProtocolEvent> events) {
        runs.add(List.copyOf(events));
    }

    /** The first event of each run that its declaration does not accept, in words; empty if the runs conform. */
    public List<String> problems() {
        var markings = new PossibleMarkings(net, observed, null);
        return runs.stream().flatMap(run -> problem(run, markings).stream()).toList();
    }

    private static Optional<String> problem(List<ProtocolEvent> run, PossibleMarkings markings) {
        var now = markings.first();
        for (var i = 0; i < run.size(); i++) {
            var event = run.get(i);
            var next = markings.after(now, event);
            if (next.isEmpty()) {
                var shown = run.subList(Math.max(0, i - 6), i).stream()
                        .map(ProtocolEvent::toString)
                        .collect(Collectors.joining(", "));
                return Optional.of(event + " as event " + (i + 1) + " of a run"
                        + (shown.isEmpty() ? "" : ", after: " + shown) + "; but "
                        + markings.whyNot(now, event).getValue());
            }
            now = next;
        }
        return Optional.empty();
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
                if (!(step instanceof Step.Ends) && without(component, step).isPresent() == used) {
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
        var markings = new PossibleMarkings(net, observed, new WiringNet.Entry(component, removed));
        return runs.stream().flatMap(run -> problem(run, markings).stream()).findFirst();
    }

    private DeclaredStep declared(String component, Step step) {
        return new DeclaredStep(component, step.from(), words(component, step), step.to());
    }

    private String words(String component, Step step) {
        return switch (step) {
            case Step.Does does -> "does " + does.label();
            case Step.Provides offer -> "provides " + offer.call();
            case Step.Accepts accepts -> "accepts " + accepts.call();
            case Step.Answers answers -> "answers " + answers.call();
            case Step.Refuses refuses -> "refuses " + refuses.call();
            case Step.Rejects rejects -> "rejects " + rejects.call();
            case Step.Streams streams -> "streams " + streams.call();
            case Step.Receives receives -> "receives " + receives.call();
            case Step.Emits emits -> "emits " + emits.call();
            case Step.Finishes finishes -> "finishes " + finishes.call();
            case Step.Acquires acquires -> "acquires " + wiring.bound(component, acquires.resource());
            case Step.Releases releases -> "releases " + wiring.bound(component, releases.resource());
            case Step.Stops stops -> "stops";
            case Step.Ends ends -> "ends";
            case Step.Outgoing outgoing ->
                verb(outgoing) + " " + wiring.provider(component, outgoing) + "." + outgoing.call();
        };
    }

    private static String verb(Step.Outgoing step) {
        return switch (step) {
            case Step.Requests requests -> "requests";
            case Step.Asks asks -> "asks";
            case Step.Cancels cancels -> "cancels";
            case Step.Sends sends -> "sends";
            case Step.Takes takes ->
                switch (takes.outcome()) {
                    case ANSWER -> "answered";
                    case REJECTION -> "rejected";
                    case END -> "finished";
                };
        };
    }
}
