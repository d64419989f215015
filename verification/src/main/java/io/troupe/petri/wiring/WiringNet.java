package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Arc;
import io.troupe.petri.Marking;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Place;
import io.troupe.petri.Transition;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Supplier;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * The net of some components of a wiring. A call or message from or to a component outside of these stays a private
 * transition, as if it were made, or answered, at any time. The names of places and transitions are sentences, so that
 * a firing sequence can be read.
 *
 * <p>A request is melded as in the paper ({@link io.troupe.petri.Meld}). The parts for {@link Questions} and
 * {@link Mailboxes} are in their files.
 *
 * <p>Long, because each step is here with its places, its meaning and its name.
 */
final class WiringNet {
    /** A step of the protocol of a component. */
    record Entry(String component, Step step) {}

    /**
     * What a transition means.
     *
     * @param who the components that take part
     * @param stopping those that stop
     * @param entry the step of a protocol that begins with it; empty if it continues one, or is a failure
     * @param seen what is reported to a {@link WiringMonitor}; empty if nothing is
     * @param mayBeUnseen whether it may happen without a report
     */
    record Event(
            Set<String> who,
            Set<String> stopping,
            Optional<Entry> entry,
            Optional<ProtocolEvent> seen,
            boolean mayBeUnseen) {
        Event(Set<String> who, Set<String> stopping) {
            this(who, stopping, Optional.empty(), Optional.empty(), true);
        }

        static Event of(String... who) {
            return new Event(new LinkedHashSet<>(List.of(who)), Set.of());
        }

        static Event stop(String component) {
            return new Event(Set.of(component), Set.of(component));
        }

        Event begins(String component, Step step) {
            return new Event(who, stopping, Optional.of(new Entry(component, step)), seen, mayBeUnseen);
        }

        Event seen(Kind kind, String component, String what) {
            return new Event(who, stopping, entry, Optional.of(new ProtocolEvent(kind, component, what)), false);
        }

        Event orUnseen() {
            return new Event(who, stopping, entry, seen, true);
        }
    }

    /** What a token on a place means. */
    sealed interface ComponentState {
        /** The state of the component: it is in it until the step out of it is over. */
        default Optional<String> in() {
            return switch (this) {
                case At at -> Optional.of(at.state());
                case Decided decided -> Optional.of(decided.step().from());
                case Asking asking -> Optional.of(asking.request().from());
                case Served served -> Optional.of(served.request().from());
                case Serving serving -> Optional.of(serving.state());
                case Ended ended -> Optional.of(ended.state());
                case Unanswered unanswered -> Optional.empty();
                case Holding holding -> Optional.empty();
                case Other other -> Optional.empty();
            };
        }

        record At(String component, String state) implements ComponentState {}

        /** A component waits until its request is accepted. */
        record Asking(String component, Step.Requests request) implements ComponentState {}

        /** A component waits for the answer to its request, which is accepted. */
        record Served(String component, Step.Requests request) implements ComponentState {}

        /** A question of a component that went on. */
        record Unanswered(String component, String target) implements ComponentState {}

        /** A component serves a call that it took in {@code state}. */
        record Serving(String component, String call, String state) implements ComponentState {}

        /** The contents of the mailbox of a component, oldest first. */
        record Holding(String component, List<String> messages) implements ComponentState {}

        /** A component has chosen a step that may have to wait. */
        record Decided(String component, Step.Waiting step) implements ComponentState {}

        /** A component has ended, or is left by all that call it. */
        record Ended(String component, String state) implements ComponentState {}

        /** Anything that does not make a component wait. */
        record Other() implements ComponentState {}
    }

    private final Wiring wiring;
    private final Labels labels;
    private final Set<String> chosen;
    private final Draft draft;
    private final Questions questions;
    private final AcceptedCalls accepted;
    private final Map<String, Service> services = new HashMap<>();
    private final Set<String> abandoned = new HashSet<>();
    private final Map<String, OnlyWay> onlyWays = new HashMap<>(); // by place
    private final PetriNet net;
    private final boolean someEnd;

