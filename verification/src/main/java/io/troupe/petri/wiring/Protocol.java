package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import java.util.ArrayDeque;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeSet;
import java.util.stream.Stream;

/**
 * The behaviour of one kind of component: its states, the steps that lead out of them, and where it may stop or fail.
 *
 * <p>Several steps out of one state are a choice. The component chooses its own steps at any time: a private step, a
 * request, a message, a resource. A step that has to wait is a choice, too: a component that has chosen a request, or a
 * resource that is held, or a message to a mailbox that is full, stays with it and takes no other step, unless it only
 * {@link #tries}. What comes from others is no choice: a state with several offers, messages and answers takes the one
 * that comes.
 *
 * {@snippet :
 * var client = Protocol.of("client")
 *         .state("idle", does("look").then("informed"))
 *         .state("informed", requests("planner.plan").then("idle"), stops())
 *         .build();
 * var planner = Protocol.of("planner")
 *         .state("ready", provides("plan").then("ready"))
 *         .build();
 * }
 *
 * <table>
 * <caption>The steps</caption>
 * <tr><td>{@link #does}</td><td>a private step</td></tr>
 * <tr><td>{@link #requests}, {@link #provides}, {@link #rejects}</td><td>a call whose caller waits</td></tr>
 * <tr><td>{@link #accepts}, {@link #answers}, {@link #refuses}</td>
 *     <td>a call that is answered later, after other steps</td></tr>
 * <tr><td>{@link #asks}, {@link #answered}, {@link #rejected}, {@link #cancels}</td>
 *     <td>a call whose caller goes on and takes the answer later, as with a promise</td></tr>
 * <tr><td>{@link #streams}, {@link #emits}, {@link #finishes}, {@link #finished}</td>
 *     <td>a call with many answers, as with a callback</td></tr>
 * <tr><td>{@link #sends}, {@link #receives}</td><td>a one-way message into a bounded mailbox</td></tr>
 * <tr><td>{@link #acquires}, {@link #releases}</td><td>a resource that one component at a time may hold</td></tr>
 * <tr><td>{@link #tries}</td><td>one of the above that does not stay with it while it has to wait</td></tr>
 * <tr><td>{@link #stops}</td><td>back to the first state</td></tr>
 * <tr><td>{@link #ends}</td><td>nothing more</td></tr>
 * </table>
 *
 * <p>A message that no state receives stays in the mailbox, and holds up those behind it. A question that was asked
 * stays open until its answer is taken or it is cancelled.
 *
 * <p><b>Role.</b> Added to a {@link Wiring} under a name, as often as required.
 *
 * <p><b>Threads.</b> Immutable.
 *
 * <p><b>Errors.</b> {@link ProtocolBuilder} throws {@link IllegalArgumentException} for a step to an undeclared state,
 * an unreachable state, a state without a way out, and a resource that is held in a state or not, depending on the way
 * there.
 */
public final class Protocol {
    private final String name;
    private final List<String> states;
    private final List<Step> steps;
    private final Optional<String> failure;
    /** By state: the resources that the component holds in it, one that is held twice named twice. */
    private final Map<String, List<String>> held;
    /** By state: the calls that were accepted and not answered, one that was accepted twice named twice. */
    private final Map<String, List<String>> owed;

    Protocol(
            String name,
            List<String> states,
            List<Step> steps,
            Optional<String> failure,
            Map<String, List<String>> held,
            Map<String, List<String>> owed) {
        this.name = name;
        this.states = List.copyOf(states);
        this.steps = List.copyOf(steps);
        this.failure = failure;
        this.held = Map.copyOf(held);
        this.owed = Map.copyOf(owed);
    }

    /** Starts a declaration; a component starts in the state that is declared first. */
    public static ProtocolBuilder of(String name) {
        return new ProtocolBuilder(name, Optional.empty());
    }

    /**
     * Starts the declaration of an actor: what it provides, streams and receives must be methods of its type, which
     * return a promise (or suspend), have a callback, or return {@code void}.
     *
     * @param actor as for {@code ActorSpace.spawn}; needs {@code troupe-actor-core} on the class path
     */
    public static ProtocolBuilder of(String name, Class<?> actor) {
        return new ProtocolBuilder(name, Optional.of(ActorWords.of(name, actor)));
    }

    /** A private step; the label describes it in the counterexamples. */
    public static Branch.Builder does(String label) {
        return new Branch.Builder(Branch.Kind.DOES, label);
    }

    /**
     * A call, written {@code component.call}; the component waits for its answer. {@link Branch#orTimeout} and
     * {@link Branch#orRejected} add the states after a time-out and a rejection.
     */
    public static Branch.Builder requests(String target) {
        return new Branch.Builder(Branch.Kind.REQUESTS, target);
    }

