package io.troupe.actor.kotlin.guide

import io.troupe.actor.Actor
import io.troupe.actor.ActorSettings
import io.troupe.actor.ActorSpace
import io.troupe.actor.Callback
import io.troupe.actor.Promise
import io.troupe.actor.SpaceSettings
import io.troupe.actor.Supervision
import io.troupe.actor.Topic
import io.troupe.actor.kotlin.FlowBuffer
import io.troupe.actor.kotlin.InTestSpace
import io.troupe.actor.kotlin.actorScope
import io.troupe.actor.kotlin.asDispatcher
import io.troupe.actor.kotlin.asFlow
import io.troupe.actor.kotlin.callbacks
import io.troupe.actor.kotlin.coAwait
import io.troupe.actor.kotlin.promise
import io.troupe.actor.kotlin.publishTo
import io.troupe.actor.kotlin.scope
import io.troupe.actor.kotlin.sendTo
import io.troupe.actor.kotlin.spawn
import io.troupe.actor.testkit.TestSpace
import java.io.ByteArrayOutputStream
import java.io.IOException
import java.io.PrintStream
import java.time.Duration
import java.util.concurrent.TimeoutException
import kotlin.time.Duration.Companion.minutes
import kotlin.time.Duration.Companion.seconds
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.async
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.Flow
import kotlinx.coroutines.flow.filter
import kotlinx.coroutines.flow.flow
import kotlinx.coroutines.flow.map
import kotlinx.coroutines.flow.take
import kotlinx.coroutines.flow.toList
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import kotlinx.coroutines.sync.Mutex
import kotlinx.coroutines.sync.withLock
import kotlinx.coroutines.withContext
import kotlinx.coroutines.withTimeout
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** The samples of the guide's chapter on Kotlin behave as the chapter describes. */
class GuideTest : InTestSpace() {
    private fun printedBy(program: () -> Unit): String {
        val out = System.out
        val printed = ByteArrayOutputStream()
        System.setOut(PrintStream(printed, true))
        try {
            program()
        } finally {
            System.setOut(out)
        }
        return printed.toString().trim()
    }

    @Test
    fun sampleOfTheReadme_printsSeven() {
        assertThat(printedBy(::readmeSample)).isEqualTo("7")
    }

    @Test
    fun hello_isAWholeProgram() {
        assertThat(printedBy(::main)).isEqualTo("Hello again, Ada")
    }

    // ---- kinds of functions

    interface Shop {
        suspend fun price(item: String): Int

        suspend fun total(items: List<String>): Int = items.sumOf { price(it) }

        fun stock(item: String): Promise<Int>

        fun order(item: String, count: Int)

        fun watch(item: String, prices: Callback<Int>)
    }

    class CornerShop : Actor(), Shop {
        private var stock = 10

        override suspend fun price(item: String) = item.length

        override fun stock(item: String): Promise<Int> = promise {
            delay(1.seconds)
            stock
        }

        override fun order(item: String, count: Int) {
            stock -= count
        }

        override fun watch(item: String, prices: Callback<Int>) {
            actorScope().launch { ticks().map { item.length + it }.sendTo(prices) }
        }

        private fun ticks(): Flow<Int> = flow {
            for (tick in 0..4) {
                emit(tick)
                delay(1.seconds)
            }
        }
    }

    suspend fun missing(shop: Shop, item: String): Int = 12 - shop.stock(item).coAwait()

    @Test
    fun kindsOfFunctions_areMixed() {
        val space = test.space()
        val settings = ActorSettings.named("corner").withSupervision(Supervision.restart(3, Duration.ofSeconds(10)))
        val shop = space.spawn<Shop>(settings) { CornerShop() }
        assertThat(value { shop.total(listOf("lamp", "bulb")) }).isEqualTo(8)
        shop.order("lamp", 3)
        val result = run { missing(shop, "lamp") }
        advance(1_000)
        assertThat(test.get(result)).isEqualTo(5)
    }

    open class Counter : Actor() {
        private var value = 0

        open suspend fun add(number: Int): Int {
            value += number
            return value
        }

        open suspend fun addLater(number: Int): Int {
            delay(1.seconds)
            return self<Counter>().add(number) // a message to itself
        }
    }

    @Test
    fun openClass_isAnActorType() {
        val counter = test.space().spawn<Counter> { Counter() }
        val result = run { counter.addLater(2) }
        advance(1_000)
        assertThat(test.get(result)).isEqualTo(2)
    }

    // ---- interleaving

    interface Bank {
        suspend fun confirm(amount: Int)
    }

    interface Purse {
        suspend fun pay(amount: Int): Boolean

        suspend fun paySafely(amount: Int): Boolean

        suspend fun content(): Int
    }

    class PurseActor(private val bank: Bank) : Purse {
        private var content = 100
        private val turn = Mutex()

        override suspend fun pay(amount: Int): Boolean {
            if (content < amount) return false
            bank.confirm(amount) // another pay may run while this one waits
            content -= amount // wrong: the content may have changed since it was read
            return true
        }

        override suspend fun paySafely(amount: Int): Boolean = turn.withLock { pay(amount) }

        override suspend fun content() = content
    }

    @Test
    fun messagesInterleave_whereAFunctionSuspends_unlessAMutexKeepsThemApart() {
        val bank = test.spawn<Bank> {
            object : Bank {
                override suspend fun confirm(amount: Int) = delay(10)
            }
        }

        fun contentAfter(pay: suspend (Purse) -> Boolean): Int {
            val purse = test.spawn<Purse> { PurseActor(bank) }
            run { pay(purse) }
            run { pay(purse) }
            advance(10)
            advance(10)
            return value { purse.content() }
        }
        assertThat(contentAfter { it.pay(70) }).isEqualTo(-40)
        assertThat(contentAfter { it.paySafely(70) }).isEqualTo(30)
    }

