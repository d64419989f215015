package io.troupe.broker;

import io.troupe.actor.promise.Promise;
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
        if (methods.isEmpty() && !called.names().isEmpty()) {
            return "is no actor that can be called from other hosts";
        }
        List<String> missing =
                called.names().stream().filter(each -> !methods.contains(each)).toList();
        return missing.isEmpty()
                ? null
                : "has no " + String.join(", ", missing) + "; it has " + String.join(", ", methods);
    }

    @Override
    @Nullable
    Promise<?> send(CallDispatcher.Call call, RemoteCaller remote, Duration limit) throws NotSentException {
        return remote.send(this, method(call), call.toInvoke(), limit);
    }

    @Override
    @Nullable
    Object result(CallDispatcher.Call call, @Nullable Object answer) {
        return method(call).decodeResult(((CallMessages.Result) Objects.requireNonNull(answer)).value());
    }

    private CallableMethods.CallableMethod method(CallDispatcher.Call call) {
        return interfaces.of(call.method.getDeclaringClass()).method(call.method);
    }
}
