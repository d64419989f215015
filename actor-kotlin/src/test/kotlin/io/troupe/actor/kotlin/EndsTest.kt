package io.troupe.actor.kotlin

import io.troupe.actor.Actor
import io.troupe.actor.ActorSettings
import io.troupe.actor.ActorSettings.Overflow
import io.troupe.actor.ActorStoppedException
import io.troupe.actor.Deferred
import io.troupe.actor.MailboxFullException
import io.troupe.actor.Promise
import io.troupe.actor.Supervision
import io.troupe.actor.Topic
import java.io.IOException
import java.time.Duration
import java.util.concurrent.CancellationException
import java.util.concurrent.TimeoutException
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.CoroutineStart
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.ExperimentalCoroutinesApi
import kotlinx.coroutines.Job
import kotlinx.coroutines.NonCancellable
import kotlinx.coroutines.TimeoutCancellationException
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitCancellation
import kotlinx.coroutines.coroutineScope
import kotlinx.coroutines.currentCoroutineContext
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.first
import kotlinx.coroutines.job
import kotlinx.coroutines.launch
import kotlinx.coroutines.withContext
import kotlinx.coroutines.withTimeout
import kotlinx.coroutines.yield
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** Errors, cancellation in both directions, and the end of actors. */
class EndsTest : InTestSpace() {
    interface Worker {
        suspend fun fail(late: Boolean): String

        suspend fun work(millis: Long): String

        suspend fun limited(): String

        suspend fun children(fail: Boolean): String

        suspend fun cleanUp(): String

        suspend fun forgetful(): String

        fun background(fail: Boolean)

        fun fault()

        fun total(): Promise<Int>
    }

    private val workers = mutableListOf<WorkerActor>()

    private inner class WorkerActor(private val other: Worker? = null) : Worker {
        val number = workers.size
        var job: Job? = null

        init {
            workers += this
        }

        override suspend fun fail(late: Boolean): String {
            if (late) yield()
            throw IOException("no paper")
        }

        override suspend fun work(millis: Long): String {
            job = currentCoroutineContext().job
            try {
                delay(millis)
                log += "worked"
                return "done"
            } catch (stop: CancellationException) {
                log += "stopped after " + test.clock().nanos() / 1_000_000
                throw stop
            }
        }

        override suspend fun limited(): String = withTimeout(10) { awaitCancellation() }

        override suspend fun children(fail: Boolean): String {
            coroutineScope {
                launch { log += work(20) }
                launch {
                    delay(10)
                    if (fail) throw IOException("a child failed")
                }
            }
            return "all done"
        }

        override suspend fun cleanUp(): String =
            try {
                awaitCancellation()
            } finally {
                withContext(NonCancellable) {
                    delay(5)
                    log += "asked " + (other!!.work(5))
                }
            }

        /** Starts a coroutine in the scope of this call, which ends before it. */
        override suspend fun forgetful(): String {
            val call = CoroutineScope(currentCoroutineContext())
            call.launch {
                delay(10)
                log += "child"
            }
            return "early"
        }

        override fun background(fail: Boolean) {
            actorScope().launch {
                try {
                    delay(10)
                    if (fail) throw IOException("background failed")
                    awaitCancellation()
                } finally {
                    log += "background of $number ended"
                }
            }
        }

        override fun fault() = throw IllegalStateException("broken")

        override fun total(): Promise<Int> = promise {
            delay(10)
            throw IOException("no total")
        }
    }

    private fun worker(settings: ActorSettings = ActorSettings.defaults()): Worker =
        test.spawn<Worker>(settings) { WorkerActor() }

    @Test
    fun errors_reachTheCallerUnwrapped_withoutAReport() {
        val worker = worker()
        for (late in listOf(false, true)) {
            assertThat(error { worker.fail(late) }).isExactlyInstanceOf(IOException::class.java).hasMessage("no paper")
        }
        val result = value {
            try {
                worker.fail(true)
            } catch (e: IOException) {
                "caught ${e.message}"
            }
        }
        assertThat(result).isEqualTo("caught no paper")
        val total = worker.total()
        advance(10)
        assertThat(test.error(total)).isExactlyInstanceOf(IOException::class.java)
    }

    @Test
    fun timeLimitWithinAnActor_isATimeoutForItsCaller_notItsCancellation() {
        val worker = worker()
        val result = run { worker.limited() }
        advance(10)
        assertThat(test.error(result))
            .isExactlyInstanceOf(TimeoutException::class.java)
            .hasRootCauseInstanceOf(TimeoutCancellationException::class.java)
    }

    @Test
    fun cancelledCaller_cancelsTheActorsCoroutine_andTheActorGoesOn() {
        val worker = worker()
        val result = run {
            try {
                withTimeout(200) { worker.work(1_000) }
            } catch (e: TimeoutCancellationException) {
                "too late"
            }
        }
        advance(199)
        assertThat(log).isEmpty()
        advance(1)
        assertThat(log).containsExactly("stopped after 200")
        assertThat(test.get(result)).isEqualTo("too late")
        assertThat(workers.single().job!!.isCancelled).isTrue()
        val next = run { worker.work(5) }
        advance(5)
        assertThat(next.now).isEqualTo("done")
    }