    // ---- time

    interface EggTimer {
        suspend fun cook(): String
    }

    class ThreeMinutes : EggTimer {
        override suspend fun cook(): String {
            delay(3.minutes)
            return "ready"
        }
    }

    @Test
    fun egg_isReadyAfterThreeMinutes() {
        TestSpace().use { test ->
            val timer = test.spawn<EggTimer> { ThreeMinutes() }
            val egg = test.space().scope.promise { timer.cook() }
            test.advance(Duration.ofSeconds(179))
            assertThat(egg.isDone).isFalse()
            test.advance(Duration.ofSeconds(1))
            assertThat(test.get(egg)).isEqualTo("ready")
        }
    }

    // ---- structured concurrency

    interface Camera {
        suspend fun shoot(): Set<String>
    }

    class Lookout(private val left: Camera, private val right: Camera) : Camera {
        override suspend fun shoot(): Set<String> = withTimeout(2.seconds) {
            val pictures = listOf(async { left.shoot() }, async { right.shoot() })
            pictures.flatMap { it.await() }.toSet()
        }
    }

    private inner class SlowCamera(private val millis: Long, private val picture: String) : Camera {
        override suspend fun shoot(): Set<String> {
            try {
                delay(millis)
                return setOf(picture)
            } finally {
                log += "$picture ends"
            }
        }
    }

    @Test
    fun timeLimit_cancelsWhatItWaitsFor_alsoInOtherActors() {
        val left = test.spawn<Camera> { SlowCamera(1_000, "red") }
        val right = test.spawn<Camera> { SlowCamera(1_500, "blue") }
        val frozen = test.spawn<Camera> { SlowCamera(100_000, "green") }
        val lookout = test.spawn<Camera> { Lookout(left, right) }
        val both = run { lookout.shoot() }
        advance(1_500)
        assertThat(test.get(both)).containsExactlyInAnyOrder("red", "blue")
        val half = test.spawn<Camera> { Lookout(left, frozen) }
        val late = run { half.shoot() }
        advance(2_000)
        assertThat(test.error(late)).isInstanceOf(TimeoutException::class.java)
        assertThat(log).containsExactly("red ends", "blue ends", "red ends", "green ends")
    }

    @Test
    fun cameras_ofWhichProbesAnswer() {
        val left = test.probe(Camera::class.java)
        val right = test.probe(Camera::class.java)
        val lookout = test.spawn<Camera> { Lookout(left.actor(), right.actor()) }

        val seen = test.space().scope.promise { lookout.shoot() }
        left.expectCall("shoot()")
        left.answer(setOf("red"))
        assertThat(seen.isDone).isFalse() // it waits for the other camera

        right.reject(IOException("no light"))
        assertThat(test.error(seen)).hasMessage("no light")
    }

    interface Sensor {
        suspend fun read(): Double
    }

    class Gauge(private val sensor: Sensor) : Actor(), Sensor {
        private var level = 0.0

        override fun started() {
            actorScope().launch {
                while (true) {
                    level = sensor.read()
                    delay(1.seconds)
                }
            }
        }

        override suspend fun read() = level
    }

    @Test
    fun coroutineOfAnActor_endsWithIt() {
        var reads = 0
        val sensor = test.spawn<Sensor> {
            object : Sensor {
                override suspend fun read() = 0.5 + reads++
            }
        }
        val gauge = test.spawn<Sensor> { Gauge(sensor) }
        advance(1_000)
        assertThat(value { gauge.read() }).isEqualTo(1.5)
        test.space().stop(gauge)
        advance(10_000)
        assertThat(reads).isEqualTo(2)
    }

    // ---- threads

    private suspend fun draw(space: ActorSpace, shop: Shop): String {
        val total = shop.total(listOf("lamp")) // from any coroutine, on any dispatcher
        val picture = withContext(Dispatchers.Default) { "#".repeat(total) } // computes elsewhere
        return withContext(space.asDispatcher()) { picture + Thread.currentThread().name } // on the space's thread
    }

    @Test
    fun dispatcherOfTheSpace_isItsThread() {
        ActorSpace.create(SpaceSettings.named("drawing")).use { space ->
            val shop = space.spawn<Shop> { CornerShop() }
            assertThat(runBlocking { draw(space, shop) }).startsWith("####").contains("drawing")
        }
    }

    // ---- flows

    @Test
    fun callbacksAndTopics_areFlows() {
        val shop = test.spawn<Shop> { CornerShop() }
        val scans = Topic.latest<Int>(test.space(), "scans")
        val scope = test.space().scope
        val prices: Flow<Int> = callbacks { shop.watch("lamp", it) }
        val high = scope.promise { prices.filter { it > 5 }.take(2).toList() }
        repeat(6) { advance(1_000) }
        assertThat(test.get(high)).containsExactly(6, 7)

        val newest = FlowBuffer.latest()
        scope.launch { scans.asFlow(newest).collect { avoid(it) } }
        scope.launch { prices.publishTo(scans) }
        repeat(6) { advance(1_000) }
        assertThat(log).containsExactly("avoid 4", "avoid 6", "avoid 8")
        assertThat(newest.dropped).isEqualTo(2)
    }

    private suspend fun avoid(scan: Int) {
        log += "avoid $scan"
        delay(2_900)
    }
}
