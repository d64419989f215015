package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.ActorStoppedException
import io.troupe.actor.Callback
import io.troupe.actor.SpaceSettings
import io.troupe.actor.Topic
import java.io.IOException
import java.util.concurrent.CancellationException
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.Flow
import kotlinx.coroutines.flow.asFlow
import kotlinx.coroutines.flow.flow
import kotlinx.coroutines.flow.onEach
import kotlinx.coroutines.flow.take
import kotlinx.coroutines.flow.toList
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import kotlinx.coroutines.withContext
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Flows from callbacks and topics, and back. */
class FlowsTest : InTestSpace() {
    interface Counter {
        fun count(limit: Int, to: Callback<Int>)

        fun countSlowly(limit: Int, to: Callback<Int>)
    }

    private inner class CounterActor : Counter {
        override fun count(limit: Int, to: Callback<Int>) {
            for (number in 1..limit) {
                to.next(number)
            }
            if (limit == 13) to.fail(IOException("unlucky")) else to.finish()
        }

        override fun countSlowly(limit: Int, to: Callback<Int>) {
            actorScope().launch { (1..limit).asFlow().onEach { delay(10) }.sendTo(to) }
        }
    }

    private val counter = test.spawn<Counter> { CounterActor() }

    private fun numbers(limit: Int, buffer: FlowBuffer = FlowBuffer.unlimited()): Flow<Int> =
        callbacks(buffer) { counter.count(limit, it) }

    @Test
    fun callbacks_areAColdFlow() {
        val flow = numbers(3)
        assertThat(value { flow.toList() }).containsExactly(1, 2, 3)
        assertThat(value { flow.toList() }).containsExactly(1, 2, 3)
        assertThat(value { numbers(1_000).take(2).toList() }).containsExactly(1, 2)
        assertThat(error { numbers(13).collect { log += "$it" } }).hasMessage("unlucky")
        assertThat(log).hasSize(13)
    }

    @Test
    fun collectorThatHasEnough_cancelsTheCallback() {
        val result = run { callbacks<Int> { counter.countSlowly(1_000, it) }.take(2).toList() }
        advance(20)
        assertThat(result.now).containsExactly(1, 2)
        advance(20)
        assertThat(test.space().metrics().timers()).isZero()
    }

    @Test
    fun slowCollector_losesWhatTheBufferSays_andTheLossIsCounted() {
        suspend fun slowly(flow: Flow<Int>): List<Int> = flow.onEach { delay(1) }.toList()

        fun all(buffer: FlowBuffer): List<Int> {
            val result = run { slowly(numbers(10, buffer)) }
            advance(20)
            return test.get(result)
        }
        val unlimited = FlowBuffer.unlimited()
        assertThat(all(unlimited)).hasSize(10)
        assertThat(unlimited.dropped).isZero()
        val newest = FlowBuffer.dropOldest(3)
        assertThat(all(newest)).containsExactly(8, 9, 10)
        assertThat(newest.dropped).isEqualTo(7)
        val latest = FlowBuffer.latest()
        assertThat(all(latest)).containsExactly(10)
        assertThat(latest.dropped).isEqualTo(9)
        val failing = FlowBuffer.failing(3)
        val result = run { numbers(10, failing).onEach { delay(1) }.collect { log += "$it" } }
        advance(20)
        assertThat(test.error(result))
            .isInstanceOf(FlowOverflowException::class.java)
            .hasMessage("the collector is too slow for the buffer failing(3)")
        assertThat(log).containsExactly("1", "2", "3", "4")
        assertThatThrownBy { FlowBuffer.dropOldest(0) }.hasMessage("capacity is 0, expected 1 or more")
    }

    @Test
    fun spaceThatIsBehind_keepsNoMoreThanTheBuffer_andTheLossIsCounted() {
        val numbers = Topic.of<Int>(test.space(), "numbers")
        val newest = FlowBuffer.dropOldest(3)
        val seen = run { numbers.asFlow(newest).toList() }
        (1..1_000).forEach { numbers.publish(it) }
        assertThat(test.space().metrics().waiting()).isEqualTo(3)
        numbers.finish()
        assertThat(test.get(seen)).containsExactly(998, 999, 1_000)
        assertThat(newest.dropped).isEqualTo(997)
    }

    @Test
    fun topic_isAFlow_andAFlowIsPublished() {
        val colours = Topic.latest<String>(test.space(), "colours")
        colours.publish("red")
        val seen = run { colours.asFlow().toList() }
        run { listOf("green", "blue").asFlow().publishTo(colours) }
        assertThat(colours.subscribers()).isEqualTo(1)
        colours.finish()
        assertThat(test.get(seen)).containsExactly("red", "green", "blue")
        val numbers = Topic.of<Int>(test.space(), "numbers")
        val two = run { numbers.asFlow(FlowBuffer.latest()).take(2).toList() }
        (1..3).forEach {
            numbers.publish(it)
            test.runQueued()
        }
        assertThat(two.now).containsExactly(1, 2)
        assertThat(numbers.subscribers()).isZero()
    }

    @Test
    fun errorsOnTheWay_reachTheCollector_andEndTheCallback() {
        assertThat(error { callbacks<Int> { throw IOException("no counter") }.toList() }).hasMessage("no counter")
        val collected = run {
            callbacks<Int> { counter.countSlowly(1_000, it) }.collect { throw IOException("no room for $it") }
        }
        advance(10)
        assertThat(test.error(collected)).hasMessage("no room for 1")
        test.space().stop(counter)
        test.runQueued()
        assertThat(error { numbers(3).toList() }).isInstanceOf(ActorStoppedException::class.java)
        assertThat(test.takeDeadLetters()).hasSize(1)
    }

    @Test
    fun failedFlow_failsItsCallback() {
        val probe = test.callback<Int>()
        run {
            flow {
                emit(1)
                throw IOException("flow")
            }.sendTo(probe)
        }
        assertThat(probe.results()).containsExactly(1)
        assertThat(probe.expectFailed()).hasMessage("flow")
    }

    @Test
    fun cancelledFlow_failsItsCallback_andIsCancelled() {
        val probe = test.callback<Int>()
        val job = test.space().scope.launch { flow<Int> { delay(10) }.sendTo(probe) }
        test.runQueued()
        job.cancel()
        test.runQueued()
        assertThat(probe.expectFailed()).isInstanceOf(CancellationException::class.java)
        assertThat(job.isCancelled).isTrue()
    }

    @Test
    fun collectorOnAnotherThread_neverBlocksTheSpace() {
        ActorSpace.create(SpaceSettings.named("real")).use { space ->
            val numbers = Topic.of<Int>(space, "numbers")
            val buffer = FlowBuffer.dropOldest(10)
            runBlocking {
                val collected = mutableListOf<Int>()
                val collector = launch(Dispatchers.Default) {
                    numbers.asFlow(buffer).collect {
                        collected += it
                        if (it == 1) withContext(space.asDispatcher()) { (2..1_000).forEach(numbers::publish) }
                    }
                }
                while (numbers.subscribers() == 0) kotlinx.coroutines.yield()
                numbers.publish(1)
                withContext(space.asDispatcher()) { }
                while (collected.lastOrNull() != 1_000) {
                    delay(1)
                }
                numbers.finish()
                collector.join()
                assertThat(collected).startsWith(1).endsWith(1_000).isSorted()
                assertThat(collected.size + buffer.dropped).isEqualTo(1_000)
            }
        }
    }
}
