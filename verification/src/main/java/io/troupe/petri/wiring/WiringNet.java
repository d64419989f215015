package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.Arc;
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
        record At(String component, String state) implements ComponentState {}

        record Asking(String component, Step.Requests request) implements ComponentState {}

        /** A call of a component that is being served, or that it asked and went on. */
        record Unanswered(String component, String target) implements ComponentState {}

        /** A component serves a call. */
        record Serving(String component, String call) implements ComponentState {}

        /** The contents of the mailbox of a component, oldest first. */
        record Holding(String component, List<String> messages) implements ComponentState {}

        /** Anything that does not make a component wait. */
        record Other() implements ComponentState {}
    }

    private final Wiring wiring;
    private final Labels labels;
    private final Set<String> chosen;
    private final Draft draft;
    private final Questions questions;
    private final Map<String, Service> services = new HashMap<>();
    private final Set<String> abandoned = new HashSet<>();
    private final PetriNet net;

    WiringNet(Wiring wiring, Set<String> chosen) {
        this.wiring = wiring;
        this.chosen = chosen;
        labels = new Labels(wiring);
        draft = new Draft(wiring.name());
        questions = new Questions(this);
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
        net = draft.build();
    }

    Wiring wiring() {
        return wiring;
    }

    Draft draft() {
        return draft;
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
        shape.add(net.places().stream().map(Place::tokens).toList());
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
                case Step.Acquires acquires ->
                    draft.step(
                            label,
                            Event.of(component)
                                    .begins(component, step)
                                    .seen(Kind.ACQUIRED, component, wiring.bound(component, acquires.resource())),
                            List.of(from, free(component, acquires.resource())),
                            List.of(to));
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

    /** What a request, or a message, to a component outside of the net may lead to besides the usual. */
    void outside(String component, String label, String from, Optional<String> state) {
        state.ifPresent(to -> draft.step(label, component, List.of(from), List.of(at(component, to))));
    }

    private boolean isCalled(String component, String call) {
        return !wiring.callers(component, call, chosen).isEmpty();
    }

    private String free(String component, String role) {
        return wiring.bound(component, role) + " is free";
    }

    /** A failure of a component whose last state was {@code state}. */
    void fails(String component, String state, String label, List<String> in, List<String> more) {
        var out = new ArrayList<>(more);
        out.add(questions.failed(component));
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
        var serving = new ComponentState.Serving(provider, offer.call());
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
        draft.local(component, waiting, 0, new ComponentState.Asking(component, request));
        draft.local(component, pending, 0, new ComponentState.Unanswered(component, target));
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
        request.onTimeout().ifPresent(state -> {
            var event = caller + " times out: " + target;
            var seen = Event.of(component).seen(Kind.TIMED_OUT, component, target);
            draft.step(event + " was not taken", seen, List.of(waiting), List.of(at(component, state)));
            var abandoned = List.of(at(component, state), abandoned(component, provider, call));
            draft.step(event + " is served after the timeout", seen, List.of(pending), abandoned);
        });
        if (wiring.protocol(component).failsIn(request.from())) {
            fails(component, request.from(), caller + " fails waiting for " + target, List.of(waiting), List.of());
            fails(
                    component,
                    request.from(),
                    caller + " fails while it is served " + target,
                    List.of(pending),
                    List.of(abandoned(component, provider, call)));
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
                case Step.Stops stop ->
                    component + " stops" + (protocol.stopStates().size() == 1 ? "" : " in " + stop.from());
            };
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