    WiringNet(Wiring wiring, Set<String> chosen) {
        this.wiring = wiring;
        this.chosen = chosen;
        labels = new Labels(wiring);
        draft = new Draft(wiring.name());
        questions = new Questions(this);
        accepted = new AcceptedCalls(this);
        var components = wiring.components().stream().filter(chosen::contains).toList();
        components.forEach(component -> wiring.protocol(component)
                .states()
                .forEach(state -> draft.local(
                        component,
                        at(component, state),
                        state.equals(first(component)) ? 1 : 0,
                        new ComponentState.At(component, state))));
        wiring.resources().forEach((resource, units) -> draft.place(resource + " is free", units));
        components.forEach(this::steps);
        components.forEach(this::requests);
        questions.add();
        accepted.add();
        var mailboxes = new Mailboxes(this);
        components.forEach(mailboxes::add);
        for (var stop : SynchronisedStop.of(wiring, chosen)) {
            var who = stop.states().keySet();
            draft.step(
                    stop.name(),
                    new Event(who, who),
                    who.stream()
                            .map(component ->
                                    at(component, requireNonNull(stop.states().get(component))))
                            .toList(),
                    who.stream()
                            .map(component -> at(component, first(component)))
                            .toList());
        }
        new Endings(this).add();
        net = draft.build();
        someEnd = draft.meanings.values().stream().anyMatch(ComponentState.Ended.class::isInstance);
    }

    Wiring wiring() {
        return wiring;
    }

    Draft draft() {
        return draft;
    }

    Questions questions() {
        return questions;
    }

    AcceptedCalls accepted() {
        return accepted;
    }

    Labels labels() {
        return labels;
    }

    PetriNet net() {
        return net;
    }

    /** The name in this net of a transition, which may be of a net that differs from it in names only. */
    String name(Transition transition) {
        return net.transitions().get(transition.index()).name();
    }

    Event event(Transition transition) {
        return requireNonNull(draft.events.get(name(transition)));
    }

    /** Whether there are components that end. */
    boolean someEnd() {
        return someEnd;
    }

    /** The components that have ended in a marking, or are left by all that call them. */
    Set<String> ended(Marking marking) {
        return marking.marked().stream()
                .filter(place -> componentState(place) instanceof ComponentState.Ended)
                .map(place -> owner(place).orElseThrow())
                .collect(Collectors.toSet());
    }

    /** The component of which this place is a part; empty for a place between components. */
    Optional<String> owner(Place place) {
        return Optional.ofNullable(
                draft.owners.get(net.places().get(place.index()).name()));
    }

    ComponentState componentState(Place place) {
        return requireNonNull(draft.meanings.get(net.places().get(place.index()).name()));
    }

    /** Equal for nets that differ in names only: the tokens of each place, the arcs of each transition. */
    List<List<Integer>> shape() {
        var shape = new ArrayList<List<Integer>>();
        shape.add(net.places().stream().map(place -> (int) place.tokens()).toList());
        for (var transition : net.transitions()) {
            shape.add(arcs(transition.inputs()));
            shape.add(arcs(transition.outputs()));
            shape.add(arcs(transition.inhibitors()));
        }
        return shape;
    }

    private static List<Integer> arcs(List<Arc> arcs) {
        return arcs.stream()
                .flatMap(arc -> Stream.of(arc.place().index(), arc.weight()))
                .toList();
    }

    Set<String> chosen() {
        return chosen;
    }

    static String at(String component, String state) {
        return component + "." + state;
    }

    private String first(String component) {
        return wiring.protocol(component).states().get(0);
    }

