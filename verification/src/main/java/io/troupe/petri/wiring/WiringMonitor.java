package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import io.troupe.petri.wiring.PossibleStates.Move;
import io.troupe.petri.wiring.PossibleStates.Part;
import io.troupe.petri.wiring.PossibleStates.Situation;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Collectors;

/**
 * Follows a running program through the protocols of a {@link Wiring}, and finds the first event that they do not
 * allow.
 *
 * {@snippet :
 * var monitor = WiringMonitor.of(wiring);
 * monitor.asked("client1", "planner.plan");
 * monitor.taken("client1", "planner.plan");
 * monitor.answered("client1", "planner.plan");
 * monitor.idle();
 * monitor.check();
 * }
 *
 * <p>For each component the monitor has the set of states that are still possible. An event after which none is
 * possible is a violation. As long as there is none, the run is a firing sequence of the net that {@link WiringCheck}
 * searches, so a proof for the wiring holds for what the program does. {@link #idle} finds a call that will never be
 * answered, and {@link #never} adds combinations of states that must not occur.
 *
 * <p><b>Role.</b> The program, or its observers, report the events. Private steps are not observed, and may happen at
 * any time, unless {@link #observing} names them.
 *
 * <p><b>Threads.</b> Any thread. One lock guards the monitor, so events of several threads have the order in which they
 * are reported; a queue in between would report them later than they happen.
 *
 * <p><b>Cost.</b> A call is three events, each some hash look-ups once its states are known. Memory for each set of
 * states that occurs, and for the last 60 events, or all if they are {@link #keepingEvents kept}.
 *
 * <p><b>Errors.</b> Events never throw because of a violation: the first is kept, and what follows is ignored. An
 * unknown component is an {@link IllegalArgumentException}.
 */
public final class WiringMonitor {
    private static final int STORY_EVENTS = 60;
    private static final int PRINTED_EVENTS = 12;

    /**
     * The first event that the protocols do not allow.
     *
     * @param event what happened; empty if nothing happens any more
     * @param component the component that it is about
     * @param problem what is wrong, in one line
     * @param before the events before it, oldest first, at most 60
     * @param waits what the other components wait for
     */
    public record Violation(
            Optional<ProtocolEvent> event,
            String component,
            String problem,
            List<ProtocolEvent> before,
            List<String> waits) {
        public Violation {
            before = List.copyOf(before);
            waits = List.copyOf(waits);
        }

        /** The story, in the words of the declaration. */
        @Override
        public String toString() {
            var text = new StringBuilder(problem);
            var shown = before.subList(Math.max(0, before.size() - PRINTED_EVENTS), before.size());
            if (!shown.isEmpty()) {
                text.append("\n  after:");
                shown.forEach(each -> text.append("\n    - ").append(each));
            }
            event.ifPresent(each -> text.append("\n  then:\n    * ").append(each));
            if (!waits.isEmpty()) {
                text.append("\n  meanwhile:");
                waits.forEach(each -> text.append("\n    * ").append(each));
            }
            return text.toString();
        }
    }

    /** A program has left its declared protocols; the message is the story. */
    public static final class ViolationException extends IllegalStateException {
        private static final long serialVersionUID = 1;

        ViolationException(String wiring, Violation violation) {
            super("the program does not do what the wiring \"" + wiring + "\" declares: " + violation);
        }
    }

    private record Never(String what, Map<String, Set<String>> states) {}

    private final Wiring wiring;
    private final Set<String> observed;
    private final boolean keepsAll;
    private final Map<String, Situation> now = new LinkedHashMap<>(); // guarded by this, as is all that follows
    private final List<Never> never = new ArrayList<>();
    private final ArrayDeque<ProtocolEvent> events = new ArrayDeque<>();
    private long count;
    private boolean ended;
    private Optional<Violation> violation = Optional.empty();

    private WiringMonitor(Wiring wiring, Set<String> observed, boolean keepsAll) {
        this.wiring = wiring;
        this.observed = observed;
        this.keepsAll = keepsAll;
        for (var component : wiring.components()) {
            now.put(component, statesOf(wiring, component, observed).first());
        }
    }

    static PossibleStates statesOf(Wiring wiring, String component, Set<String> observed) {
        var protocol = wiring.protocol(component);
        for (var step : protocol.steps()) {
            if (!canFollow(step)) {
                throw new IllegalArgumentException("wiring " + wiring.name() + ": " + component + " has the step "
                        + step + ", which a monitor cannot follow;"
                        + " expected does, requests without time-out or rejection, provides and stops only");
            }
        }
        if (protocol.failure().isPresent()) {
            throw new IllegalArgumentException("wiring " + wiring.name() + ": " + component + " may fail (state "
                    + protocol.failure().get() + "), which a monitor cannot follow; expected no failure");
        }
        return new PossibleStates(
                protocol.states().get(0), protocol.steps(), request -> wiring.provider(component, request), observed);
    }

    private static boolean canFollow(Step step) {
        return switch (step) {
            case Step.Requests request ->
                request.onTimeout().isEmpty() && request.onRejection().isEmpty();
            case Step.Does does -> true;
            case Step.Provides provides -> true;
            case Step.Stops stops -> true;
            default -> false;
        };
    }

    /** Starts with each component in its first state. */
    public static WiringMonitor of(Wiring wiring) {
        return new WiringMonitor(wiring, Set.of(), false);
    }

    /** A new monitor to which each private step with one of these labels is reported, by {@link #did}. */
    public WiringMonitor observing(Set<String> labels) {
        return new WiringMonitor(wiring, Set.copyOf(labels), keepsAll);
    }

    /** A new monitor that keeps all events, for {@link Conformance}. */
    public WiringMonitor keepingEvents() {
        return new WiringMonitor(wiring, observed, true);
    }

