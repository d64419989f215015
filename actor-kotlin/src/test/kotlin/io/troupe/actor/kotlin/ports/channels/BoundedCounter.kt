package io.troupe.actor.kotlin.ports.channels

import io.troupe.actor.kotlin.ports.BoundedCounter
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.ObsoleteCoroutinesApi
import kotlinx.coroutines.channels.actor

private sealed interface CounterMessage

private class Increment(val done: CompletableDeferred<Boolean>) : CounterMessage

private class Value(val value: CompletableDeferred<Int>) : CounterMessage

@OptIn(ObsoleteCoroutinesApi::class)
fun boundedCounter(scope: CoroutineScope, limit: Int): BoundedCounter {
    val mailbox = scope.actor<CounterMessage> {
        var value = 0
        for (message in channel) {
            when (message) {
                is Increment -> message.done.complete((value < limit).also { if (it) value++ })
                is Value -> message.value.complete(value)
            }
        }
    }
    return object : BoundedCounter {
        override suspend fun increment(): Boolean {
            val done = CompletableDeferred<Boolean>()
            mailbox.send(Increment(done))
            return done.await()
        }

        override suspend fun value(): Int {
            val value = CompletableDeferred<Int>()
            mailbox.send(Value(value))
            return value.await()
        }
    }
}
