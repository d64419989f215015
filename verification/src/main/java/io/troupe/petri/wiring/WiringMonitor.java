package io.troupe.petri.wiring;

import io.troupe.common.text.Suggestions;
import io.troupe.petri.wiring.PossibleMarkings.World;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayDeque;
import java.util.ArrayList;
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
 * <p>The monitor fires the transitions of the net that {@link WiringCheck} searches, and knows in which of its markings
 * the program can be. So it is always in a marking that the search has found, too, and a proof for the wiring holds for
 * what the program does. An event that no marking allows is a violation, and so is one after which every marking is
 * dead. So is a call between a component and something that the wiring does not have: a dependency that is not
 * declared. {@link #idle} finds a call that will never be answered and a component that waits, and {@link #never} adds
 * combinations of states that must not occur.
 *
 * <p><b>Role.</b> The program, or its observers, report the events, of all steps that a {@link Protocol} can have.
 * Private steps and stops are not reported, and may happen at any time, unless {@link #observing} names them. The
 * answer to a call that its caller has given up may be reported or not. A failure is one event, in which the calls that
 * the component serves are rejected.
 *
 * <p><b>Threads.</b> Any thread. One lock guards the monitor, so events of several threads have the order in which they
 * are reported; a queue in between would report them later than they happen.
 *
 * <p><b>Cost.</b> A call is three events, each some hash look-ups and a copy of one reference for each component.
 * Memory for the net, and for the last 60 events, or all if they are {@link #keepingEvents kept}. A wiring that is
 * followed often is made into a net once: {@link #again}.
 *
 * <p><b>Errors.</b> Events never throw because of a violation: the first is kept, and what follows is ignored. An event
 * without any component of the wiring is an {@link IllegalArgumentException}.
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
    private final PossibleMarkings markings;
    private List<World> now; // guarded by this, as is all that follows
    private final List<Never> never = new ArrayList<>();
    private final ArrayDeque<ProtocolEvent> events = new ArrayDeque<>();
    private long count;
    private boolean ended;
    private Optional<Violation> violation = Optional.empty();

    private WiringMonitor(Wiring wiring, Set<String> observed, boolean keepsAll, PossibleMarkings markings) {
        this.wiring = wiring;
        this.observed = observed;
        this.keepsAll = keepsAll;
        this.markings = markings;
        this.now = markings.first();
    }

    /** Starts with each component in its first state. */
    public static WiringMonitor of(Wiring wiring) {
        return of(wiring, Set.of());
    }

    private static WiringMonitor of(Wiring wiring, Set<String> observed) {
        var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
        return new WiringMonitor(wiring, observed, false, new PossibleMarkings(net, observed, null));
    }

    /**
     * A new monitor to which each private step with one of these labels is reported, by {@link #did}; of an open call
     * the name of the call is its label.
     */
    public WiringMonitor observing(Set<String> labels) {
        var other = of(wiring, Set.copyOf(labels));
        return keepsAll ? other.keepingEvents() : other;
    }

    /** A new monitor that keeps all events, for {@link Conformance}. */
    public WiringMonitor keepingEvents() {
        return new WiringMonitor(wiring, observed, true, markings);
    }

    /** A new monitor like this one, that starts again; it has no combinations that {@link #never} occur. */
    public WiringMonitor again() {
        return new WiringMonitor(wiring, observed, keepsAll, markings);
    }

    /**
     * Forbids that each of these components is surely in one of its states, as {@link WiringProgress#never} proves it.
     *
     * @param states by component; it is in a state until the step out of it is over, also while it waits for an answer
     */
    public synchronized void never(String what, Map<String, Set<String>> states) {
        wiring.requireStates(states);
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

    /** Follows an event of one of the kinds that have no method here. */
    public void on(Kind kind, String component, String what) {
        on(new ProtocolEvent(kind, component, what));
    }

    /** Follows an event. */
    public synchronized void on(ProtocolEvent event) {
        if (ended || violation.isPresent()) {
            return;
        }
        var next = markings.after(now, event);
        if (next.isEmpty()) {
            requireReportable(event);
            var why = isDeclared(event.component()) && isDeclared(event.provider())
                    ? markings.whyNot(now, event)
                    : withAStranger(event);
            violated(Optional.of(event), why.getKey(), event + " is not allowed: " + why.getValue());
            return;
        }
        now = next;
        checkNever(event);
        if (violation.isEmpty() && !markings.canGoOn(now)) {
            violated(Optional.of(event), event.component(), "after this nothing is possible any more: " + situation());
        }
        if (violation.isEmpty()) {
            keep(event);
        }
    }

    private boolean isDeclared(String component) {
        return wiring.components().contains(component);
    }

    /** What a declared component does with one that is not: whose violation it is, and why. */
    private Map.Entry<String, String> withAStranger(ProtocolEvent event) {
        var isCaller = isDeclared(event.component());
        var stranger = isCaller ? event.provider() : event.component();
        return Map.entry(
                isCaller ? event.component() : event.provider(),
                "the wiring has no component " + stranger + "; "
                        + Suggestions.hintWithAll(stranger, wiring.components()));
    }

    /** An event that may be reported, of at least one declared component. */
    private void requireReportable(ProtocolEvent event) {
        if (event.kind() == Kind.DID && !observed.contains(event.what())) {
            throw new IllegalArgumentException("the private step \"" + event.what()
                    + "\" is reported, and not among those that are observed: " + observed);
        }
        if (event.hasTarget() && event.what().indexOf('.') < 1) {
            throw new IllegalArgumentException("the call is \"" + event.what() + "\", expected component.call");
        }
        if (!isDeclared(event.provider())) {
            wiring.protocol(event.component()); // throws, with the nearest name
        }
    }

    private String situation() {
        return wiring.components().stream().map(this::describe).collect(Collectors.joining(", "));
    }

    private void checkNever(ProtocolEvent event) {
        for (var each : never) {
            if (each.states().entrySet().stream()
                    .allMatch(entry -> markings.isWithin(now, entry.getKey(), entry.getValue()))) {
                violated(
                        Optional.of(event),
                        event.component(),
                        each.what() + ": "
                                + each.states().keySet().stream()
                                        .sorted()
                                        .map(this::describe)
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
     * be answered, a message in a mailbox never be received, and a component that waits for a resource, a mailbox or a
     * window never go on. A component waits if the only way out of its state is a step that is not possible now, or if
     * it has reported the begin of such a step ({@link Kind#WAITS}).
     */
    public synchronized void idle() {
        if (ended || violation.isPresent()) {
            return;
        }
        markings.underWay(now)
                .ifPresent(left ->
                        violated(Optional.empty(), left.getKey(), left.getValue() + ", and nothing happens any more"));
    }

    private void violated(Optional<ProtocolEvent> event, String component, String problem) {
        var last = List.copyOf(events);
        var waits = wiring.components().stream()
                .filter(other -> !other.equals(component) && !markings.mayRest(now, other))
                .map(this::describe)
                .toList();
        violation = Optional.of(new Violation(
                event, component, problem, last.subList(Math.max(0, last.size() - STORY_EVENTS), last.size()), waits));
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

    Wiring wiring() {
        return wiring;
    }

    /** Whether this event is possible now. */
    synchronized boolean allows(Kind kind, String component, String what) {
        return !markings.after(now, new ProtocolEvent(kind, component, what)).isEmpty();
    }

    boolean observes(String label) {
        return observed.contains(label);
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
        return component + " " + markings.describe(now, component);
    }
}