    /** The steps of a component in which no call and no mailbox takes part. */
    private void steps(String component) {
        var protocol = wiring.protocol(component);
        for (var step : protocol.steps()) {
            var label = labels.label(component, protocol, step);
            var from = at(component, step.from());
            var to = at(component, step.to());
            switch (step) {
                case Step.Does does -> {
                    var event = Event.of(component).begins(component, step);
                    draft.step(label, event.seen(Kind.DID, component, does.label()), List.of(from), List.of(to));
                }
                case Step.Requests request -> {
                    if (!chosen.contains(wiring.provider(component, request))) {
                        draft.step(label, component, List.of(from), List.of(to));
                        outside(component, label + " and times out", from, request.onTimeout());
                        outside(component, label + " and is rejected", from, request.onRejection());
                    }
                }
                case Step.Incoming offer -> {
                    if (!(offer instanceof Step.Receives) && !isCalled(component, offer.call())) {
                        var event = Event.of(component).begins(component, step);
                        draft.step(label, event.seen(Kind.DID, component, offer.call()), List.of(from), List.of(to));
                    }
                }
                case Step.Acquires acquires -> {
                    var begun = begun(component, acquires);
                    draft.step(
                            label,
                            begun.event().seen(Kind.ACQUIRED, component, wiring.bound(component, acquires.resource())),
                            List.of(begun.place(), free(component, acquires.resource())),
                            List.of(to));
                }
                case Step.Releases releases ->
                    draft.step(
                            label,
                            Event.of(component)
                                    .begins(component, step)
                                    .seen(Kind.RELEASED, component, wiring.bound(component, releases.resource())),
                            List.of(from),
                            List.of(to, free(component, releases.resource())));
                case Step.Stops stops -> {
                    if (!wiring.stopsTogether()) {
                        draft.step(label, Event.stop(component).begins(component, step), List.of(from), List.of(to));
                    }
                }
                default -> {} // steps of questions and messages
            }
        }
        for (var state : protocol.states()) {
            if (protocol.failsIn(state)) {
                fails(
                        component,
                        state,
                        component + " fails (in " + state + ")",
                        List.of(at(component, state)),
                        List.of());
            }
        }
    }

    /** Where a component is that may take a step now, and the event of the step. */
    record Begun(String place, Event event) {}

    /**
     * The begin of a step that may have to wait. If there is something else that the component could do instead, its
     * choice is a separate transition, and then it has no other way out but to fail.
     */
    Begun begun(String component, Step.Waiting step) {
        var protocol = wiring.protocol(component);
        var from = at(component, step.from());
        var waits = new ProtocolEvent(Kind.WAITS, component, wantedBy(component, step));
        var begins = Event.of(component).begins(component, step);
        if (step.tries() || !mayWait(component, step)) {
            return new Begun(from, begins);
        }
        if (protocol.out(step.from()).size() == 1) {
            onlyWays.put(from, new OnlyWay(step, waits));
            return new Begun(from, begins);
        }
        var what = labels.infinitive(component, protocol, step);
        var place = component + " has decided to " + what;
        draft.local(component, place, 0, new ComponentState.Decided(component, step));
        draft.step(
                component + " decides to " + what,
                begins.seen(Kind.WAITS, component, waits.what()).orUnseen(),
                List.of(from),
                List.of(place));
        if (protocol.failsIn(step.from())) {
            fails(component, step.from(), component + " fails before it can " + what, List.of(place), List.of());
        }
        return new Begun(place, Event.of(component));
    }

    private boolean mayWait(String component, Step.Waiting step) {
        return switch (step) {
            case Step.Acquires acquires -> true;
            case Step.Emits emits -> isCalled(component, emits.call());
            case Step.Asks asks ->
                requireNonNull(wiring.openQuestions(component).get(asks.from()))
                        .contains(wiring.target(component, asks));
            case Step.Sends sends ->
                chosen.contains(wiring.provider(component, sends))
                        && wiring.mailbox(wiring.provider(component, sends))
                                .filter(mailbox -> mailbox.overflow() == Overflow.BLOCK)
                                .isPresent();
        };
    }

