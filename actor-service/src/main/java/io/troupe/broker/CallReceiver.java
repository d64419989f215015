package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.Deferred;
import io.troupe.actor.LibraryAccess;
import io.troupe.actor.Promise;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.internal.NotBegunException;
import io.troupe.bus.internal.OwnName;
import io.troupe.bus.internal.UnreadableException;
import java.lang.reflect.InvocationTargetException;
import org.jspecify.annotations.Nullable;

/**
 * Receives the calls of other processes for one running actor, at a port of its address. Opened on the actor's space,
 * where the port's queue keeps the calls in order until the space gets to them.
 */
final class CallReceiver {
    private final BusPort port;
    private final ActorSpace space;
    private final ActorProvider.Running actor;
    private final CallableMethods methods;
    private final CallableMethods.Values values;
    private volatile boolean withdrawn;

    private CallReceiver(
            BusPort port,
            ActorSpace space,
            ActorProvider.Running actor,
            CallableMethods methods,
            CallableMethods.Values values) {
        this.port = port;
        this.space = space;
        this.actor = actor;
        this.methods = methods;
        this.values = values;
    }

    /** @throws IllegalArgumentException if another port has that name */
    static CallReceiver open(
            Bus bus,
            ActorSpace space,
            ActorProvider.Running actor,
            CallableMethods methods,
            CallableMethods.Values values) {
        BusPort port = bus.attach(new OwnName(actor.address().name()));
        var receiver = new CallReceiver(port, space, actor, methods, values);
        receiver.port.answer(CallMessages.CALL, receiver::receive);
        return receiver;
    }

    /** Rejects new calls, or accepts them again; earlier calls are answered. */
    void setWithdrawn(boolean is) {
        withdrawn = is;
    }

    void close() {
        port.close();
    }

    private Promise<CallMessages.Result> receive(CallMessages.Call call) {
        if (withdrawn) {
            throw new NotBegunException("it was withdrawn");
        }
        CallableMethods.CallableMethod method = methods.method(call.method());
        if (method == null) {
            throw new NotBegunException("it has no method " + call.method() + "; " + methods.hint(call.method()));
        }
        @Nullable Object[] arguments;
        try {
            arguments = method.decode(
                    call.arguments(),
                    (stream, type) -> new OutgoingStream(space, port, call.caller(), stream, type, values));
        } catch (UnreadableException unreadable) {
            throw new NotBegunException("cannot read the arguments: " + unreadable.getMessage());
        }
        return answer(method, invoke(method, arguments));
    }

    private @Nullable Object invoke(CallableMethods.CallableMethod method, @Nullable Object[] arguments) {
        try {
            return CallableMethods.CallableMethod.invoke(method.method, actor.proxy(), arguments);
        } catch (InvocationTargetException thrown) { // by the proxy: for example a full mailbox
            throw new NotBegunException(String.valueOf(thrown.getTargetException()));
        } catch (IllegalAccessException impossible) {
            throw new AssertionError("methods are made accessible: " + method, impossible);
        }
    }

    private Promise<CallMessages.Result> answer(CallableMethods.CallableMethod method, @Nullable Object returned) {
        if (!(returned instanceof Promise<?> promise)) {
            return Promise.of(new CallMessages.Result(method.encodeResult(null)));
        }
        Deferred<CallMessages.Result> answer =
                method.isSuspending() ? LibraryAccess.deferred(null, new Coroutine(promise)) : Deferred.unbound();
        promise.toCompletableFuture() // at once, also if the actor's space has been closed
                .whenComplete((value, error) -> settle(answer, method, value, error));
        return answer;
    }

    /** Cancels the coroutine of a suspend function of Kotlin with its caller. */
    private record Coroutine(Promise<?> call) implements LibraryAccess.Work {
        @Override
        public void run() {
            call.cancel();
        }

        @Override
        public String toString() {
            return "the answer of " + call;
        }
    }

    private void settle(
            Deferred<CallMessages.Result> answer,
            CallableMethods.CallableMethod method,
            @Nullable Object value,
            @Nullable Throwable error) {
        if (error instanceof ActorStoppedException) {
            space.execute(
                    () -> { // the end of this actor is known after its requests have been rejected
                        if (!actor.hasEnded()) { // it is the error of another actor, or this one was restarted
                            answer.reject(error);
                        } // else the port was closed, which rejects the request
                    });
        } else if (error != null) {
            answer.reject(error);
        } else {
            try {
                answer.resolve(new CallMessages.Result(method.encodeResult(value)));
            } catch (RuntimeException unfit) {
                answer.reject(unfit);
            }
        }
    }
}
