package io.troupe.actor.kotlin.guide

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.connect
import io.troupe.actor.kotlin.publish
import io.troupe.broker.Broker
import io.troupe.broker.BrokerSettings
import io.troupe.broker.Need
import kotlinx.coroutines.runBlocking
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** The sample of the guide's section on services answers. */
class GuideServicesTest {
    @Test
    fun greeter_isAServiceAtABroker() {
        ActorSpace.create(SpaceSettings.named("ship")).use { space ->
            val broker = Broker.open(space, BrokerSettings.defaults())
            val services = broker.services()
            services.publish<Greeter>(space, "greeter") { PoliteGreeter() }
            val greeter = services.connect<Greeter>(Need.ofService("guest", "greeter")).actor()
            greeter.remember("Ada")
            val answer = runBlocking { greeter.greet("Ada") }
            broker.close()
            assertThat(answer).isEqualTo("Hello again, Ada")
        }
    }
}