    private String wantedBy(String component, Step.Waiting step) {
        return switch (step) {
            case Step.Acquires acquires -> wiring.bound(component, acquires.resource());
            case Step.Emits emits -> emits.call();
            case Step.Asks asks -> wiring.target(component, asks);
            case Step.Sends sends -> wiring.target(component, sends);
        };
    }

    /** A step that may have to wait, and is the only one out of its state, so that being there is to have chosen it. */
    record OnlyWay(Step.Waiting step, ProtocolEvent waits) {}

    /** The step that a component on this place has chosen without a choice. */
    Optional<OnlyWay> onlyWay(Place place) {
        return Optional.ofNullable(onlyWays.get(net.places().get(place.index()).name()));
    }

    /** What a request, or a message, to a component outside of the net may lead to besides the usual. */
    void outside(String component, String label, String from, Optional<String> state) {
        state.ifPresent(to -> draft.step(label, component, List.of(from), List.of(at(component, to))));
    }

    boolean isCalled(String component, String call) {
        return !wiring.callers(component, call, chosen).isEmpty();
    }

    /** Whether a message may come that no component of the net sends. */
    boolean comesFromOutside(String receiver, String message) {
        return wiring.isOpen(receiver + "." + message)
                || !chosen.containsAll(wiring.senders(receiver, message, Set.copyOf(wiring.components())));
    }

    private String free(String component, String role) {
        return wiring.bound(component, role) + " is free";
    }

    /** A failure of a component whose last state was {@code state}. */
    void fails(String component, String state, String label, List<String> in, List<String> more) {
        var out = new ArrayList<>(more);
        out.add(accepted.failed(component, wiring.protocol(component).owed(state)));
        wiring.protocol(component).held(state).forEach(role -> out.add(free(component, role)));
        draft.step(label, Event.of(component).seen(Kind.FAILED, component, ""), in, out);
    }

    /** The places of a provider that has accepted a call, and that has served it. */
    record Service(Step.Provides offer, String where, String before, String after) {}

    /** The ways in which a provider answers a call, one for each state that offers it. */
    List<Service> services(String provider, String call) {
        var offers = wiring.protocol(provider)
                .steps(Step.Provides.class)
                .filter(offer -> offer.call().equals(call))
                .toList();
        return offers.stream()
                .map(offer -> services.computeIfAbsent(
                        provider + "." + call + " " + offer.from(),
                        key -> service(provider, offer, offers.size() == 1 ? "" : " in " + offer.from())))
                .toList();
    }

    private Service service(String provider, Step.Provides offer, String where) {
        var service = new Service(
                offer,
                where,
                provider + " has taken " + offer.call() + where,
                provider + " has done " + offer.call() + where);
        var serving = new ComponentState.Serving(provider, offer.call(), offer.from());
        draft.local(provider, service.before(), 0, serving);
        draft.local(provider, service.after(), 0, serving);
        draft.step(
                provider + " does " + offer.call() + where,
                provider,
                List.of(service.before()),
                List.of(service.after()));
        return service;
    }

    /** A failure of a provider while it serves a call for the token {@code pending}. */
    void failsServing(String provider, Service service, String caller, String pending, List<String> rejected) {
        if (wiring.protocol(provider).failsIn(service.offer().from())) {
            var call = service.offer().call() + service.where() + " to " + caller;
            var state = service.offer().from();
            fails(
                    provider,
                    state,
                    provider + " fails before it does " + call,
                    List.of(service.before(), pending),
                    rejected);
            fails(
                    provider,
                    state,
                    provider + " fails before it answers " + call,
                    List.of(service.after(), pending),
                    rejected);
        }
    }

    /** The place of a call that is served although its caller gave it up. */
    String abandoned(String caller, String provider, String call) {
        var place = caller + " has given up " + provider + "." + call;
        if (abandoned.add(place)) {
            draft.place(place, 0);
            for (var service : services(provider, call)) {
                draft.step(
                        provider + " answers " + call + service.where() + " to " + caller + ", which has given up",
                        Event.of(provider)
                                .seen(Kind.ANSWERED, caller, provider + "." + call)
                                .orUnseen(),
                        List.of(service.after(), place),
                        List.of(at(provider, service.offer().to())));
                failsServing(provider, service, caller + ", which has given up", place, List.of());
            }
        }
        return place;
    }

