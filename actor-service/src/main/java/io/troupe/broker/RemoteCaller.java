package io.troupe.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.bus.Bus;
import io.troupe.bus.BusException;
import io.troupe.bus.BusPort;
import io.troupe.bus.internal.CborItem;
import io.troupe.bus.internal.OwnName;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** Sends the calls of one connection to actors in other processes. On the connection's space, and for its actor. */
final class RemoteCaller {
    private static final Duration WITH_STREAM = Duration.ofSeconds(5); // to confirm a one-way call

    private final Supplier<BusPort> attach;
    private final CallableMethods.Values values;
    private final IncomingStreams streams;
    private @Nullable BusPort port; // attached at the first call

    /** @param bus null if there are no other processes */
    RemoteCaller(@Nullable Bus bus, Supplier<String> names, CallableMethods.Values values) {
        this.attach = () -> Objects.requireNonNull(bus, "no bus").attach(new OwnName(names.get()));
        this.values = values;
        this.streams = new IncomingStreams(values);
    }

    private BusPort port() {
        BusPort known = port;
        if (known == null) {
            known = attach.get();
            known.answer(CallMessages.STREAM, streams::receive);
            port = known;
        }
        return known;
    }

    /**
     * Sends a call.
     *
     * @return the answer, rejected as by {@link BusPort#ask}; null for a one-way call
     */
    @Nullable
    Promise<CallMessages.Result> send(
            RemoteActor to,
            CallableMethods.CallableMethod method,
            @Nullable Object[] arguments,
            @Nullable Duration limit)
            throws RunningActor.NotSentException {
        List<Long> opened = new ArrayList<>();
        CallMessages.Call call;
        try {
            CborItem encoded = method.encode(arguments, parameter -> {
                opened.add(openStream(to, method, arguments[parameter], parameter));
                return opened.getLast();
            });
            call = new CallMessages.Call(port().address(), method.name, encoded);
        } catch (RuntimeException refused) {
            streams.forget(opened); // the connection ends the callbacks
            throw new RunningActor.NotSentException(refused);
        }
        if (method.isOneWay() && opened.isEmpty()) {
            sendNotice(to, call);
            return null;
        }
        Duration until = limit == null && method.isOneWay() ? WITH_STREAM : limit;
        Promise<CallMessages.Result> answer = port().ask(to.address(), CallMessages.CALL, call, until);
        if (!opened.isEmpty()) {
            answer.onSettled((result, error) -> {
                if (error instanceof BusException undelivered) {
                    if (undelivered.mayHaveRun()) {
                        streams.failThoseWithoutItems(opened, error); // the others get their end from the actor
                    } else {
                        streams.fail(opened, error);
                    }
                }
            });
        }
        return method.isOneWay() ? null : answer;
    }

    private void sendNotice(RemoteActor to, CallMessages.Call call) throws RunningActor.NotSentException {
        try {
            port().send(to.address(), CallMessages.CALL, call);
        } catch (BusException closed) {
            throw new RunningActor.NotSentException(closed);
        }
    }

    @SuppressWarnings("unchecked") // the method declares the type of its callback
    private long openStream(
            RemoteActor to, CallableMethods.CallableMethod method, @Nullable Object callback, int parameter) {
        var reader = (Callback<@Nullable Object>) Objects.requireNonNull(callback);
        return streams.open(to, method.toString(), reader, method.streamed(parameter));
    }

    /** An actor has ended: its streams get no more items. */
    void failStreamsOf(RemoteActor actor, Throwable why) {
        streams.failAllOf(actor, why);
    }

    void close(Throwable why) {
        streams.failAll(why);
        if (port != null) {
            port.close();
        }
    }
}
