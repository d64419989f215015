package io.troupe.broker;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Request;
import io.troupe.actor.Timer;
import io.troupe.actor.internal.Forwarder;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.bus.BusException;
import io.troupe.bus.BusTimeoutException;
import io.troupe.bus.RemoteFailure;
import io.troupe.bus.internal.UnreadableException;
import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The actor behind a connection: it has the type of the service, and passes each call on to the current provider. Keeps
 * the calls that wait for a provider, and those without an answer yet.
 */
final class ServiceLink extends Actor implements Forwarder, Broker.Connection {
    private final ActorServices services;
    private final Class<?> type;
    private final Need need;
    private final ConnectionSettings settings;
    private final Deferred<ServiceRecord> first;
    private final LinkedHashMap<QueueEntry, PendingCall> waiting =
            new LinkedHashMap<>(); // in the order of their arrival
    private final Map<QueueEntry, PendingCall> underWay = new LinkedHashMap<>();
    private @Nullable RunningActor current;
    private @Nullable IllegalArgumentException mismatch;
    private String noProvider = "none has been found yet";
    private @Nullable EventPublisher events;
    // of instances that have not ended
    private final Map<RunningActor, Deferred<@Nullable Void>> watches = new HashMap<>();
    private final RemoteCaller remote;

    ServiceLink(
            ActorServices services,
            Class<?> type,
            Need need,
            ConnectionSettings settings,
            Deferred<ServiceRecord> first) {
        this.services = services;
        this.type = type;
        this.need = need;
        this.settings = settings;
        this.first = first;
        this.remote = services.newCaller();
    }

    @Override
    protected void started() {
        events = new EventPublisher(services.observer(), context().space());
        services.broker().connect(need, this).onSettled((provider, error) -> {
            if (error != null) {
                noProvider = Reasons.of(error);
                first.reject(error);
            } else if (mismatch != null) {
                first.reject(mismatch);
            } else {
                first.resolve(provider);
            }
        });
    }

    // ---- the current provider

    @Override
    public void use(ServiceRecord provider) {
        RunningActor next = services.find(provider.provider());
        String unfit = next == null ? null : next.mismatch(type);
        current = next;
        mismatch = null;
        if (next == null) {
            noProvider = provider.provider() + " has ended, or is not an actor that was published in this process";
        } else if (unfit != null) {
            current = null;
            mismatch = new IllegalArgumentException("\"" + need.by() + "\" calls " + ProviderRegistry.what(need)
                    + " as " + type.getName() + ", and its provider " + provider.provider() + " " + unfit);
            rejectAllWaiting(mismatch);
        } else {
            watch(next);
            sendWaiting();
        }
    }

    private void watch(RunningActor life) {
        watches.computeIfAbsent(life, one -> {
            var watch = one.watch();
            watch.thenRun(() -> hasEnded(one));
            return watch;
        });
    }

    @Override
    public void lost(MissingServiceException why) {
        current = null;
        mismatch = null;
        noProvider = Reasons.of(why);
    }

    private void hasEnded(RunningActor life) {
        watches.remove(life);
        if (current == life) {
            current = null;
            noProvider = life.address() + " has ended";
        }
        for (PendingCall call : List.copyOf(underWay.values())) {
            if (call.sentTo == life) {
                underWay.remove(call.call);
                call.reject(ended(call, null));
                if (life instanceof RemoteActor && call.sent != null) {
                    call.sent.cancel(); // no answer will come
                }
            }
        }
        if (life instanceof RemoteActor far) {
            remote.failStreamsOf(far, new ServiceCallException(far.address() + " ended before its stream", true, null));
        }
    }

    private ServiceCallException ended(PendingCall call, @Nullable Throwable cause) {
        return new ServiceCallException(
                call.receiver() + " ended while \"" + need.by() + "\" waited for its answer to " + call, true, cause);
    }

    // ---- calls

    @Override
    public void forward(Message message) {
        take(new PendingCall(message, null));
    }

    @Override
    public Promise<?> forward(Request<?> request) {
        Deferred<@Nullable Object> answer = context().space().deferred();
        take(new PendingCall(request, answer));
        return answer;
    }

    @Override
    public void abandoned(Request<?> request) {
        PendingCall waited = waiting.remove(request);
        PendingCall abandoned = waited == null ? underWay.remove(request) : waited;
        if (abandoned != null) {
            abandoned.cancel();
        }
    }