    private void requests(String component) {
        for (var request : wiring.protocol(component).requests()) {
            if (chosen.contains(wiring.provider(component, request))) {
                meld(component, request, wiring.provider(component, request));
            }
        }
    }

    private void meld(String component, Step.Requests request, String provider) {
        var call = request.call();
        var where = labels.where(component, request);
        var target = provider + "." + call;
        var caller = component + where;
        var waiting = component + " waits for " + target + where;
        var pending = component + " is served " + target + where;
        var isServed = wiring.protocol(provider).answersAtOnce(call);
        draft.local(component, waiting, 0, new ComponentState.Asking(component, request));
        if (isServed) {
            draft.local(component, pending, 0, new ComponentState.Served(component, request));
        }
        draft.step(
                component + " asks " + target + where,
                Event.of(component).begins(component, request).seen(Kind.ASKED, component, target),
                List.of(at(component, request.from())),
                List.of(waiting));
        var both = Event.of(component, provider);
        for (var service : services(provider, call)) {
            var offer = service.offer();
            draft.step(
                    provider + " takes " + call + service.where() + " from " + caller,
                    both.begins(provider, offer).seen(Kind.TAKEN, component, target),
                    List.of(waiting, at(provider, offer.from())),
                    List.of(pending, service.before()));
            draft.step(
                    provider + " answers " + call + service.where() + " to " + caller,
                    both.seen(Kind.ANSWERED, component, target),
                    List.of(pending, service.after()),
                    List.of(at(component, request.to()), at(provider, offer.to())));
            request.onRejection()
                    .ifPresent(
                            state -> failsServing(provider, service, caller, pending, List.of(at(component, state))));
        }
        request.onRejection()
                .ifPresent(state -> wiring.protocol(provider)
                        .steps(Step.Rejects.class)
                        .filter(step -> step.call().equals(call))
                        .forEach(step -> draft.step(
                                provider + " rejects " + call + " of " + caller + " in " + step.from(),
                                both.begins(provider, step).seen(Kind.REJECTED, component, target),
                                List.of(waiting, at(provider, step.from())),
                                List.of(at(component, state), at(provider, step.to())))));
        givesUp(
                component,
                request,
                caller,
                waiting,
                isServed ? Optional.of(pending) : Optional.empty(),
                () -> abandoned(component, provider, call));
        if (wiring.protocol(provider).answersLater(call)) {
            accept(component, request, caller, target, waiting);
        }
    }

    /**
     * The time-outs and failures of a caller whose request is not accepted, or is served on the place {@code served}.
     */
    private void givesUp(
            String component,
            Step.Requests request,
            String caller,
            String waiting,
            Optional<String> served,
            Supplier<String> abandoned) {
        var target = wiring.target(component, request);
        request.onTimeout().ifPresent(state -> {
            var event = caller + " times out: " + target;
            var seen = Event.of(component).seen(Kind.TIMED_OUT, component, target);
            draft.step(event + " was not taken", seen, List.of(waiting), List.of(at(component, state)));
            served.ifPresent(pending -> draft.step(
                    event + " is served after the timeout",
                    seen,
                    List.of(pending),
                    List.of(at(component, state), abandoned.get())));
        });
        if (wiring.protocol(component).failsIn(request.from())) {
            fails(component, request.from(), caller + " fails waiting for " + target, List.of(waiting), List.of());
            served.ifPresent(pending -> fails(
                    component,
                    request.from(),
                    caller + " fails while it is served " + target,
                    List.of(pending),
                    List.of(abandoned.get())));
        }
    }

