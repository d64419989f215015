@file:OptIn(InternalCoroutinesApi::class)

package io.troupe.actor.kotlin

import io.troupe.actor.Deferred
import io.troupe.actor.LibraryAccess
import io.troupe.actor.Promise
import io.troupe.actor.SuspendingRequest
import io.troupe.actor.internal.SuspendingCalls
import io.troupe.actor.internal.loop.Home
import io.troupe.actor.internal.loop.TurnOwner
import java.lang.invoke.MethodHandles
import java.lang.invoke.VarHandle
import java.util.concurrent.CancellationException
import java.util.concurrent.TimeoutException
import kotlin.coroutines.Continuation
import kotlin.coroutines.ContinuationInterceptor
import kotlin.coroutines.CoroutineContext
import kotlin.coroutines.EmptyCoroutineContext
import kotlin.coroutines.intrinsics.COROUTINE_SUSPENDED
import kotlinx.coroutines.AbstractCoroutine
import kotlinx.coroutines.InternalCoroutinesApi
import kotlinx.coroutines.TimeoutCancellationException

/** Runs the suspend functions of actors; for actor-core, which finds it as a service. */
internal class Suspending : SuspendingCalls() {
    private val awaiting: suspend (Promise<Any?>) -> Any? = ::awaitPending

    @Suppress("UNCHECKED_CAST") // a suspend function takes the continuation of its caller as its last argument
    override fun suspend(call: Promise<*>, continuation: Any): Any? {
        if (continuation is Taker) {
            continuation.taken = call
            return COROUTINE_SUSPENDED
        }
        return (awaiting as (Promise<Any?>, Continuation<Any?>) -> Any?)(
            call as Promise<Any?>,
            continuation as Continuation<Any?>,
        )
    }

    override fun newTaker(): PromiseTaker = Taker()

    override fun unitValue(): Any = Unit

    override fun start(request: SuspendingRequest<*>, implementation: Any, life: TurnOwner): Promise<*> {
        val call = SuspendedCall(life.scope())
        val outcome =
            try {
                val result = request.call(implementation, call)
                if (result === COROUTINE_SUSPENDED) {
                    return call.answerLater(request, life.home())
                }
                Result.success(result)
            } catch (error: Throwable) {
                Result.failure(error)
            }
        call.resumeWith(outcome)
        if (!call.isCompleted) { // it has launched others in its own scope, and waits for them
            return call.answerLater(request, life.home())
        }
        return Promise.of(outcome.getOrElse { throw unwrapped(it) })
    }
}

/** Stands for a caller that wants the promise of a call, not its result. */
internal class Taker : Continuation<Any?>, SuspendingCalls.PromiseTaker {
    var taken: Promise<*>? = null

    override val context: CoroutineContext
        get() = EmptyCoroutineContext

    override fun promise(): Promise<*> =
        checkNotNull(taken) { "the call returned no promise: it was not, or not at once, made on a proxy of an actor" }

    override fun resumeWith(result: Result<Any?>): Unit = error("a promise was taken, expected no result: $result")
}

/** An error as other actors see it: a time limit within an actor does not look like a cancellation of its caller. */
internal fun unwrapped(error: Throwable): Throwable =
    if (error is TimeoutCancellationException) {
        TimeoutException(error.message).apply { initCause(error) }
    } else {
        error
    }

/** The call of a suspend function, as a coroutine of its actor; ended by its request. */
private class SuspendedCall(scope: OwnerScope) :
    AbstractCoroutine<Any?>(scope.callContext, initParentJob = false, active = true), Runnable {
    @Volatile private var end: Any? = null // null, then the outcome, or the promise of it

    @Volatile private var abandoned = false // its request is settled already

    /** Cancels the call; any thread. */
    override fun run() {
        abandoned = true
        cancel(CancellationException("the caller has cancelled this call, or its actor has ended"))
    }

    /** The promise of the outcome, once the function has suspended. */
    fun answerLater(request: SuspendingRequest<*>, home: Home): Promise<*> {
        val answer = LibraryAccess.deferred<Any?>(home, null)
        request.answeredBy(this)
        if (!setEnd(answer)) {
            settle(answer, end as Result<*>)
        }
        return answer
    }

    override fun onCompleted(value: Any?) = ended(Result.success(value))

    override fun onCancelled(cause: Throwable, handled: Boolean) {
        if (abandoned && cause !is CancellationException) { // for example of a "finally"
            val home = (context[ContinuationInterceptor] as OwnerDispatcher).owner.home()
            home.enqueue(Failure(home.itself(), cause)) // no failure of the actor: it goes on after failed calls
        }
        ended(Result.failure(unwrapped(cause)))
    }

    private fun ended(outcome: Result<Any?>) {
        if (!setEnd(outcome)) {
            @Suppress("UNCHECKED_CAST") // set by answerLater
            settle(end as Deferred<Any?>, outcome)
        }
    }

    private fun setEnd(value: Any): Boolean = END.compareAndSet(this, null as Any?, value)

    private fun settle(answer: Deferred<Any?>, outcome: Result<*>) {
        outcome.fold({ answer.resolve(it) }, { answer.reject(it) })
    }

    private companion object {
        val END: VarHandle =
            MethodHandles.lookup().findVarHandle(SuspendedCall::class.java, "end", Any::class.java)
    }
}
