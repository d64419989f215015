package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.actor.CallObserver;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import java.util.function.Predicate;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/**
 * Reports the calls of actors to a {@link WiringMonitor}: the observer of a space whose actors are the components of a
 * wiring.
 *
 * {@snippet :
 * var monitor = WiringMonitor.of(wiring);
 * var settings = SpaceSettings.named("pictures").withCallObserver(new WiringObserver(monitor));
 * }
 *
 * <p>The name of an actor is that of its component; of an actor without a name, that of its type with a small letter. A
 * method that the component {@code receives} is a message; any other is a call, which is taken when it begins, and
 * answered when its promise is settled. A caller that {@code asks} gets the answer then. What is passed on by a
 * connection to a service is a call of its caller.
 *
 * <p>An error is an answer, except of a call that
 *
 * <ul>
 *   <li>has not begun: the component rejects it;
 *   <li>the component {@code refuses} in some state: it does so;
 *   <li>the component {@code rejects} in the state in which it begins: it does so, unless it {@code accepts} the call
 *       in that state, too;
 *   <li>its caller cancels, or a time limit of its {@code ask}: it is given up if it has not begun, or if the caller's
 *       protocol {@code cancels} it or has a state {@code orTimeout}. What the other component then answers is not
 *       reported.
 * </ul>
 *
 * <p>A call of a component to an actor that the wiring does not have is a violation, and so is a call that the
 * component answers to others, made by an actor that the wiring does not have. A call {@code pay} from outside, for
 * example of the test, is the private step {@code pay from outside}, and its answer {@code answers pay}, where the
 * component has the first of these steps, or both, and the monitor observes them ({@link #stepsFromOutside}); else it
 * is not reported.
 *
 * <p><b>Role.</b> Needs {@code troupe-actor-core} on the class path. What a program calls otherwise than its wiring
 * does is translated: {@link #WiringObserver(WiringMonitor, Translation)}. The results of streams, and messages that a
 * bounded mailbox refuses, are not seen: report them to the monitor. {@code Promise.orTimeout} settles no request that
 * has begun, so such a time-out is seen only if the caller then cancels the request. A failure ({@code failsTo}) is not
 * told from an error: a translation reports it in place of the answer, by {@link Followed#failed}. Nor is a provider's
 * own {@code CancellationException} or {@code TimeoutException} from a caller that has given up, where the caller's
 * protocol declares that.
 *
 * <p><b>Threads.</b> Any thread; spaces may share one.
 */
public final class WiringObserver implements CallObserver {
    /** What a call of an actor is in a wiring. */
    public interface Translation {
        /**
         * Called once for each request and message, before it is reported.
         *
         * @return empty if it is no part of the wiring
         */
        Optional<Followed> of(Party from, Party to, Call call);
    }

    /**
     * A call as the wiring has it.
     *
     * @param caller the component that makes it; empty for a call from outside. A call of itself is a private step
     * @param target {@code component.call}
     * @param isAnsweredAtOnce whether it is answered when it begins, not when its promise is settled
     * @param failed what is done in place of the answer when the promise is settled with an error; null to report an
     *     answer or a rejection
     */
    public record Followed(
            String caller,
            String target,
            boolean isAnsweredAtOnce,
            @Nullable Consumer<Throwable> failed) {
        /** A call that is answered when its promise is settled. */
        public static Followed of(String caller, String target) {
            return new Followed(caller, target, false, null);
        }
    }

    static final String FROM_OUTSIDE = " from outside";
    static final String ANSWERS = "answers ";

    private final WiringMonitor monitor;
    private final Wiring wiring;
    private final ActorNames names;
    private final Translation translation;
    /** Guarded by the monitor, as are the other maps and names: a call is noted and reported under one lock. */
    private final Map<Call, Followed> queued = new HashMap<>();

    private final Set<Call> undecided = new HashSet<>(); // begun, and not reported: an error will be a rejection
    private final Map<Call, String> outside = new HashMap<>(); // the component that got a call from outside

    public WiringObserver(WiringMonitor monitor) {
        this.monitor = requireNonNull(monitor, "monitor");
        this.wiring = monitor.wiring();
        this.names = new ActorNames(wiring.components()::contains);
        this.translation = this::byName;
    }