    /**
     * A call that other components may make while the component is in this state, and that is answered before it is in
     * the next one: the short form of {@link #accepts} and {@link #answers} with nothing between them.
     */
    public static Branch.Builder provides(String call) {
        return new Branch.Builder(Branch.Kind.PROVIDES, call);
    }

    /**
     * A call that other components may make while the component is in this state. It owes the answer from then on,
     * until a later state {@link #answers} or {@link #refuses}; between them may be any steps, such as other calls:
     *
     * {@snippet :
     * Protocol.of("cache")
     *         .state("idle", accepts("get").then("looking"))
     *         .state("looking", does("find it").then("found"), requests("server.get").then("found"))
     *         .state("found", answers("get").then("idle"))
     *         .build();
     * }
     */
    public static Branch.Builder accepts(String call) {
        return new Branch.Builder(Branch.Kind.ACCEPTS, call);
    }

    /** Answers a call that was accepted; if several callers wait for it, any of them. */
    public static Branch.Builder answers(String call) {
        return new Branch.Builder(Branch.Kind.ANSWERS, call);
    }

    /** Rejects a call that was accepted; if several callers wait for it, that of any of them. */
    public static Branch.Builder refuses(String call) {
        return new Branch.Builder(Branch.Kind.REFUSES, call);
    }

    /** A call that the component rejects while it is in this state, instead of accepting it. */
    public static Branch.Builder rejects(String call) {
        return new Branch.Builder(Branch.Kind.REJECTS, call);
    }

    /**
     * A call, written {@code component.call}, whose answer the component takes later, in a state that is
     * {@link #answered}. One question is open at a time: asking again waits until the first is answered or cancelled.
     */
    public static Branch.Builder asks(String target) {
        return new Branch.Builder(Branch.Kind.ASKS, target);
    }

    /** Takes the answer to a question; of a stream, its next item. */
    public static Branch.Builder answered(String target) {
        return new Branch.Builder(Branch.Kind.ANSWERED, target);
    }

    /** Takes the rejection of a question. */
    public static Branch.Builder rejected(String target) {
        return new Branch.Builder(Branch.Kind.REJECTED, target);
    }

    /**
     * Gives up a question, for example after a time-out, and closes its stream. What comes back later is dropped.
     * Without an open question this is a private step.
     */
    public static Branch.Builder cancels(String target) {
        return new Branch.Builder(Branch.Kind.CANCELS, target);
    }

    /** A call that stays open as a stream; it is taken when no other stream of the same call is open. */
    public static Branch.Builder streams(String call) {
        return new Branch.Builder(Branch.Kind.STREAMS, call);
    }

    /**
     * Puts an item into the open stream of a call. The component waits while the {@link WiringBuilder#window} is full;
     * without an open stream this is a private step.
     */
    public static Branch.Builder emits(String call) {
        return new Branch.Builder(Branch.Kind.EMITS, call);
    }

    /** Ends the open stream of a call; without one this is a private step. */
    public static Branch.Builder finishes(String call) {
        return new Branch.Builder(Branch.Kind.FINISHES, call);
    }

    /** Takes the end of a stream, after all of its items. */
    public static Branch.Builder finished(String target) {
        return new Branch.Builder(Branch.Kind.FINISHED, target);
    }

    /**
     * A one-way message, written {@code component.message}. If the mailbox is full, its {@link Overflow} decides;
     * {@link Branch#orRejected} adds the state after a rejected message.
     */
    public static Branch.Builder sends(String target) {
        return new Branch.Builder(Branch.Kind.SENDS, target);
    }

    /** Takes the oldest message of the {@link WiringBuilder#mailbox} if it is this one. */
    public static Branch.Builder receives(String message) {
        return new Branch.Builder(Branch.Kind.RECEIVES, message);
    }

    /** Waits for a unit of a {@link WiringBuilder#resource} and holds it from then on. */
    public static Branch.Builder acquires(String resource) {
        return new Branch.Builder(Branch.Kind.ACQUIRES, resource);
    }

    /** Gives a unit of a resource back. */
    public static Branch.Builder releases(String resource) {
        return new Branch.Builder(Branch.Kind.RELEASES, resource);
    }

    /**
     * A step that is taken only when it does not have to wait; until then the other ways out of the state stay open, as
     * of a program that tries again, or waits with a time-out. It is one that {@link #acquires}, {@link #sends},
     * {@link #emits} or {@link #asks}.
     *
     * <p>{@code state("one", tries(acquires("tool")).then("two"), does("give up").then("putting back"))}
     */
    public static Branch.Builder tries(Branch.Builder step) {
        return step.tries();
    }

    /** Allows the component to stop here: it goes back to its first state. */
    public static Branch stops() {
        return new Branch.Builder(Branch.Kind.STOPS, "").then("");
    }