    private void take(PendingCall call) {
        if (mismatch != null) {
            rejectUnsent(call, mismatch);
        } else if (canSend()) {
            send(call);
        } else if (waiting.size() >= settings.capacity()) {
            rejectUnsent(
                    call, notSent(call, "was rejected: " + waiting.size() + " calls wait already, and " + noProvider));
        } else {
            var here = Home.current();
            call.turn = here == null ? null : here.captureContext();
            waiting.put(call.call, call);
            Duration limit = call.isOneWay() ? settings.oneWayLimit() : settings.waitLimit();
            call.limit = context().after(limit, () -> {
                waiting.remove(call.call);
                rejectUnsent(call, notSent(call, "found no provider within " + limit + ": " + noProvider));
            });
        }
    }

    /** Returns whether the provider can be called. Its end may already be known before this actor is notified. */
    private boolean canSend() {
        return current != null && !current.hasEnded();
    }

    private void sendWaiting() {
        while (canSend() && !waiting.isEmpty()) {
            PendingCall call = waiting.pollFirstEntry().getValue();
            call.cancelLimit();
            Runnable end = call.turn == null ? () -> {} : call.turn.get();
            try {
                send(call);
            } finally {
                end.run();
            }
        }
    }

    private void send(PendingCall call) {
        if (call.isAbandoned()) {
            call.reject(new CancellationException(call + " was given up by its caller before it was sent"));
            return;
        }
        var to = Objects.requireNonNull(current);
        call.sentTo = to;
        Promise<?> answer;
        try {
            answer = to.send(type, call.call, remote, settings.answerLimit());
        } catch (RunningActor.NotSentException unsent) {
            rejectUnsent(call, notSent(call, "was rejected: " + Reasons.of(unsent.why())));
            return;
        }
        if (answer != null) {
            underWay.put(call.call, call);
            call.sent = answer;
            Duration limit = settings.answerLimit();
            if (limit != null && !(to instanceof RemoteActor)) { // the bus has that limit
                call.limit = context().after(limit, () -> isOverdue(call));
            }
            answer.onSettled((value, error) -> answered(call, value, error));
        }
    }

    private void answered(PendingCall call, @Nullable Object value, @Nullable Throwable error) {
        if (underWay.remove(call.call) == null) {
            if (call.sentTo instanceof RemoteActor) {
                return; // reported by the bus
            }
            if (!(error instanceof ActorStoppedException) && !call.isCancelled()) { // neither is an answer
                events().publish(new BrokerEvent.Late(call.receiver(), call.toString(), error));
            }
        } else if (call.sentTo instanceof RemoteActor far) {
            answered(call, far, value, error);
        } else if (error == null) {
            call.resolve(value);
        } else if (error instanceof ActorStoppedException && call.receiverHasEnded()) {
            call.reject(ended(call, error));
        } else {
            call.reject(error);
        }
    }

    /** The answer of an actor in another process, or the reason why there is none. */
    private void answered(PendingCall call, RemoteActor far, @Nullable Object value, @Nullable Throwable error) {
        switch (error) {
            case null -> {
                try {
                    call.resolve(far.result(type, call.call, value));
                } catch (UnreadableException unreadable) {
                    call.reject(unanswered(call, unreadable));
                }
            }
            case RemoteFailure failure ->
                call.reject(new RemoteFailure(far.address(), call.toString(), failure.type(), failure.problem()));
            case BusTimeoutException timeout -> call.reject(overdue(call, timeout));
            case BusException lost
            when lost.mayHaveRun() -> {
                services.checkNow(far);
                call.reject(far.hasEnded() ? ended(call, lost) : unanswered(call, lost));
            }
            case BusException undelivered -> {
                services.checkNow(far);
                call.reject(notSent(call, "was not delivered: " + Reasons.of(undelivered)));
            }
            default -> call.reject(error);
        }
    }

    private ServiceCallException unanswered(PendingCall call, RuntimeException why) {
        return new ServiceCallException(
                call.receiver() + " was sent " + call + " by \"" + need.by() + "\", and there is no answer: "
                        + Reasons.of(why),
                true,
                why);
    }

    private void isOverdue(PendingCall call) {
        underWay.remove(call.call);
        call.reject(overdue(call, null));
    }