    /** @param translation finds the components and the calls, in place of the names of actors and methods */
    public WiringObserver(WiringMonitor monitor, Translation translation) {
        this.monitor = requireNonNull(monitor, "monitor");
        this.wiring = monitor.wiring();
        this.names = new ActorNames(wiring.components()::contains);
        this.translation = requireNonNull(translation, "translation");
    }

    @Override
    public void called(Party from, Party to, Call call) {
        translation.of(from, to, call).ifPresent(followed -> called(followed, call));
    }

    private void called(Followed followed, Call call) {
        if (followed.caller().equals(component(followed))) {
            return; // a private step
        }
        if (followed.caller().isEmpty()) {
            synchronized (monitor) {
                outside.put(call, component(followed));
            }
            return;
        }
        synchronized (monitor) {
            queued.put(call, followed);
        }
        if (isMessage(followed)) {
            monitor.on(Kind.SENT, followed.caller(), followed.target());
        } else {
            monitor.asked(followed.caller(), followed.target());
        }
        call.whenSettled(error -> settled(call, followed, error));
    }

    private Optional<Followed> byName(Party from, Party to, Call call) {
        synchronized (monitor) {
            if (call.isPassedOn()) {
                names.passing(from, call);
                return Optional.empty();
            }
            if (ActorNames.isOfTheBroker(call)) {
                return Optional.empty();
            }
            Party caller = names.caller(from);
            String target = names.of(to) + "." + call.method();
            if (ActorNames.isActor(caller) && wiring.components().contains(names.of(caller))) {
                return Optional.of(Followed.of(names.of(caller), target));
            }
            if (!ActorNames.isActor(caller)) {
                return Optional.of(Followed.of("", target));
            }
            return offers(target) ? Optional.of(Followed.of(names.of(caller), target)) : Optional.empty();
        }
    }

    /**
     * The private steps of a wiring that are calls from outside: {@code pay from outside}, and the {@code answers pay}
     * of a component that has this step, too. For {@link WiringMonitor#observing}.
     */
    public static Set<String> stepsFromOutside(Wiring wiring) {
        return wiring.components().stream()
                .flatMap(component -> stepsFromOutside(wiring.protocol(component)).stream())
                .collect(Collectors.toSet());
    }

    private static Set<String> stepsFromOutside(Protocol protocol) {
        var labels = protocol.steps(Step.Does.class).map(Step.Does::label).collect(Collectors.toSet());
        return labels.stream()
                .filter(label -> label.endsWith(FROM_OUTSIDE))
                .map(label -> label.substring(0, label.length() - FROM_OUTSIDE.length()))
                .filter(method -> method.indexOf(' ') < 0)
                .flatMap(method -> Stream.of(method + FROM_OUTSIDE, ANSWERS + method))
                .filter(labels::contains)
                .collect(Collectors.toSet());
    }

    private void beginsFromOutside(Call call) {
        String component;
        synchronized (monitor) {
            names.begun(call);
            component = outside.remove(call);
        }
        if (component != null) {
            did(component, call.method() + FROM_OUTSIDE);
            if (call.isRequest()) {
                call.whenSettled(error -> did(component, ANSWERS + call.method()));
            }
        }
    }

    private void did(String component, String label) {
        boolean isDeclared = wiring.components().contains(component)
                && stepsFromOutside(wiring.protocol(component)).contains(label);
        if (isDeclared && monitor.observes(label)) {
            monitor.did(component, label);
        }
    }

    private boolean offers(String target) {
        String component = target.substring(0, target.indexOf('.'));
        String call = target.substring(target.indexOf('.') + 1);
        return wiring.components().contains(component)
                && (wiring.protocol(component).offers(call)
                        || wiring.protocol(component).received().contains(call));
    }

    private boolean isMessage(Followed followed) {
        String component = component(followed);
        return wiring.components().contains(component)
                && wiring.protocol(component).received().contains(method(followed));
    }

    private static String component(Followed followed) {
        return followed.target().substring(0, followed.target().indexOf('.'));
    }

    private static String method(Followed followed) {
        return followed.target().substring(followed.target().indexOf('.') + 1);
    }

    @Override
    public void dropped(Party actor, Call call) {
        synchronized (monitor) {
            outside.remove(call);
            names.dropped(call);
            if (!call.isRequest()) { // which is never settled
                queued.remove(call);
            }
        }
    }