    /**
     * The component has ended in this state, which nothing else leads out of. It waits for nothing any more; nor do
     * components that only such call as have ended, where they wait for a call. To call a component that has ended is
     * to wait for ever.
     *
     * <p>{@code state("over", ends())}
     */
    public static Branch ends() {
        return new Branch.Builder(Branch.Kind.ENDS, "").then("");
    }

    public String name() {
        return name;
    }

    /** The states in the order of their declaration. */
    public List<String> states() {
        return states;
    }

    /** The calls that are offered, each once, in the order of their declaration. */
    public List<String> provided() {
        return steps.stream()
                .filter(step ->
                        step instanceof Step.Provides || step instanceof Step.Accepts || step instanceof Step.Streams)
                .map(step -> ((Step.Incoming) step).call())
                .distinct()
                .toList();
    }

    /** The calls that are made, each once, as {@code role.call}. */
    public List<String> requested() {
        return outgoing()
                .filter(step -> step instanceof Step.Requests || step instanceof Step.Asks)
                .map(Step.Outgoing::target)
                .distinct()
                .toList();
    }

    /** The one-way messages that are taken from the mailbox, each once, in the order of their declaration. */
    public List<String> received() {
        return steps(Step.Receives.class).map(Step.Receives::call).distinct().toList();
    }

    /** The one-way messages that are sent, each once, as {@code role.message}. */
    public List<String> sent() {
        return steps(Step.Sends.class).map(Step.Outgoing::target).distinct().toList();
    }

    /** The resources that are acquired, each once. */
    public List<String> acquired() {
        return steps(Step.Acquires.class)
                .map(Step.Acquires::resource)
                .distinct()
                .toList();
    }

    /** The state after a failure; empty if the component never fails. */
    public Optional<String> failure() {
        return failure;
    }

    /** Whether it may fail in this state. */
    boolean failsIn(String state) {
        return failure.isPresent()
                && !failure.get().equals(state)
                && steps(Step.Ends.class).noneMatch(step -> step.from().equals(state));
    }

    List<String> held(String state) {
        return held.getOrDefault(state, List.of());
    }

    List<String> owed(String state) {
        return owed.getOrDefault(state, List.of());
    }

    <S extends Step> Stream<S> steps(Class<S> kind) {
        return steps.stream().filter(kind::isInstance).map(kind::cast);
    }

    Stream<Step.Outgoing> outgoing() {
        return steps(Step.Outgoing.class);
    }

    /** Whether a call may be rejected. */
    boolean mayReject(String call) {
        return failure.isPresent() && offers(call)
                || steps(Step.Rejects.class).anyMatch(step -> step.call().equals(call))
                || steps(Step.Refuses.class).anyMatch(step -> step.call().equals(call));
    }

    boolean answersLater(String call) {
        return steps(Step.Accepts.class).anyMatch(step -> step.call().equals(call));
    }

    /** Whether a call is accepted and answered at once. */
    boolean answersAtOnce(String call) {
        return steps(Step.Provides.class).anyMatch(step -> step.call().equals(call));
    }

    /** Whether the answers of a call are a stream. */
    boolean isStream(String call) {
        return steps(Step.Streams.class).anyMatch(step -> step.call().equals(call));
    }

    List<Step> steps() {
        return steps;
    }

    List<Step.Requests> requests() {
        return steps(Step.Requests.class).toList();
    }

    List<Step> out(String state) {
        return steps.stream().filter(step -> step.from().equals(state)).toList();
    }

    boolean offers(String call) {
        return provided().contains(requireNonNull(call, "call"));
    }

    /** The states in which it may stop, in the order of their declaration. */
    List<String> stopStates() {
        return steps(Step.Stops.class).map(Step::from).toList();
    }

    /**
     * The states in which it takes part in a synchronised stop: where it waits for its next call after it could stop.
     * That is the state of the stop itself if only calls lead out of it, otherwise the waiting states that private
     * steps lead to. If there are none, it is the state of the stop.
     */
    List<String> synchronisedStops() {
        var found = new TreeSet<Integer>();
        for (var stop : stopStates()) {
            var ahead = new ArrayDeque<>(List.of(stop));
            var seen = new HashSet<>(ahead);
            var waiting = new TreeSet<Integer>();
            while (!ahead.isEmpty()) {
                var state = ahead.remove();
                if (waitsForCall(state)) {
                    waiting.add(states.indexOf(state));
                    continue;
                }
                out(state).stream()
                        .filter(Step.Does.class::isInstance)
                        .map(Step::to)
                        .filter(seen::add)
                        .forEach(ahead::add);
            }
            found.addAll(waiting.isEmpty() ? List.of(states.indexOf(stop)) : waiting);
        }
        return found.stream().map(states::get).toList();
    }

    private boolean waitsForCall(String state) {
        return out(state).stream().allMatch(step -> step instanceof Step.Incoming || step instanceof Step.Stops);
    }

    /** The name. */
    @Override
    public String toString() {
        return name;
    }
}