    @Test
    fun cancelledCaller_takesBackACallThatWaits() {
        val worker = worker()
        lateinit var job: Job
        job = test.space().scope.launch {
            test.space().execute { job.cancel() } // queued before the call
            worker.work(10)
        }
        advance(100)
        assertThat(log).isEmpty()
        assertThat(job.isCancelled).isTrue()
    }

    @Test
    fun failureOfAnActor_doesNotCancelTheScopeOfItsCaller() {
        val worker = worker()
        val both = run {
            coroutineScope {
                val other = launch { worker.work(10) }
                try {
                    worker.fail(true)
                } catch (expected: IOException) {
                    log += "caught"
                }
                other.join()
                "both"
            }
        }
        advance(10)
        assertThat(test.get(both)).isEqualTo("both")
        assertThat(log).containsExactly("caught", "worked")
    }

    @Test
    fun childrenOfACall_areAwaited_andEndWithIt() {
        val worker = worker()
        val good = run { worker.children(false) }
        advance(20)
        assertThat(good.now).isEqualTo("all done")
        assertThat(log).containsExactly("worked", "done")
        log.clear()
        val bad = run { worker.children(true) }
        advance(10)
        assertThat(test.error(bad)).hasMessage("a child failed")
        assertThat(log).containsExactly("stopped after 30")
        val forgetful = run { worker.forgetful() }
        assertThat(forgetful.isDone).isFalse()
        advance(10)
        assertThat(forgetful.now).isEqualTo("early")
        assertThat(log).endsWith("child")
    }

    @Test
    fun stoppedActor_rejectsItsCalls_andCancelsItsCoroutines() {
        val worker = worker()
        worker.background(false)
        val working = run { worker.work(100) }
        test.space().stop(worker)
        test.runQueued()
        assertThat(test.error(working))
            .isInstanceOf(ActorStoppedException::class.java)
            .hasMessageContaining("work(long) of Worker#1 was begun and not answered: the actor Worker#1 has stopped")
        assertThat(log).containsExactlyInAnyOrder("stopped after 0", "background of 0 ended")
        assertThat(error { worker.work(1) }).isInstanceOf(ActorStoppedException::class.java)
    }

    @Test
    fun restartedActor_hasAFreshScope() {
        val worker = worker(ActorSettings.defaults().withSupervision(Supervision.restart(3, Duration.ofMinutes(1))))
        worker.background(false)
        val working = run { worker.work(100) }
        worker.fault()
        worker.background(false)
        test.runQueued()
        assertThat(test.error(working)).isInstanceOf(ActorStoppedException::class.java)
        assertThat(log).containsExactlyInAnyOrder("stopped after 0", "background of 0 ended")
        assertThat(takeProblems()).containsExactly("Worker.fault() of Worker#1: broken")
        val next = run { worker.work(5) }
        advance(5)
        assertThat(next.now).isEqualTo("done")
    }

    @Test
    fun failureOfACoroutineOfTheActor_isAFailureOfTheActor() {
        val worker = worker(ActorSettings.defaults().withSupervision(Supervision.restart(3, Duration.ofMinutes(1))))
        worker.background(false)
        worker.background(true)
        advance(10)
        assertThat(takeProblems()).containsExactly("a coroutine of Worker#1: background failed")
        assertThat(log).containsExactly("background of 0 ended", "background of 0 ended")
        assertThat(value { worker.work(0) }).isEqualTo("done")
        assertThat(workers).hasSize(2)
    }

    @Test
    fun cleaningUpAfterTheEnd_mayAskOtherActors() {
        val other = worker()
        val worker = test.spawn<Worker> { WorkerActor(other) }
        val result = run { worker.cleanUp() }
        test.space().stop(worker)
        test.runQueued()
        assertThat(test.error(result)).isInstanceOf(ActorStoppedException::class.java)
        advance(10)
        assertThat(log).containsExactly("worked", "asked done")
    }

    interface Holder {
        suspend fun holdOn(): Int

        fun begin(foreign: CoroutineScope, gate: Promise<Int>, numbers: Topic<Int>)
    }

    private inner class HolderActor(private val gate: Promise<Int>, private val error: Exception? = null) : Holder {
        override suspend fun holdOn(): Int =
            try {
                withContext(NonCancellable) { gate.coAwait() }
            } finally {
                log += "released"
                if (error != null) throw error
            }

        override fun begin(foreign: CoroutineScope, gate: Promise<Int>, numbers: Topic<Int>) {
            foreign.launch(start = CoroutineStart.UNDISPATCHED) { log += "awaited ${gate.coAwait()}" }
            foreign.launch(start = CoroutineStart.UNDISPATCHED) { log += "collected ${numbers.asFlow().first()}" }
        }
    }

