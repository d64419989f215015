package io.troupe.actor.kotlin

import io.troupe.actor.Actor
import io.troupe.actor.ActorSpace
import io.troupe.actor.Deferred
import io.troupe.actor.Promise
import io.troupe.actor.SpaceSettings
import java.io.IOException
import java.util.concurrent.CancellationException
import java.util.concurrent.atomic.AtomicReference
import kotlin.random.Random
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.CoroutineStart
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.Job
import kotlinx.coroutines.NonCancellable
import kotlinx.coroutines.TimeoutCancellationException
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.awaitCancellation
import kotlinx.coroutines.delay
import kotlinx.coroutines.joinAll
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import kotlinx.coroutines.withContext
import kotlinx.coroutines.withTimeout
import kotlinx.coroutines.yield
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Dispatchers and scopes of spaces and actors, and promises in coroutines. */
class ScopesTest : InTestSpace() {
    @Test
    fun delayAndTimeLimit_areVirtualInATestSpace() {
        CoroutineScope(test.space().asDispatcher()).launch {
            delay(1_000)
            log += "delayed"
        }
        val limited = run {
            try {
                withTimeout(500) { awaitCancellation() }
            } catch (e: TimeoutCancellationException) {
                log += "limit"
            }
        }
        advance(499)
        assertThat(log).isEmpty()
        advance(1)
        assertThat(log).containsExactly("limit")
        assertThat(limited.isDone).isTrue()
        advance(499)
        assertThat(log).hasSize(1)
        advance(1)
        assertThat(log).containsExactly("limit", "delayed")
    }

    @Test
    fun cancelledDelay_withdrawsItsTimer() {
        val job = test.space().scope.launch { delay(1_000) }
        val limited = test.space().scope.launch { withTimeout(1_000) { delay(10) } }
        test.runQueued()
        assertThat(test.space().metrics().timers()).isEqualTo(3)
        advance(10)
        assertThat(limited.isCompleted).isTrue()
        assertThat(test.space().metrics().timers()).isEqualTo(1)
        job.cancel()
        test.runQueued()
        assertThat(test.space().metrics().timers()).isZero()
    }

    @Test
    fun resumption_isAnEntryOfTheCallbackQueue_neverACallOnTheStackOfTheResumer() {
        val gate = CompletableDeferred<Unit>()
        test.space().scope.launch {
            gate.await()
            log += "resumed"
        }
        test.runQueued()
        test.run {
            test.space().execute { log += "message" }
            gate.complete(Unit)
            log += "completed"
        }
        assertThat(log).containsExactly("completed", "resumed", "message")
    }

    interface Lamp {
        fun blink()

        fun isOn(): Promise<Boolean>

        fun openFor(gate: CompletableDeferred<Unit>)
    }

    private inner class LampActor : Lamp {
        private var on = false

        override fun blink() {
            actorScope().launch {
                while (true) {
                    delay(100)
                    on = !on
                    log += "blink"
                }
            }
        }

        override fun isOn(): Promise<Boolean> = Promise.of(on)

        override fun openFor(gate: CompletableDeferred<Unit>) {
            actorScope().launch {
                gate.await()
                // still on behalf of the actor: the scope that is asked for is its own
                log += "same scope " + (actorScope() === this@LampActor.scope)
            }
            scope = actorScope()
        }

        private var scope: CoroutineScope? = null
    }

    @Test
    fun actorScope_canBeUsedInTheConstructor_andEndsWithTheActor() {
        class Clock : Counter {
            private var ticks = 0

            init {
                actorScope().launch {
                    while (true) {
                        delay(100)
                        ticks++
                        log += "tick"
                    }
                }
            }

            override suspend fun add(number: Int) = ticks + number
        }
        val clock = test.spawn<Counter> { Clock() }
        advance(100)
        assertThat(value { clock.add(1) }).isEqualTo(2)
        test.space().stop(clock)
        advance(1_000)
        assertThat(log).containsExactly("tick")
    }

    @Test
    fun actorScope_endsWithItsActor() {
        val lamp = test.spawn<Lamp> { LampActor() }
        lamp.blink()
        advance(100)
        assertThat(test.get(lamp.isOn())).isTrue()
        test.space().stop(lamp)
        advance(1_000)
        assertThat(log).containsExactly("blink")
    }

    @Test
    fun coroutineOfAnActor_goesOnOnBehalfOfTheActor_whateverResumesIt() {
        val lamp = test.spawn<Lamp> { LampActor() }
        val gate = CompletableDeferred<Unit>()
        lamp.openFor(gate)
        test.runQueued()
        gate.complete(Unit) // by a thread outside the space
        test.runQueued()
        assertThat(log).containsExactly("same scope true")
    }

    @Test
    fun actorScope_outsideOfTheTurnOfAnActor_saysWhatToDo() {
        assertThatThrownBy { actorScope() }
            .isInstanceOf(IllegalStateException::class.java)
            .hasMessageContaining("ActorSpace.scope")
        test.run { assertThatThrownBy { promise { } }.isInstanceOf(IllegalStateException::class.java) }
    }

    @Test
    fun failureInTheScopeOfASpace_isReported_andTheOthersGoOn() {
        val other = test.space().scope.launch { awaitCancellation() }
        test.space().scope.launch { throw IOException("lost") }
        test.runQueued()
        assertThat(takeProblems()).hasSize(1).first().asString().endsWith(": lost")
        assertThat(other.isActive).isTrue()
    }