    /**
     * Forbids that each of these components is surely in one of its states.
     *
     * @param states by component; a call under way is no state
     */
    public synchronized void never(String what, Map<String, Set<String>> states) {
        states.forEach((component, forbidden) -> {
            for (var state : forbidden) {
                if (!wiring.protocol(component).states().contains(state)) {
                    throw new IllegalArgumentException(component + " has no state " + state + "; "
                            + Suggestions.hintWithAll(
                                    state, wiring.protocol(component).states()));
                }
            }
        });
        never.add(new Never(what, Map.copyOf(states)));
    }

    // ---- events

    /** A component makes a call; {@code target} is {@code component.call} of the component that answers it. */
    public void asked(String caller, String target) {
        on(new ProtocolEvent(Kind.ASKED, caller, target));
    }

    /** The call is accepted. */
    public void taken(String caller, String target) {
        on(new ProtocolEvent(Kind.TAKEN, caller, target));
    }

    /** The call is answered, by a value or by an error. */
    public void answered(String caller, String target) {
        on(new ProtocolEvent(Kind.ANSWERED, caller, target));
    }

    /** A call is made, accepted and answered at once. */
    public synchronized void called(String caller, String target) {
        asked(caller, target);
        taken(caller, target);
        answered(caller, target);
    }

    /** A component has taken a private step that is observed. */
    public void did(String component, String step) {
        on(new ProtocolEvent(Kind.DID, component, step));
    }

    /** Follows an event. */
    public synchronized void on(ProtocolEvent event) {
        if (ended || violation.isPresent()) {
            return;
        }
        if (event.kind() == Kind.DID) {
            if (!observed.contains(event.what())) {
                throw new IllegalArgumentException("the private step \"" + event.what()
                        + "\" is reported, and not among those that are" + " observed: " + observed);
            }
            move(event, event.component(), new Move(Part.DOES, event.what()));
        } else {
            if (event.what().indexOf('.') < 1) {
                throw new IllegalArgumentException("the call is \"" + event.what() + "\", expected component.call");
            }
            if (!now.containsKey(event.provider())) {
                wiring.protocol(event.provider()); // throws, with the nearest name
            }
            var isMoved = move(event, event.component(), new Move(Part.ofCaller(event.kind()), event.what()));
            if (isMoved && event.kind() != Kind.ASKED) {
                move(
                        event,
                        event.provider(),
                        new Move(
                                event.kind() == Kind.TAKEN ? Part.TAKES : Part.ANSWERS,
                                event.component() + "." + event.call()));
            }
        }
        if (violation.isEmpty()) {
            checkNever(event);
            keep(event);
        }
    }

    private boolean move(ProtocolEvent event, String component, Move move) {
        var before = now.get(component);
        if (before == null) {
            wiring.protocol(component); // throws, with the nearest name
            return false;
        }
        var after = before.after(move);
        if (after.isImpossible()) {
            var allowed = before.allowed();
            violated(
                    Optional.of(event),
                    component,
                    event + " is not allowed: " + component + " " + before + ", where it may "
                            + (allowed.isEmpty() ? "do nothing" : String.join(", or ", allowed)));
            return false;
        }
        now.put(component, after);
        return true;
    }

    private void checkNever(ProtocolEvent event) {
        for (var each : never) {
            if (each.states().entrySet().stream()
                    .allMatch(entry -> requireNonNull(now.get(entry.getKey())).isWithin(entry.getValue()))) {
                violated(
                        Optional.of(event),
                        event.component(),
                        each.what() + ": "
                                + each.states().keySet().stream()
                                        .sorted()
                                        .map(component -> component + " " + now.get(component))
                                        .collect(Collectors.joining(", ")));
                return;
            }
        }
    }

    private void keep(ProtocolEvent event) {
        count++;
        events.add(event);
        if (!keepsAll && events.size() > STORY_EVENTS) {
            events.remove();
        }
    }

    /**
     * The program does nothing any more until something from outside arrives: a call that is under way now will never
     * be answered.
     */
    public synchronized void idle() {
        if (ended || violation.isPresent()) {
            return;
        }
        for (var entry : now.entrySet()) {
            if (!entry.getValue().mayRest()) {
                violated(
                        Optional.empty(),
                        entry.getKey(),
                        entry.getKey() + " " + entry.getValue() + ", and nothing happens any more");
                return;
            }
        }
    }

    private void violated(Optional<ProtocolEvent> event, String component, String problem) {
        var last = List.copyOf(events);
        var waits = new LinkedHashSet<String>();
        now.forEach((other, situation) -> {
            if (!situation.mayRest() && !other.equals(component)) {
                waits.add(other + " " + situation);
            }
        });
        violation = Optional.of(new Violation(
                event,
                component,
                problem,
                last.subList(Math.max(0, last.size() - STORY_EVENTS), last.size()),
                List.copyOf(waits)));
    }

    /** Ignores all events from now on, because the program is being closed, which is no part of the wiring. */
    public synchronized void end() {
        ended = true;
    }

    // ---- results

    /** The first violation. */
    public synchronized Optional<Violation> violation() {
        return violation;
    }

    /** @throws ViolationException if there was a violation */
    public void check() {
        var found = violation();
        if (found.isPresent()) {
            throw new ViolationException(wiring.name(), found.get());
        }
    }

    /** The number of events that were allowed. */
    public synchronized long count() {
        return count;
    }

    /** The last 60 events that were allowed, or all if they are {@link #keepingEvents kept}. */
    public synchronized List<ProtocolEvent> events() {
        return List.copyOf(events);
    }

    /** In which states a component may be, in words. */
    public synchronized String describe(String component) {
        wiring.protocol(component);
        return component + " " + now.get(component);
    }
}
