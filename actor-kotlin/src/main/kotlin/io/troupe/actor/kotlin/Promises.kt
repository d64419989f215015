@file:JvmName("Promises")
@file:OptIn(InternalCoroutinesApi::class, ExperimentalCoroutinesApi::class)

package io.troupe.actor.kotlin

import io.troupe.actor.Deferred
import io.troupe.actor.LibraryAccess
import io.troupe.actor.Promise
import io.troupe.actor.internal.loop.Home
import java.util.concurrent.CancellationException
import java.util.function.BiFunction
import kotlin.coroutines.Continuation
import kotlin.coroutines.ContinuationInterceptor
import kotlin.coroutines.CoroutineContext
import kotlin.coroutines.EmptyCoroutineContext
import kotlin.coroutines.resume
import kotlin.coroutines.resumeWithException
import kotlinx.coroutines.AbstractCoroutine
import kotlinx.coroutines.CancellableContinuation
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.CoroutineStart
import kotlinx.coroutines.ExperimentalCoroutinesApi
import kotlinx.coroutines.InternalCoroutinesApi
import kotlinx.coroutines.handleCoroutineException
import kotlinx.coroutines.newCoroutineContext
import kotlinx.coroutines.suspendCancellableCoroutine

/**
 * Suspends until the promise is settled; returns its value or throws its error, unwrapped. For coroutines of any
 * dispatcher and scope.
 *
 * ```
 * suspend fun total(shop: Shop): Int = shop.price("lamp").coAwait() + shop.price("bulb").coAwait()
 * ```
 *
 * If the coroutine is cancelled, it goes on at once with a `CancellationException` and the promise is cancelled: a
 * request that waits in a mailbox is then dropped. If the promise is cancelled, this throws a `CancellationException`.
 * A promise that is fulfilled already does not suspend.
 *
 * (A member always wins over an extension, so this cannot be called `await`: that is the one of
 * `ActorSpace.sequential`.)
 */
public suspend fun <T> Promise<T>.coAwait(): T {
    if (!isDone) {
        return awaitPending(this)
    }
    val error = error()
    if (error != null) {
        handle<Unit> { _, _ -> } // else the space would report a rejection without a listener
        throw error
    }
    @Suppress("UNCHECKED_CAST") // null is a value only where T allows it
    return getNow() as T
}

internal suspend fun <T> awaitPending(promise: Promise<T>): T = suspendCancellableCoroutine { continuation ->
    val awaiting = Awaiting(promise, continuation)
    onBehalfOfTheSpace { promise.handle(awaiting) }
    continuation.invokeOnCancellation(awaiting)
}

/** Resumes a coroutine when a promise is settled, and cancels the promise when the coroutine is cancelled. */
private class Awaiting<T>(private val promise: Promise<T>, private val continuation: CancellableContinuation<T>) :
    BiFunction<T?, Throwable?, Unit>, (Throwable?) -> Unit {

    override fun apply(value: T?, error: Throwable?) {
        val dispatcher = continuation.context[ContinuationInterceptor]
        if (dispatcher is OwnerDispatcher && dispatcher.beginTurn()) { // this listener's turn becomes the coroutine's
            with(continuation) {
                if (error == null) {
                    @Suppress("UNCHECKED_CAST") // null is a value only where T allows it
                    dispatcher.resumeUndispatched(value as T)
                } else {
                    dispatcher.resumeUndispatchedWithException(error)
                }
            }
        } else if (error == null) {
            @Suppress("UNCHECKED_CAST") // as above
            continuation.resume(value as T)
        } else {
            continuation.resumeWithException(error)
        }
    }

    override fun invoke(cause: Throwable?) {
        promise.cancel()
    }
}

/**
 * Calls a suspend function of an actor from Java: `Promises.ask(c -> greeter.greet("Ada", c))`. The call sends a
 * message at once and returns its promise; cancelling it cancels the call. Any thread. In Kotlin, call the function in
 * a coroutine.
 *
 * @param call calls one suspend function of a proxy with the continuation it is given, and nothing else
 * @throws IllegalStateException if the function is not that of a proxy
 */
public fun <T> ask(call: SuspendingCall<T>): Promise<T> {
    val taker = Taker()
    call.call(taker)
    @Suppress("UNCHECKED_CAST") // the function's result is of type T
    return taker.promise() as Promise<T>
}

/** The call of one suspend function, written in Java. */
public fun interface SuspendingCall<T> {
    /** Returns what the function returns. */
    public fun call(continuation: Continuation<T>): Any?
}

/**
 * Runs a coroutine of the actor whose turn it is, as the answer of a function that returns a [Promise].
 *
 * ```
 * override fun total(item: String, count: Int): Promise<Int> = promise { shop.price(item).coAwait() * count }
 * ```
 *
 * It begins at once, in the actor's turn, and goes on in further turns of the actor. Cancelling the promise cancels the
 * coroutine; an exception rejects the promise, and is no failure of the actor.
 *
 * @throws IllegalStateException outside the turn of an actor; there, call it on a scope
 */
public fun <T> promise(block: suspend CoroutineScope.() -> T): Promise<T> =
    actorScope().promise(start = CoroutineStart.UNDISPATCHED, block = block)

/**
 * Runs a coroutine of this scope and returns the promise of its result. Any thread. Cancelling the promise cancels the
 * coroutine; a failure of the coroutine rejects the promise, and cancels the scope's job unless that is a supervisor.
 *
 * ```
 * val high = scope.promise { prices.filter { it > 5 }.take(2).toList() }
 * ```
 */
public fun <T> CoroutineScope.promise(
    context: CoroutineContext = EmptyCoroutineContext,
    start: CoroutineStart = CoroutineStart.DEFAULT,
    block: suspend CoroutineScope.() -> T,
): Promise<T> {
    val coroutine = PromiseCoroutine<T>(newCoroutineContext(context))
    coroutine.start(start, coroutine, block)
    return coroutine.promise
}

private class PromiseCoroutine<T>(context: CoroutineContext) :
    AbstractCoroutine<T>(context, initParentJob = true, active = true) {
    val promise: Deferred<T>

    init {
        val dispatcher = context[ContinuationInterceptor]
        val home = if (dispatcher is OwnerDispatcher) dispatcher.owner.home() else Home.current()
        promise = LibraryAccess.deferred(home) { cancel(CancellationException("its promise was cancelled")) }
    }

    override fun onCompleted(value: T) {
        promise.resolve(value)
    }

    override fun onCancelled(cause: Throwable, handled: Boolean) {
        if (!promise.reject(unwrapped(cause)) && !handled) {
            handleCoroutineException(context, cause)
        }
    }
}