    private ServiceCallException overdue(PendingCall call, @Nullable Throwable cause) {
        return new ServiceCallException(
                call.receiver() + " did not answer " + call + " to \"" + need.by() + "\" "
                        + (settings.answerLimit() == null ? "in time" : "within " + settings.answerLimit()),
                true,
                cause);
    }

    private ServiceCallException notSent(PendingCall call, String what) {
        return new ServiceCallException(
                call + " of \"" + need.by() + "\", which needs " + ProviderRegistry.what(need) + ", " + what,
                false,
                null);
    }

    private void rejectAllWaiting(Throwable why) {
        while (!waiting.isEmpty()) {
            rejectUnsent(waiting.pollFirstEntry().getValue(), why);
        }
    }

    /** Rejects a call that was not sent to any provider. */
    private void rejectUnsent(PendingCall call, Throwable why) {
        call.failCallbacks(why); // a one-way call has no promise to reject
        if (!call.reject(why)) {
            events().publish(new BrokerEvent.CallRejected(need, call.toString(), why));
        }
    }

    private EventPublisher events() {
        return Objects.requireNonNull(events);
    }

    @Override
    protected void stopped() {
        watches.forEach(RunningActor::unwatch);
        first.reject(new IllegalStateException("the connection of \"" + need.by() + "\" was closed"));
        while (!waiting.isEmpty()) {
            PendingCall call = waiting.pollFirstEntry().getValue();
            rejectUnsent(call, notSent(call, "was not sent: the connection is closed"));
        }
        for (PendingCall call : List.copyOf(underWay.values())) {
            if (call.sentTo instanceof RemoteActor && call.sent != null) {
                call.sent.cancel();
            }
            call.reject(new ServiceCallException(
                    "the connection of \"" + need.by() + "\" was closed while it waited for the answer of "
                            + call.receiver() + " to " + call,
                    true,
                    null));
        }
        remote.close(new IllegalStateException("the connection of \"" + need.by() + "\" was closed"));
        services.broker().disconnect(this);
    }

    /** A call that is queued or waits for its answer. Used on the connection's space. */
    private static final class PendingCall {
        final QueueEntry call; // a Message or a Request
        private final @Nullable Deferred<@Nullable Object> answer; // null: a one-way call

        @Nullable
        RunningActor sentTo;

        @Nullable
        Promise<?> sent; // the provider's promise

        private boolean cancelled;

        @Nullable
        Supplier<Runnable> turn; // what its turn carries, such as a time limit, for a call that waits; null: nothing

        @Nullable
        Timer limit;

        PendingCall(QueueEntry call, @Nullable Deferred<@Nullable Object> answer) {
            this.call = call;
            this.answer = answer;
        }

        void resolve(@Nullable Object value) {
            cancelLimit();
            if (answer != null) {
                answer.resolve(value);
            }
        }

        /** Rejects the call. Returns false for a one-way call, whose error has to be reported in another way. */
        boolean reject(Throwable error) {
            cancelLimit();
            if (answer == null) {
                return false;
            }
            answer.reject(error);
            return true;
        }

        /** Cancels the call: a provider that has not begun it does not execute it. */
        void cancel() {
            cancelled = true;
            if (sent != null) {
                sent.cancel();
            }
            cancelLimit();
            if (answer != null) {
                answer.cancel();
            }
        }

        boolean isCancelled() {
            return cancelled;
        }

        void cancelLimit() {
            if (limit != null) {
                limit.cancel();
                limit = null;
            }
        }

        boolean isOneWay() {
            return answer == null;
        }

        /** Returns whether no caller waits for the answer any more. */
        boolean isAbandoned() {
            return call instanceof Request<?> request && request.isAbandoned();
        }

        /** Ends the callbacks of a call that was not sent. */
        void failCallbacks(Throwable why) {
            for (Object each : Message.argumentsOf(call)) {
                if (each instanceof Callback<?> callback) {
                    callback.fail(why);
                }
            }
        }

        String receiver() {
            return sentTo == null ? "no provider" : sentTo.address().toString();
        }

        boolean receiverHasEnded() {
            return sentTo != null && sentTo.hasEnded();
        }

        @Override
        public String toString() {
            return Message.methodOrWords(call);
        }
    }
}