    /** A request that is accepted, and answered in a later state of its provider. */
    private void accept(String component, Step.Requests request, String caller, String target, String waiting) {
        var open = component + " waits for the answer of " + target + labels.where(component, request);
        draft.local(component, open, 0, new ComponentState.Served(component, request));
        accepted.request(
                component,
                caller,
                target,
                waiting,
                open,
                at(component, request.to()),
                request.onRejection().map(state -> at(component, state)).stream()
                        .toList());
        request.onTimeout()
                .ifPresent(state -> draft.step(
                        caller + " times out: " + target + " is answered after the timeout",
                        Event.of(component).seen(Kind.TIMED_OUT, component, target),
                        List.of(open),
                        List.of(at(component, state), accepted.gone(component, target))));
        if (wiring.protocol(component).failsIn(request.from())) {
            fails(
                    component,
                    request.from(),
                    caller + " fails waiting for the answer of " + target,
                    List.of(open),
                    List.of(accepted.gone(component, target)));
        }
    }

    /** Collects the places and transitions, in any order, with their meaning. */
    static final class Draft {
        private record NewStep(List<String> in, List<String> out) {}

        private final String name;
        private final Map<String, Integer> places = new LinkedHashMap<>();
        private final Map<String, NewStep> steps = new LinkedHashMap<>();
        private final Map<String, Event> events = new HashMap<>();
        private final Map<String, ComponentState> meanings = new HashMap<>();
        private final Map<String, String> owners = new HashMap<>();

        Draft(String name) {
            this.name = name;
        }

        void place(String place, int tokens) {
            place(place, tokens, new ComponentState.Other());
        }

        void place(String place, int tokens, ComponentState meaning) {
            requireNew(places.put(place, tokens) == null, place);
            meanings.put(place, meaning);
        }

        /** A place of one component, which has a token on exactly one of its places. */
        void local(String component, String place, int tokens, ComponentState meaning) {
            place(place, tokens, meaning);
            owners.put(place, component);
        }

        boolean has(String place) {
            return places.containsKey(place);
        }

        void step(String step, String component, List<String> in, List<String> out) {
            step(step, Event.of(component), in, out);
        }

        /** A place that is named several times is an arc of that weight. */
        void step(String step, Event event, List<String> in, List<String> out) {
            requireNew(steps.put(step, new NewStep(in, out)) == null, step);
            events.put(step, event);
        }

        private static void requireNew(boolean isNew, String name) {
            if (!isNew) {
                throw new IllegalStateException("\"" + name + "\" is there twice");
            }
        }

        PetriNet build() {
            var builder = PetriNet.builder(name);
            places.forEach(builder::place);
            steps.forEach((step, arcs) -> {
                builder.transition(step);
                weights(arcs.in()).forEach((place, weight) -> builder.arc(place, step, weight));
                weights(arcs.out()).forEach((place, weight) -> builder.arc(step, place, weight));
            });
            return builder.build();
        }

        private static Map<String, Integer> weights(List<String> names) {
            var weights = new LinkedHashMap<String, Integer>();
            names.forEach(place -> weights.merge(place, 1, Integer::sum));
            return weights;
        }
    }

