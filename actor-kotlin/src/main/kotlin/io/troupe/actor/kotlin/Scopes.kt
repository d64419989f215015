@file:JvmName("Scopes")
@file:OptIn(InternalCoroutinesApi::class)

package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.LibraryAccess
import io.troupe.actor.internal.loop.Home
import io.troupe.actor.internal.loop.QueueEntry
import io.troupe.actor.internal.loop.TurnOwner
import java.time.Duration
import java.util.concurrent.CancellationException
import java.util.function.Supplier
import kotlin.coroutines.ContinuationInterceptor
import kotlin.coroutines.CoroutineContext
import kotlin.coroutines.resume
import kotlinx.coroutines.CancellableContinuation
import kotlinx.coroutines.CoroutineDispatcher
import kotlinx.coroutines.CoroutineExceptionHandler
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.Delay
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.DisposableHandle
import kotlinx.coroutines.InternalCoroutinesApi
import kotlinx.coroutines.SupervisorJob
import kotlinx.coroutines.cancel

/**
 * The scope of the actor whose turn it is, for coroutines that outlive a call.
 *
 * ```
 * override fun watch(sensor: Sensor) {
 *     actorScope().launch {
 *         while (true) {
 *             delay(1_000)
 *             level = sensor.read()
 *         }
 *     }
 * }
 * ```
 *
 * Its coroutines run on the space's thread, on behalf of the actor, and are cancelled when the actor stops or restarts.
 * An exception of one is a failure of the actor, as an exception in a one-way message; it does not cancel the others.
 *
 * @throws IllegalStateException outside the turn of an actor; a space has a [scope][ActorSpace.scope] too
 */
public fun actorScope(): CoroutineScope {
    val owner = Home.current()?.owner()
    check(owner != null && owner !== owner.home().itself() && !owner.isOutside) {
        "actorScope() belongs in the turn of an actor; outside of actors use ActorSpace.scope"
    }
    return owner.scope()
}

/**
 * The scope of a space, for coroutines that belong to no actor. They run on the space's thread and are cancelled when
 * the space is closed. An exception of one is reported to the space's error handler; it does not cancel the others.
 *
 * ```
 * val egg = test.space().scope.promise { timer.cook() }
 * ```
 */
public val ActorSpace.scope: CoroutineScope
    get() = owner().scope()

/**
 * Runs coroutines on the space's thread, by the space's clock: in a `TestSpace` the time of `delay` and `withTimeout`
 * is virtual.
 *
 * ```
 * return withContext(space.asDispatcher()) { picture + Thread.currentThread().name } // on the space's thread
 * ```
 *
 * Each resumption is an entry of the callback queue, never a call on the stack of the code that resumes. If the space
 * is closed, a coroutine that would be resumed is cancelled, and ends on [Dispatchers.IO].
 */
public fun ActorSpace.asDispatcher(): CoroutineDispatcher = owner().scope().dispatcher

private fun ActorSpace.owner(): TurnOwner = LibraryAccess.home(this).itself()

/**
 * Registers what a coroutine waits for. The end of the actor whose turn it is would drop a listener of that actor; but
 * the coroutine may be of another scope, or not cancellable now, and would never go on.
 */
internal inline fun onBehalfOfTheSpace(register: () -> Unit) {
    val home = Home.current()
    val owner = home?.owner()
    home?.beginForItself()
    try {
        register()
    } finally {
        if (owner != null) home.begin(owner)
    }
}

internal fun TurnOwner.scope(): OwnerScope = attachment(::OwnerScope) as OwnerScope

/** The coroutines of one incarnation of an actor, or of a space. */
internal class OwnerScope(owner: TurnOwner) : CoroutineScope, TurnOwner.Attachment {
    val dispatcher: OwnerDispatcher = OwnerDispatcher(owner)

    /** Without a job: each call of a suspend function is ended by its request. */
    val callContext: CoroutineContext =
        dispatcher + CoroutineExceptionHandler { _, error -> owner.home().enqueue(Failure(owner, error)) }
    private val job = SupervisorJob()
    override val coroutineContext: CoroutineContext = callContext + job

    override fun end() {
        job.cancel(CancellationException("${dispatcher.owner} has ended, and with it its coroutines"))
    }
}

/** True if a coroutine with this context belongs to the actor, or the space, whose turn it is. */
internal fun CoroutineContext.isOfThisTurn(): Boolean =
    (this[ContinuationInterceptor] as? OwnerDispatcher)?.owner === Home.current()?.owner()

/** An exception that no caller gets: a failure of its owner. */
internal class Failure(private val owner: TurnOwner, private val error: Throwable) : QueueEntry() {
    override fun serve(): QueueEntry? {
        owner.home().beginForItself()
        owner.failed("a coroutine", error)
        return null
    }
}

/** Resumes coroutines on behalf of an owner, and after its end on behalf of its home. */
internal class OwnerDispatcher(val owner: TurnOwner) : CoroutineDispatcher(), Delay {
    private val home: Home = owner.home()

    /**
     * Makes the current turn one of this owner, or of the home if the owner has ended; called at the bottom of the
     * stack of a turn. False on another thread, and if the home is ending.
     */
    fun beginTurn(): Boolean {
        if (!home.isCurrent || home.isEnding) {
            return false
        }
        home.begin(if (owner.isOver) home.itself() else owner)
        return true
    }

    override fun dispatch(context: CoroutineContext, block: Runnable) {
        if (home.isEnding && !home.isCurrent) {
            context.cancel(closed())
            Dispatchers.IO.dispatch(context, block)
        } else {
            home.enqueue(Resumption(context, block))
        }
    }

    private fun closed() = CancellationException("space $home is closed")

    override fun scheduleResumeAfterDelay(timeMillis: Long, continuation: CancellableContinuation<Unit>) {
        val carried = home.captureContext()
        val resume = Runnable { inContext(carried) { continuation.resume(Unit) } }
        val withdraw = home.schedule(nanos(timeMillis), resume) { continuation.cancel(closed()) }
        continuation.invokeOnCancellation { withdraw.run() }
    }

    override fun invokeOnTimeout(timeMillis: Long, block: Runnable, context: CoroutineContext): DisposableHandle {
        val withdraw = home.schedule(nanos(timeMillis), block, block)
        return DisposableHandle { withdraw.run() }
    }

    /** Runs an action in the context that was captured, if there was one: its end is also the end of the turn. */
    private inline fun inContext(carried: Supplier<Runnable>?, action: () -> Unit) {
        val end = carried?.get()
        try {
            action()
        } finally {
            end?.run()
        }
    }

    private fun nanos(timeMillis: Long) = Home.nanosOf(Duration.ofMillis(timeMillis))

    override fun toString(): String = "dispatcher of $owner"

    private inner class Resumption(private val context: CoroutineContext, private val block: Runnable) : QueueEntry() {
        private val carried = home.captureContext()

        override fun serve(): QueueEntry? {
            if (!beginTurn()) {
                home.beginForItself()
                context.cancel(closed())
            }
            inContext(carried) { block.run() }
            return null
        }
    }
}
