package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.Callback
import io.troupe.actor.Promise
import io.troupe.actor.SpaceSettings
import io.troupe.actor.Topic
import io.troupe.broker.Broker
import io.troupe.broker.BrokerSettings
import io.troupe.broker.Need
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.Flow
import kotlinx.coroutines.flow.asFlow
import kotlinx.coroutines.flow.toList
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** The samples of the KDoc and of the module's page. */
class SamplesTest : InTestSpace() {
    private val space = test.space()

    interface Greeter {
        suspend fun greet(name: String): String
    }

    class PoliteGreeter : Greeter {
        override suspend fun greet(name: String) = "Hello, $name"
    }

    @Test
    fun greeter() {
        val greeter = space.spawn<Greeter> { PoliteGreeter() }
        assertThat(value { greeter.greet("Ada") }).isEqualTo("Hello, Ada")
    }

    interface Shop {
        fun price(item: String): Promise<Int>
    }

    interface Till {
        fun total(item: String, count: Int): Promise<Int>
    }

    suspend fun total(shop: Shop): Int = shop.price("lamp").coAwait() + shop.price("bulb").coAwait()

    class TillActor(private val shop: Shop) : Till {
        override fun total(item: String, count: Int): Promise<Int> = promise { shop.price(item).coAwait() * count }
    }

    @Test
    fun shop() {
        val shop = test.spawn<Shop> {
            object : Shop {
                override fun price(item: String): Promise<Int> = Promise.of(item.length)
            }
        }
        assertThat(value { total(shop) }).isEqualTo(8)
        assertThat(test.get(test.spawn<Till> { TillActor(shop) }.total("lamp", 3))).isEqualTo(12)
    }

    fun interface Sensor {
        fun read(): Int
    }

    interface Watch {
        fun watch(sensor: Sensor)

        fun level(): Promise<Int>

        fun count(limit: Int, to: Callback<Int>)
    }

    class WatchActor : Watch {
        private var level = 0

        override fun watch(sensor: Sensor) {
            actorScope().launch {
                while (true) {
                    delay(1_000)
                    level = sensor.read()
                }
            }
        }

        override fun level(): Promise<Int> = Promise.of(level)

        override fun count(limit: Int, to: Callback<Int>) {
            actorScope().launch { (1..limit).asFlow().sendTo(to) }
        }
    }

    @Test
    fun scopesAndFlows() {
        val counter = test.spawn<Watch> { WatchActor() }
        counter.watch { 7 }
        advance(1_000)
        assertThat(test.get(counter.level())).isEqualTo(7)
        val numbers: Flow<Int> = callbacks { counter.count(3, it) }
        assertThat(value { numbers.toList() }).containsExactly(1, 2, 3)
        val colours = Topic.latest<String>(space, "colours")
        colours.publish("red")
        val show: (String) -> Unit = { log += it }
        run {
            colours.asFlow(FlowBuffer.latest()).collect { show(it) }
        }
        assertThat(log).containsExactly("red")
        colours.finish()
        test.runQueued()
    }

    interface Thermometer {
        suspend fun read(): Double
    }

    class ThermometerActor : Thermometer {
        override suspend fun read() = 20.5
    }

    @Test
    fun services() {
        val broker = Broker.open(space, BrokerSettings.defaults().withObserver { })
        val services = broker.services()
        services.publish<Thermometer>(space, "thermometer") { ThermometerActor() }
        val thermometer = services.connect<Thermometer>(Need.ofService("guest", "thermometer")).actor()
        assertThat(value { thermometer.read() }).isEqualTo(20.5)
    }

    @Test
    fun page() {
        val log = mutableListOf<String>()
        ActorSpace.create(SpaceSettings.named("hello")).use { space ->
            val greeter = space.spawn<Greeter> { PoliteGreeter() }
            runBlocking { log += greeter.greet("Ada") }
        }
        assertThat(log).containsExactly("Hello, Ada")
    }
}
