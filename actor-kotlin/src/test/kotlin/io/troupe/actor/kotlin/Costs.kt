package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.Deferred
import io.troupe.actor.Promise
import io.troupe.actor.SpaceSettings
import java.time.Duration
import kotlin.coroutines.CoroutineContext
import kotlin.system.measureNanoTime
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.DEBUG_PROPERTY_NAME
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.channels.Channel
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import kotlinx.coroutines.sync.Mutex
import kotlinx.coroutines.sync.withLock
import kotlinx.coroutines.withContext

/**
 * Measures one request and its reply, in nanoseconds, in several ways, one after the other within one thread. The ways
 * take turns in every round; printed are the best and the median round of each.
 *
 * Arguments: the number of rounds, and of requests in a round. Run without `-ea`, which switches on the debug mode of
 * kotlinx.
 */
fun main(args: Array<String>) {
    val rounds = args.getOrElse(0) { "20" }.toInt()
    val requests = args.getOrElse(1) { "200000" }.toInt()
    check(!object {}.javaClass.desiredAssertionStatus()) { "run without -ea: it switches on $DEBUG_PROPERTY_NAME" }
    ActorSpace.create(SpaceSettings.named("costs")).use { space ->
        val costs = Costs(space, requests)
        costs.measure(rounds).forEach { (way, nanos) ->
            val sorted = nanos.sorted()
            println("%-52s %7.0f %7.0f".format(way, sorted.first(), sorted[sorted.size / 2]))
        }
    }
}

private class Costs(private val space: ActorSpace, private val requests: Int) {
    interface Adder {
        fun promised(number: Int): Promise<Int>

        suspend fun suspending(number: Int): Int

        suspend fun passedOn(number: Int): Int
    }

    private class AdderActor(private val next: Adder?) : Adder {
        override fun promised(number: Int): Promise<Int> = Promise.of(number + 1)

        override suspend fun suspending(number: Int): Int = number + 1

        override suspend fun passedOn(number: Int): Int = next!!.suspending(number) + 1
    }

    private val last = space.spawn<Adder> { AdderActor(null) }
    private val adder = space.spawn<Adder> { AdderActor(last) }

    private val ways: Map<String, () -> Unit> = linkedMapOf(
        "then" to { onSpace { chain(0) } },
        "coAwait on a Promise function" to { inCoroutine { adder.promised(it).coAwait() } },
        "suspend function" to { inCoroutine { adder.suspending(it) } },
        "suspend function that asks another actor (2 requests)" to { inCoroutine { adder.passedOn(it) } },
        "sequential, await" to {
            space.sequential { repeat(requests / 20) { adder.promised(it).await() } }.get(LIMIT)
        },
        "kotlinx channel and CompletableDeferred, same space" to { channels(space.asDispatcher()) },
        "kotlinx channel and CompletableDeferred, Default" to { channels(Dispatchers.Default.limitedParallelism(1)) },
        "kotlinx Mutex.withLock, no reply to wait for" to {
            val mutex = Mutex()
            var sum = 0
            inCoroutine { mutex.withLock { sum += it } }
        },
    )

    fun measure(rounds: Int): Map<String, List<Double>> {
        val found = ways.keys.associateWith { mutableListOf<Double>() }
        for (round in -rounds / 2 until rounds) {
            for ((way, run) in ways) {
                val share = if (way.startsWith("sequential")) requests / 20 else requests
                val nanos = measureNanoTime(run) / share.toDouble()
                if (round >= 0) {
                    found.getValue(way) += nanos
                }
            }
        }
        return found
    }

    private fun onSpace(start: () -> Promise<Int>) {
        val end = space.deferred<Int>()
        space.execute { end.resolveFrom(start()) }
        end.get(LIMIT)
    }

    private fun chain(begin: Int): Promise<Int> {
        val end = space.deferred<Int>()
        fun next(number: Int) {
            adder.promised(number).then { it: Int -> if (it < requests) next(it) else end.resolve(it) }
        }
        next(begin)
        return end
    }

    private fun inCoroutine(ask: suspend (Int) -> Unit) {
        space.scope.promise { repeat(requests) { ask(it) } }.get(LIMIT)
    }

    private class Ask(val number: Int, val reply: CompletableDeferred<Int>)

    private fun channels(context: CoroutineContext) = runBlocking {
        withContext(context) {
            val mailbox = Channel<Ask>(Channel.UNLIMITED)
            launch { for (ask in mailbox) ask.reply.complete(ask.number + 1) }
            repeat(requests) {
                val ask = Ask(it, CompletableDeferred())
                mailbox.send(ask)
                ask.reply.await()
            }
            mailbox.close()
        }
        Unit
    }

    private companion object {
        val LIMIT: Duration = Duration.ofMinutes(2)
    }
}