    @Test
    fun coroutineThatCannotBeCancelledNow_goesOnAfterTheEndOfItsActor() {
        val gate = test.space().deferred<Int>()
        val holder = test.spawn<Holder> { HolderActor(gate) }
        val result = run { holder.holdOn() }
        test.space().stop(holder)
        test.runQueued()
        assertThat(test.error(result)).isInstanceOf(ActorStoppedException::class.java)
        assertThat(log).isEmpty()
        gate.resolve(1)
        test.runQueued()
        assertThat(log).containsExactly("released")
    }

    @Test
    fun foreignCoroutines_begunUndispatchedInTheTurnOfAnActor_goOnAfterItsEnd() {
        for (dispatcher in listOf(Dispatchers.Unconfined, test.space().asDispatcher())) {
            log.clear()
            val gate = test.space().deferred<Int>()
            val numbers = Topic.of<Int>(test.space(), "numbers")
            val holder = test.spawn<Holder> { HolderActor(gate) }
            holder.begin(CoroutineScope(dispatcher), gate, numbers)
            test.space().stop(holder)
            test.runQueued()
            gate.resolve(1)
            numbers.publish(2)
            test.runQueued()
            assertThat(log).containsExactlyInAnyOrder("awaited 1", "collected 2")
        }
    }

    @Test
    fun failureAfterACancellation_isReported_andTheActorGoesOn() {
        val gate = test.space().deferred<Int>()
        val holder = test.spawn<Holder> { HolderActor(gate, IOException("not released")) }
        val caller = test.space().scope.launch { holder.holdOn() }
        test.runQueued()
        caller.cancel()
        gate.resolve(1)
        test.runQueued()
        assertThat(takeProblems()).hasSize(1).first().asString().endsWith(": not released")
        assertThat(error { holder.holdOn() }).hasMessage("not released")
    }

    interface Leaver {
        suspend fun leave(): String
    }

    @Test
    fun actorThatStopsItselfWhileItSuspends_rejectsItsCall() {
        val leaver = test.spawn<Leaver> {
            object : Actor(), Leaver {
                override suspend fun leave(): String {
                    context().space().stop(self<Leaver>())
                    delay(10)
                    return "still there"
                }
            }
        }
        assertThat(error { leaver.leave() }).isInstanceOf(ActorStoppedException::class.java)
        advance(10)
    }

    @OptIn(ExperimentalCoroutinesApi::class)
    @Test
    fun tenThousandCallsAtOnce_areAnswered_andHalfOfThemCancelled() {
        val worker = worker()
        val calls = (1..10_000).map { test.space().scope.async { worker.work(50) } }
        test.runQueued()
        calls.filterIndexed { index, _ -> index % 2 == 0 }.forEach { it.cancel() }
        test.runQueued()
        assertThat(log).hasSize(5_000).containsOnly("stopped after 0")
        advance(50)
        assertThat(calls.count { it.isCancelled }).isEqualTo(5_000)
        assertThat(calls.filterNot { it.isCancelled }).allMatch { it.getCompleted() == "done" }
        assertThat(test.space().metrics().timers()).isZero()
    }

    @Test
    fun closedSpace_cancelsCoroutines_andEndsThemInItsOwnTurns() {
        val worker = worker()
        worker.background(false)
        val working = run { worker.work(100) }
        val mine = run { awaitCancellation() }
        test.space().close()
        assertThat(working.error()).isInstanceOf(CancellationException::class.java)
        assertThat(mine.isCancelled).isTrue()
        assertThat(log).containsExactlyInAnyOrder("stopped after 0", "background of 0 ended")
    }

    @Test
    fun fullMailbox_rejectsTheCall() {
        val worker = worker(ActorSettings.defaults().withMailbox(1, Overflow.REJECT))
        val outcomes = (1..2).map { test.space().scope.promise { worker.work(0) } }
        advance(1)
        assertThat(outcomes[0].now).isEqualTo("done")
        assertThat(test.error(outcomes[1])).isInstanceOf(MailboxFullException::class.java)
        assertThat(test.takeDeadLetters()).hasSizeLessThan(2)
    }

    @Test
    fun cancelledPromise_cancelsWhatAwaitsIt_andTheOtherWayRound() {
        val first = test.space().deferred<Int>()
        val second = test.space().deferred<Int>()
        val awaits = run { first.coAwait() }
        first.cancel()
        assertThat(test.error(awaits)).isInstanceOf(CancellationException::class.java)
        val job = test.space().scope.launch { second.coAwait() }
        test.runQueued()
        job.cancel()
        assertThat(second.isCancelled).isTrue()
        val promise = run {
            try {
                awaitCancellation()
            } finally {
                log += "cancelled"
            }
        }
        promise.cancel()
        test.runQueued()
        assertThat(log).containsExactly("cancelled")
    }

    @Test
    fun orTimeout_ofThePromiseOfAScope_endsIt() {
        val late = test.space().deferred<Int>()
        val result = run { late.orTimeout(Duration.ofMillis(5)).coAwait() }
        advance(5)
        assertThat(test.error(result)).isInstanceOf(TimeoutException::class.java)
    }
}
