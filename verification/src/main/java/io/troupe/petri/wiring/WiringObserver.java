package io.troupe.petri.wiring;

import static java.util.Objects.requireNonNull;

import io.troupe.actor.CallObserver;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.CancellationException;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import java.util.stream.Collectors;
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
 * answered when its promise is settled, also by an error unless the component rejects the call. A caller that
 * {@code asks} gets the answer then. What is passed on by a connection to a service is a call of its caller.
 *
 * <p>A call of a component to an actor that the wiring does not have is a violation, and so is a call that the
 * component answers to others, made by an actor that the wiring does not have. A call {@code pay} from outside, for
 * example of the test, is the private step {@code pay from outside}, and its answer {@code answers pay}, where the
 * component has these steps and the monitor observes them ({@link #stepsFromOutside}); else it is not reported.
 *
 * <p><b>Role.</b> Needs {@code troupe-actor-core} on the class path. What a program calls otherwise than its wiring
 * does is translated: {@link #WiringObserver(WiringMonitor, Translation)}. The results of streams, and messages that a
 * bounded mailbox refuses, are not seen: report them to the monitor.
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
    private final Map<Call, Followed> queued = new HashMap<>(); // guarded by this, as is names and outside
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
            synchronized (this) {
                outside.put(call, component(followed));
            }
            return;
        }
        synchronized (this) {
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
        synchronized (this) {
            if (call.isPassedOn()) {
                names.passing(from, to, call);
                return Optional.empty();
            }
            if (ActorNames.isOfTheBroker(call)) {
                return Optional.empty();
            }
            Party caller = names.caller(from, call);
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

    /** The private steps of a wiring that are calls from outside: for {@link WiringMonitor#observing}. */
    public static Set<String> stepsFromOutside(Wiring wiring) {
        return wiring.components().stream()
                .flatMap(component -> wiring.protocol(component).steps(Step.Does.class))
                .map(Step.Does::label)
                .filter(label -> label.endsWith(FROM_OUTSIDE) || label.startsWith(ANSWERS))
                .collect(Collectors.toSet());
    }

    private void beginsFromOutside(Call call) {
        String component;
        synchronized (this) {
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
                && wiring.protocol(component)
                        .steps(Step.Does.class)
                        .anyMatch(step -> step.label().equals(label));
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

    private synchronized @Nullable Followed dequeue(Call call) {
        return queued.remove(call);
    }

    @Override
    public synchronized void dropped(Party actor, Call call) {
        outside.remove(call);
    }

    @Override
    public void begun(Party actor, Call call) {
        Followed followed = dequeue(call);
        if (followed == null) {
            beginsFromOutside(call);
            return;
        }
        if (isMessage(followed)) {
            monitor.on(Kind.RECEIVED, component(followed), method(followed));
            return;
        }
        monitor.taken(followed.caller(), followed.target());
        if (followed.isAnsweredAtOnce()) {
            answered(followed);
        }
    }

    private void settled(Call call, Followed followed, @Nullable Throwable error) {
        boolean isBegun = dequeue(call) == null;
        if (error != null && followed.failed() != null) {
            followed.failed().accept(error);
        } else if (error != null && !isBegun && isGivenUp(error)) {
            monitor.on(asks(followed) ? Kind.GAVE_UP : Kind.TIMED_OUT, followed.caller(), followed.target());
        } else if (error != null && (!isBegun || mayReject(followed))) {
            monitor.on(Kind.REJECTED, followed.caller(), followed.target());
            takes(followed, Kind.GOT_REJECTION);
        } else if (!followed.isAnsweredAtOnce()) {
            answered(followed);
        }
    }

    private static boolean isGivenUp(Throwable error) {
        return error instanceof CancellationException || error instanceof TimeoutException;
    }

    private boolean mayReject(Followed followed) {
        String component = component(followed);
        return wiring.components().contains(component)
                && wiring.protocol(component).mayReject(method(followed));
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
        return wiring.components().contains(followed.caller())
                && wiring.protocol(followed.caller())
                        .steps(Step.Asks.class)
                        .anyMatch(step -> step.call().equals(method(followed))
                                && wiring.provider(followed.caller(), step).equals(component(followed)));
    }
}