    @Override
    public void begun(Party actor, Call call) {
        boolean isFollowed;
        synchronized (monitor) {
            var followed = queued.remove(call);
            isFollowed = followed != null;
            if (followed != null) {
                begun(call, followed);
            }
        }
        if (!isFollowed) {
            beginsFromOutside(call);
        }
    }

    private void begun(Call call, Followed followed) {
        if (isMessage(followed)) {
            monitor.on(Kind.RECEIVED, component(followed), method(followed));
        } else if (isRejectedByAnError(followed)) {
            undecided.add(call);
        } else {
            monitor.taken(followed.caller(), followed.target());
            if (followed.isAnsweredAtOnce()) {
                answered(followed);
            }
        }
    }

    /** Whether a call that begins now is rejected if it is settled with an error. */
    private boolean isRejectedByAnError(Followed followed) {
        if (followed.isAnsweredAtOnce() || followed.failed() != null || !ofProvider(followed, Step.Rejects.class)) {
            return false;
        }
        boolean isAccepted = ofProvider(followed, Step.Accepts.class)
                && monitor.allows(Kind.TAKEN, followed.caller(), followed.target());
        return !isAccepted && monitor.allows(Kind.REJECTED, followed.caller(), followed.target());
    }

    /** Whether the component has such a step for this call. */
    private boolean ofProvider(Followed followed, Class<? extends Step> kind) {
        String component = component(followed);
        return wiring.components().contains(component)
                && wiring.protocol(component)
                        .steps(kind)
                        .anyMatch(step -> callOf(step).equals(method(followed)));
    }

    private static String callOf(Step step) {
        return switch (step) {
            case Step.Incoming offer -> offer.call();
            case Step.Refuses refuses -> refuses.call();
            default -> "";
        };
    }

    private void settled(Call call, Followed followed, @Nullable Throwable error) {
        if (error != null && followed.failed() != null) {
            synchronized (monitor) {
                queued.remove(call);
            }
            followed.failed().accept(error);
            return;
        }
        synchronized (monitor) {
            boolean isBegun = queued.remove(call) == null;
            boolean isUndecided = undecided.remove(call);
            if (isBegun && followed.isAnsweredAtOnce()) {
                return; // and was reported
            }
            if (error != null && isGivenUp(error) && (!isBegun || mayGiveUp(followed))) {
                monitor.on(asks(followed) ? Kind.GAVE_UP : Kind.TIMED_OUT, followed.caller(), followed.target());
            } else if (error != null && (!isBegun || isUndecided || ofProvider(followed, Step.Refuses.class))) {
                monitor.on(Kind.REJECTED, followed.caller(), followed.target());
                takes(followed, Kind.GOT_REJECTION);
            } else {
                if (isUndecided) {
                    monitor.taken(followed.caller(), followed.target());
                }
                answered(followed);
            }
        }
    }

    private static boolean isGivenUp(Throwable error) {
        return error instanceof CancellationException || error instanceof TimeoutException;
    }

    /** Whether its caller may give up a call that has begun. */
    private boolean mayGiveUp(Followed followed) {
        return makes(followed, Step.Cancels.class, step -> true)
                || makes(followed, Step.Requests.class, step -> step.onTimeout().isPresent());
    }

    private void answered(Followed followed) {
        monitor.answered(followed.caller(), followed.target());
        takes(followed, Kind.GOT_ANSWER);
    }

    /** The caller goes on, if it has not waited. */
    private void takes(Followed followed, Kind how) {
        if (asks(followed)) {
            monitor.on(how, followed.caller(), followed.target());
        }
    }

    private boolean asks(Followed followed) {
        return makes(followed, Step.Asks.class, step -> true);
    }

    /** Whether the caller has such a step for this call. */
    private <S extends Step.Outgoing> boolean makes(Followed followed, Class<S> kind, Predicate<S> which) {
        return wiring.components().contains(followed.caller())
                && wiring.protocol(followed.caller())
                        .steps(kind)
                        .anyMatch(step -> step.call().equals(method(followed))
                                && wiring.provider(followed.caller(), step).equals(component(followed))
                                && which.test(step));
    }
}
