package io.troupe.actor;

import io.troupe.actor.internal.Recipient;
import io.troupe.actor.internal.SuspendingCalls;
import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import org.jspecify.annotations.Nullable;

/**
 * The call of a suspend function of Kotlin. For generated code: each suspend function of an actor type has a subclass
 * whose fields are the arguments, without the continuation of the caller. Public only for these.
 *
 * @hidden
 */
@SuppressWarnings("exports") // of what it is made is for this library
public abstract class SuspendingRequest<T extends @Nullable Object> extends Request<T> {
    private static final VarHandle COROUTINE;

    static {
        try {
            COROUTINE = MethodHandles.lookup().findVarHandle(SuspendingRequest.class, "coroutine", Runnable.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    private static final Runnable CANCELLED = () -> {};

    private @Nullable Runnable coroutine;

    protected SuspendingRequest(Recipient receiver) {
        super(receiver);
    }

    /**
     * Calls the function.
     *
     * @param continuation a {@code kotlin.coroutines.Continuation}
     * @return the result, or the mark of a function that has suspended
     */
    public abstract @Nullable Object call(Object implementation, Object continuation) throws Throwable;

    @Override
    @SuppressWarnings("unchecked") // the function's result is of type T
    protected final @Nullable Promise<? extends T> invoke(Object implementation) throws Throwable {
        return (Promise<? extends T>)
                SuspendingCalls.known().start(this, implementation, receiver().life());
    }

    /**
     * Notes the coroutine that answers this request once the function has suspended; it is cancelled when the caller
     * cancels, and when the actor ends. On the space's thread.
     *
     * @param cancel cancels the coroutine; called by any thread
     */
    public final void answeredBy(Runnable cancel) {
        if (!COROUTINE.compareAndSet(this, null, cancel)) {
            cancel.run();
        }
    }

    @Override
    @SuppressWarnings("unchecked") // the function's result is of type T
    public final @Nullable Promise<? extends T> sendTo(Object proxy) throws Throwable {
        var taker = SuspendingCalls.known().newTaker();
        call(proxy, taker);
        return (Promise<? extends T>) taker.promise();
    }

    @Override
    final void cancelled() {
        cancelCoroutine();
        super.cancelled();
    }

    /** Cancels the coroutine that answers this request, now or when it is noted. */
    public final void cancelCoroutine() {
        var running = (Runnable) COROUTINE.getAndSet(this, CANCELLED);
        if (running != null) {
            running.run();
        }
    }
}
