package io.troupe.broker;

import io.troupe.actor.Promise;
import io.troupe.actor.internal.Message;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.bus.Address;
import java.time.Duration;
import java.util.List;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** A running actor in another process, as its broker offers it. Used from any thread. */
final class RemoteActor extends RunningActor {
    private final List<String> methods;
    private final CallableInterfaces interfaces;
    private volatile boolean retired;
    private volatile boolean over;

    /** @param methods the names of the methods that it has; empty if it is no actor */
    RemoteActor(Address address, List<String> methods, CallableInterfaces interfaces) {
        super(address);
        this.methods = methods;
        this.interfaces = interfaces;
    }

    /** It gets no new calls, but may answer earlier ones: it was withdrawn by its process. */
    void retire() {
        retired = true;
    }

    /** It has ended, or cannot be reached any more: it answers no call. */
    void end() {
        retired = true;
        over = true;
        settleWatches();
    }

    @Override
    boolean hasEnded() {
        return retired;
    }

    @Override
    boolean isOver() {
        return over;
    }

    @Override
    @Nullable
    String mismatch(Class<?> type) {
        CallableMethods called;
        try {
            called = interfaces.of(type);
        } catch (IllegalArgumentException notCallable) {
            return "is on another host, and " + notCallable.getMessage();
        }
        List<String> needed = called.abstractNames();
        if (methods.isEmpty() && !needed.isEmpty()) {
            return "is no actor that can be called from other hosts";
        }
        List<String> missing =
                needed.stream().filter(each -> !methods.contains(each)).toList();
        return missing.isEmpty()
                ? null
                : "has no " + String.join(", ", missing) + "; it has " + String.join(", ", methods);
    }

    @Override
    @Nullable
    Promise<?> send(Class<?> type, QueueEntry call, RemoteCaller remote, @Nullable Duration limit)
            throws NotSentException {
        CallableMethods.CallableMethod method = method(type, call);
        if (!methods.contains(method.name)) { // a default method, which its interface there need not have
            throw new NotSentException(new ProviderException(
                    address() + " has no " + method.name + "; it has " + String.join(", ", methods), null));
        }
        return remote.send(this, method, Message.argumentsOf(call), limit);
    }

    @Override
    @Nullable
    Object result(Class<?> type, QueueEntry call, @Nullable Object answer) {
        return method(type, call).decodeResult(((CallMessages.Result) Objects.requireNonNull(answer)).value());
    }

    private CallableMethods.CallableMethod method(Class<?> type, QueueEntry call) {
        return Objects.requireNonNull(interfaces.of(type).method(Message.signatureOf(call)));
    }
}
