@file:JvmName("Flows")

package io.troupe.actor.kotlin

import io.troupe.actor.Callback
import io.troupe.actor.Topic
import java.util.concurrent.CancellationException
import java.util.concurrent.atomic.AtomicLong
import kotlinx.coroutines.channels.Channel
import kotlinx.coroutines.currentCoroutineContext
import kotlinx.coroutines.flow.Flow
import kotlinx.coroutines.flow.flow
import kotlinx.coroutines.flow.takeWhile

/**
 * What a flow does with values that arrive while its collector is busy. The sender never waits for a collector. The
 * limit applies twice: to the values in the callback queue, as the capacity of a [Callback.Stream], and to those that
 * wait for the collector.
 *
 * ```
 * val newest = FlowBuffer.latest()
 * scope.launch { scans.asFlow(newest).collect { avoid(it) } }
 * ```
 *
 * One object may serve several flows, on any threads; [dropped] then counts for all of them.
 */
public class FlowBuffer private constructor(
    private val name: String,
    private val capacity: Int,
    private val failsIfFull: Boolean,
) {
    private val count = AtomicLong()

    /** The number of values that were dropped because a collector, or the thread of its space, was too slow. */
    public val dropped: Long
        get() = count.get()

    /** What is kept in the callback queue; a flow that has to fail must see every value. */
    internal val queued: Int
        get() = if (failsIfFull || capacity == Channel.UNLIMITED) Int.MAX_VALUE else capacity

    internal fun <T> channel(): Channel<T> = Channel(capacity)

    internal fun noteDropped(number: Long) {
        count.addAndGet(number)
    }

    /** Adds a value; false if the buffer is full and the flow has to fail. On one thread at a time. */
    internal fun <T> add(channel: Channel<T>, value: T): Boolean {
        while (true) {
            val added = channel.trySend(value)
            when {
                added.isSuccess || added.isClosed -> return true
                failsIfFull -> return false
                channel.tryReceive().isSuccess -> count.incrementAndGet()
            }
        }
    }

    override fun toString(): String = name

    public companion object {
        /** Keeps every value, whatever memory that takes. */
        @JvmStatic
        public fun unlimited(): FlowBuffer = FlowBuffer("unlimited()", Channel.UNLIMITED, failsIfFull = false)

        /** Keeps the newest value only: for a sensor. */
        @JvmStatic
        public fun latest(): FlowBuffer = FlowBuffer("latest()", 1, failsIfFull = false)

        /**
         * Keeps the newest values.
         *
         * @throws IllegalArgumentException if [capacity] is less than 1
         */
        @JvmStatic
        public fun dropOldest(capacity: Int): FlowBuffer =
            FlowBuffer("dropOldest($capacity)", checked(capacity), failsIfFull = false)

        /**
         * Keeps values up to a number; one more ends the flow with a [FlowOverflowException].
         *
         * @throws IllegalArgumentException if [capacity] is less than 1
         */
        @JvmStatic
        public fun failing(capacity: Int): FlowBuffer =
            FlowBuffer("failing($capacity)", checked(capacity), failsIfFull = true)

        private fun checked(capacity: Int): Int {
            require(capacity > 0) { "capacity is $capacity, expected 1 or more" }
            return capacity
        }
    }
}

/** A collector was slower than its [FlowBuffer] allows; the values up to this one were delivered. */
public class FlowOverflowException internal constructor(message: String) : IllegalStateException(message)

/**
 * The values that an actor sends through a [Callback].
 *
 * ```
 * val numbers: Flow<Int> = callbacks { counter.count(3, it) }
 * ```
 *
 * Each collection calls [subscribe] once, with a new callback, in the coroutine of the collector, which may run on any
 * dispatcher. It ends when the actor calls `finish` or `fail`; when the collector has had enough, the actor sees
 * `isCancelled`. If the actor stops without a `finish`, no end arrives, as with every callback.
 *
 * The collector gets the exception of [subscribe], that of `fail`, an `ActorStoppedException` or a
 * `MailboxFullException` if the actor does not take the call, and a [FlowOverflowException] from its [buffer].
 */
public fun <T> callbacks(buffer: FlowBuffer = FlowBuffer.unlimited(), subscribe: (Callback<T>) -> Unit): Flow<T> =
    flow {
        val channel = buffer.channel<T>()
        lateinit var stream: Callback.Stream<T>
        var noted = 0L // on the thread of the callback

        fun noteDropped() {
            val dropped = stream.dropped()
            buffer.noteDropped(dropped - noted)
            noted = dropped
        }
        stream =
            Callback.Stream<T>(
                buffer.queued,
                { value ->
                    noteDropped()
                    if (!buffer.add(channel, value)) {
                        channel.close(FlowOverflowException("the collector is too slow for the buffer $buffer"))
                        stream.cancel()
                    }
                },
                { end -> channel.close(end) },
            )
        try {
            if (currentCoroutineContext().isOfThisTurn()) {
                subscribe(stream)
            } else {
                onBehalfOfTheSpace { subscribe(stream) }
            }
            for (value in channel) {
                emit(value)
            }
        } finally {
            stream.cancel()
            channel.cancel()
        }
    }

/**
 * The values of a topic: those that are published while the flow is collected, and first the last one if the topic
 * stores it. It ends with the topic, and throws the error of a topic that has failed. Any dispatcher may collect it.
 *
 * ```
 * colours.asFlow(FlowBuffer.latest()).collect { show(it) }
 * ```
 */
public fun <T : Any> Topic<T>.asFlow(buffer: FlowBuffer = FlowBuffer.unlimited()): Flow<T> =
    callbacks(buffer) { subscribe(it) }

/**
 * Sends the values of this flow through a callback, and then its end: `finish`, or `fail` with the flow's exception,
 * which is thrown here only if it is a cancellation. Returns at the next value if the reader cancels. The flow runs in
 * the coroutine that calls this.
 *
 * ```
 * override fun count(limit: Int, to: Callback<Int>) {
 *     actorScope().launch { (1..limit).asFlow().sendTo(to) }
 * }
 * ```
 */
public suspend fun <T> Flow<T>.sendTo(callback: Callback<in T>) {
    try {
        takeWhile { !callback.isCancelled }.collect { callback.next(it) }
    } catch (error: Throwable) {
        callback.fail(error)
        if (error is CancellationException) {
            throw error
        }
        return
    }
    callback.finish()
}

/**
 * Publishes the values of this flow to a topic. The end of the flow does not end the topic, which may have others; the
 * exception of the flow is thrown here. The flow runs in the coroutine that calls this, on any dispatcher.
 *
 * ```
 * scope.launch { prices.publishTo(scans) }
 * ```
 */
public suspend fun <T : Any> Flow<T>.publishTo(topic: Topic<in T>) {
    collect { topic.publish(it) }
}