    /** Names for the transitions of a wiring's net, in the words of the declaration. */
    record Labels(Wiring wiring) {
        String label(String component, Protocol protocol, Step step) {
            return switch (step) {
                case Step.Does does ->
                    component + ": " + does.label()
                            + in(
                                    step,
                                    protocol.steps(Step.Does.class)
                                            .filter(other -> other.label().equals(does.label())));
                case Step.Requests request -> request(component, request);
                case Step.Provides offer -> component + " does " + offer.call() + in(component, offer);
                case Step.Accepts accepts -> component + " accepts " + accepts.call() + in(component, accepts);
                case Step.Answers answers ->
                    component + " answers " + answers.call()
                            + in(step, protocol.steps().stream().filter(other -> isAnswer(other, answers.call())));
                case Step.Refuses refuses ->
                    component + " refuses " + refuses.call()
                            + in(
                                    step,
                                    protocol.steps(Step.Refuses.class)
                                            .filter(other -> other.call().equals(refuses.call())));
                case Step.Rejects rejects -> component + " rejects " + rejects.call() + in(component, rejects);
                case Step.Streams streams -> component + " streams " + streams.call() + in(component, streams);
                case Step.Emits emits ->
                    component + " emits " + emits.call()
                            + in(
                                    step,
                                    protocol.steps(Step.Emits.class)
                                            .filter(other -> other.call().equals(emits.call())));
                case Step.Finishes finishes ->
                    component + " finishes " + finishes.call()
                            + in(
                                    step,
                                    protocol.steps(Step.Finishes.class)
                                            .filter(other -> other.call().equals(finishes.call())));
                case Step.Receives receives -> component + " receives " + receives.call() + in(component, receives);
                case Step.Acquires acquires ->
                    component + " takes " + wiring.bound(component, acquires.resource())
                            + in(
                                    step,
                                    protocol.steps(Step.Acquires.class)
                                            .filter(other -> bound(component, other.resource())
                                                    .equals(bound(component, acquires.resource()))));
                case Step.Releases releases ->
                    component + " gives back " + wiring.bound(component, releases.resource())
                            + in(
                                    step,
                                    protocol.steps(Step.Releases.class)
                                            .filter(other -> bound(component, other.resource())
                                                    .equals(bound(component, releases.resource()))));
                case Step.Outgoing outgoing -> outgoing(component, outgoing);
                case Step.Ends ends -> component + " ends" + in(step, protocol.steps(Step.Ends.class));
                case Step.Stops stop ->
                    component + " stops" + (protocol.stopStates().size() == 1 ? "" : " in " + stop.from());
            };
        }

        private static boolean isAnswer(Step step, String call) {
            return step instanceof Step.Answers answers && answers.call().equals(call)
                    || step instanceof Step.Provides offer && offer.call().equals(call);
        }

        /** What a step is, for example {@code take tool}. */
        String infinitive(String component, Protocol protocol, Step.Waiting step) {
            var label = label(component, protocol, step).substring(component.length() + 1);
            var verb = label.indexOf(' ');
            var infinitive = label.substring(0, verb - 1) + label.substring(verb); // takes, sends, emits, asks
            return infinitive.replace(" and goes on", "");
        }

        private String bound(String component, String role) {
            return wiring.bound(component, role);
        }

        private String outgoing(String component, Step.Outgoing step) {
            var target = wiring.provider(component, step) + "." + step.call();
            var what = switch (step) {
                case Step.Asks asks -> " asks " + target + " and goes on";
                case Step.Cancels cancels -> " gives up " + target;
                case Step.Takes takes ->
                    switch (takes.outcome()) {
                                case ANSWER -> " gets the answer of ";
                                case REJECTION -> " gets the rejection of ";
                                case END -> " gets the end of ";
                            }
                            + target;
                case Step.Sends sends -> " sends " + target;
                case Step.Requests request -> " requests " + target;
            };
            return component + what + where(component, step);
        }

        private static String in(Step step, Stream<? extends Step> same) {
            return same.count() == 1 ? "" : " (in " + step.from() + ")";
        }

        private String in(String component, Step.Incoming step) {
            return in(
                    step,
                    wiring.protocol(component)
                            .steps(step.getClass())
                            .filter(other -> ((Step.Incoming) other).call().equals(step.call())));
        }

        String request(String component, Step.Requests request) {
            return component + " requests " + wiring.provider(component, request) + "." + request.call()
                    + where(component, request);
        }

        /** The state of a call; empty unless the same call is made in several states. */
        String where(String component, Step.Outgoing step) {
            var provider = wiring.provider(component, step);
            return in(
                    step,
                    wiring.protocol(component)
                            .outgoing()
                            .filter(other -> other.getClass() == step.getClass()
                                    && !(other instanceof Step.Takes takes
                                            && takes.outcome() != ((Step.Takes) step).outcome())
                                    && other.call().equals(step.call())
                                    && wiring.provider(component, other).equals(provider)));
        }
    }
}
