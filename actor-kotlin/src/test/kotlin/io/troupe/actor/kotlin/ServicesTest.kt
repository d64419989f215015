package io.troupe.actor.kotlin

import io.troupe.actor.Callback
import io.troupe.actor.Promise
import io.troupe.broker.ActorServices
import io.troupe.broker.Broker
import io.troupe.broker.BrokerSettings
import io.troupe.broker.ConnectionSettings
import io.troupe.broker.Need
import io.troupe.bus.Bus
import io.troupe.bus.BusSettings
import io.troupe.bus.BytePipe
import io.troupe.bus.RemoteFailure
import java.time.Duration
import kotlinx.coroutines.CancellationException
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.toList
import kotlinx.coroutines.launch
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Test

/** Actors with suspend functions as services, in one process and over hosts. */
class ServicesTest : InTestSpace() {
    @JvmRecord data class Reading(val degrees: Double, val place: String?)

    interface Thermometer {
        suspend fun read(place: String): Reading

        suspend fun readLater(millis: Long): Int

        suspend fun find(place: String): String?

        suspend fun reset()

        fun save(): Promise<Unit>

        suspend fun warmest(places: List<String>): Reading = places.map { read(it) }.maxBy { it.degrees }

        suspend fun coldest(places: List<String>): Reading = places.map { read(it) }.minBy { it.degrees }

        fun count(limit: Int, to: Callback<Int>)
    }

    private inner class ThermometerActor : Thermometer {
        override suspend fun read(place: String): Reading {
            require(place.isNotEmpty()) { "no place" }
            return Reading(place.length.toDouble(), place)
        }

        override suspend fun readLater(millis: Long): Int =
            try {
                delay(millis)
                21
            } catch (e: CancellationException) {
                log += "cancelled"
                throw e
            }

        override suspend fun find(place: String): String? = null

        override suspend fun reset() {
            log += "reset"
        }

        override fun save(): Promise<Unit> = promise { log += "saved" }

        override suspend fun coldest(places: List<String>): Reading = Reading(-1.0, "where the actor says")

        override fun count(limit: Int, to: Callback<Int>) {
            (1..limit).forEach(to::next)
            to.finish()
        }
    }

    private val pipe = BytePipe(test.space())
    private val space = test.space()

    private val brokers = mutableListOf<Broker>()
    private val buses = mutableListOf<Bus>()
    private val losses = mutableListOf<String>()

    private fun services(host: String?): ActorServices {
        val settings = BrokerSettings.defaults().withObserver { }
        if (host == null) {
            brokers += Broker.open("ship", space, settings)
            return brokers.last().services()
        }
        val bus = pipe.open(host, BusSettings.on(space).withObserver { losses += it.toString() })
        buses += bus
        brokers += Broker.over(bus, space, settings)
        return brokers.last().services()
    }

    @AfterEach
    fun closeAsync() {
        brokers.forEach { test.get(it.closeAsync()) }
        test.runQueued()
        buses.forEach(Bus::close)
        test.runQueued()
    }

    private fun publish(services: ActorServices) {
        val record = services.publish<Thermometer>(space, "thermometer") { ThermometerActor() }
        advance(10)
        assertThat(test.get(record).service()).isEqualTo("thermometer")
    }

    private fun connected(services: ActorServices): Thermometer =
        services.connect<Thermometer>(Need.ofService("guest", "thermometer")).actor()

    /** Runs a call to its end; over hosts it needs time. */
    private fun <T> result(block: suspend () -> T): T {
        val result = run(block)
        advance(1_000)
        return test.get(result)
    }

    private fun checkCalls(thermometer: Thermometer) {
        assertThat(result { thermometer.read("hall") }).isEqualTo(Reading(4.0, "hall"))
        assertThat(result { thermometer.readLater(20) }).isEqualTo(21)
        assertThat(result { thermometer.find("hall") }).isNull()
        assertThat(result<Any> { thermometer.reset() }).isEqualTo(Unit)
        assertThat(result<Any> { thermometer.save().coAwait() }).isEqualTo(Unit)
        assertThat(log).containsExactly("reset", "saved")
        assertThat(result { thermometer.warmest(listOf("a", "attic", "hall")) }).isEqualTo(Reading(5.0, "attic"))
        val coldest = result { thermometer.coldest(listOf("a", "attic")) }
        assertThat(coldest).isEqualTo(Reading(-1.0, "where the actor says"))
        assertThat(result { callbacks<Int> { thermometer.count(3, it) }.toList() }).containsExactly(1, 2, 3)
    }

    private fun checkCancellation(thermometer: Thermometer) {
        log.clear()
        val job = space.scope.launch { thermometer.readLater(60_000) }
        advance(100)
        assertThat(log).isEmpty()
        job.cancel()
        advance(1_000)
        assertThat(job.isCancelled).isTrue()
        assertThat(log).containsExactly("cancelled")
        assertThat(losses).isEmpty()
    }

    @Test
    fun service_inOneProcess() {
        val services = services(null)
        publish(services)
        val thermometer = connected(services)
        checkCalls(thermometer)
        assertThatThrownBy { result { thermometer.read("") } }
            .isExactlyInstanceOf(IllegalArgumentException::class.java)
            .hasMessage("no place")
        checkCancellation(thermometer)
    }

    @Test
    fun service_overHosts() {
        val ship = services("ship")
        val shore = services("shore")
        publish(ship)
        advance(3_000)
        val thermometer = connected(shore)
        checkCalls(thermometer)
        assertThatThrownBy { result { thermometer.read("") } }
            .isInstanceOf(RemoteFailure::class.java)
            .hasMessageEndingWith(": java.lang.IllegalArgumentException: no place")
        checkCancellation(thermometer)
    }

    @Test
    fun callThatAnotherHostHasBegun_isCancelledAtItsLimit_andWhenItsCallersHostLeaves() {
        val ship = services("ship")
        val shore = services("shore")
        publish(ship)
        advance(3_000)
        val limit = ConnectionSettings.defaults().withAnswerLimit(Duration.ofSeconds(1))
        val limited = shore.connect<Thermometer>(Need.ofService("guest", "thermometer"), limit).actor()
        val result = run { limited.readLater(60_000) }
        advance(1_000)
        assertThat(test.error(result)).hasMessageContaining("did not answer")
        assertThat(log).containsExactly("cancelled")
        val call = run { connected(shore).readLater(60_000) }
        advance(100)
        assertThat(call.isDone).isFalse()
        buses.last().close() // that of the shore
        advance(100)
        assertThat(test.error(call)).hasMessageContaining("the bus shore is closed")
        assertThat(log).containsExactly("cancelled", "cancelled")
    }

    interface Odd {
        suspend fun thread(): Thread
    }

    @Test
    fun resultThatCannotCross_isRejectedWhenItIsPublished() {
        val ship = services("ship")
        assertThatThrownBy { ship.publish<Odd>(space, "odd") { throw AssertionError() } }
            .isInstanceOf(IllegalArgumentException::class.java)
            .hasMessageContaining("Odd.thread() cannot be called from other hosts: result")
    }
}