    @Test
    fun coAwait_returnsTheValue_orThrowsTheErrorUnwrapped() {
        assertThat(value { Promise.of("at once").coAwait() }).isEqualTo("at once")
        assertThat(value { Promise.of<String?>(null).coAwait() }).isNull()
        assertThat(error { Promise.failed<Int>(IOException("bad")).coAwait() })
            .isExactlyInstanceOf(IOException::class.java)
            .hasMessage("bad")
        val later = test.space().deferred<Int>()
        val sum = run { later.coAwait() + 1 }
        later.resolve(1)
        assertThat(test.get(sum)).isEqualTo(2)
        val rejected = test.space().deferred<Int>()
        val end = run {
            try {
                rejected.coAwait()
            } catch (e: IOException) {
                e.message
            }
        }
        rejected.reject(IOException("late"))
        assertThat(test.get(end)).isEqualTo("late")
    }

    @Test
    fun await_inACoroutine_namesCoAwait() {
        val promise = test.space().deferred<Int>()
        assertThat(error { promise.await() }).hasMessageContaining("coAwait()")
        runBlocking {
            assertThatThrownBy { promise.await() }.hasMessageContaining("in a Kotlin coroutine: coAwait()")
        }
    }

    @Test
    fun closedSpace_cancelsACoroutine_andEndsItElsewhere() {
        val space = ActorSpace.create(SpaceSettings.named("short"))
        val ended = AtomicReference<String>()
        val gate = CompletableDeferred<Unit>()
        val job = CoroutineScope(space.asDispatcher()).launch {
            try {
                withContext(NonCancellable) { gate.await() }
                yield()
                ended.set("not cancelled")
            } catch (e: CancellationException) {
                ended.set(e.message)
                throw e
            }
        }
        space.close()
        gate.complete(Unit)
        runBlocking { job.join() }
        assertThat(ended.get()).contains("space short is closed")
        val late = CoroutineScope(space.asDispatcher()).launch { ended.set("ran") }
        runBlocking { late.join() }
        assertThat(late.isCancelled).isTrue()
    }

    @Test
    fun realThreads_coroutinesOfOtherDispatchersAskActors() {
        ActorSpace.create(SpaceSettings.named("real")).use { space ->
            class Tally : Actor(), Counter {
                private var value = 0

                override suspend fun add(number: Int): Int {
                    delay(1)
                    value += number
                    return value
                }
            }
            val counter = space.spawn<Counter> { Tally() }
            runBlocking(Dispatchers.Default) {
                (1..4).map { async { repeat(25) { counter.add(1) } } }.awaitAll()
                assertThat(counter.add(0)).isEqualTo(100)
                val threads = (1..2).map {
                    async { withContext(space.asDispatcher()) { Thread.currentThread().also { delay(1) } } }
                }
                assertThat(threads.awaitAll().distinct()).hasSize(1)
            }
        }
    }

    interface Counter {
        suspend fun add(number: Int): Int
    }

    /** Calls of other threads are cancelled at any moment of their way: the actor goes on, and nothing is left. */
    @Test
    fun callsThatAreCancelledAtAnyMoment_endOnce_andLeaveNothing() {
        val seed = System.nanoTime()
        val random = Random(seed)
        ActorSpace.create(SpaceSettings.named("races")).use { space ->
            val next = space.spawn<Counter> { Adder(null) }
            val counter = space.spawn<Counter> { Adder(next) }
            val outcomes = mutableMapOf<String, Int>()
            runBlocking(Dispatchers.Default) {
                repeat(3_000) {
                    val call = async(start = CoroutineStart.UNDISPATCHED) { counter.add(it) }
                    repeat(random.nextInt(300)) { Thread.onSpinWait() }
                    call.cancel()
                    call.join()
                    outcomes.merge(if (call.isCancelled) "cancelled" else "answered", 1, Int::plus)
                }
                assertThat(counter.add(1)).`as`("seed $seed, $outcomes").isEqualTo(3)
            }
            runBlocking(space.asDispatcher()) { yield() }
            assertThat(space.metrics().timers()).isZero()
            assertThat(space.metrics().errors()).isZero()
        }
    }

    private class Adder(private val next: Counter?) : Counter {
        override suspend fun add(number: Int): Int {
            yield()
            return 1 + (next?.add(number) ?: number)
        }
    }

    @Test
    fun manyCalls_leaveNoCoroutine() {
        ActorSpace.create(SpaceSettings.named("many")).use { space ->
            val counter = space.spawn<Counter> {
                object : Counter {
                    private var value = 0

                    override suspend fun add(number: Int): Int {
                        if (number > 0) yield()
                        value++
                        return value
                    }
                }
            }
            val scope = space.scope
            val calls = CoroutineScope(space.asDispatcher() + Job())
            runBlocking {
                (0 until 100).map { part -> calls.launch { repeat(1_000) { counter.add(part % 2) } } }.joinAll()
                assertThat(counter.add(0)).isEqualTo(100_001)
            }
            assertThat(calls.coroutineContext[Job]!!.children.count()).isZero()
            assertThat(scope.coroutineContext[Job]!!.children.count()).isZero()
            val metrics = space.metrics()
            assertThat(metrics.timers()).isZero()
            assertThat(metrics.errors()).isZero()
        }
    }
}
