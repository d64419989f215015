package hello

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.spawn
import kotlin.time.Duration.Companion.seconds
import kotlinx.coroutines.runBlocking
import kotlinx.coroutines.withTimeout

interface Greeter {
    suspend fun greet(name: String): String

    fun remember(name: String)
}

class PoliteGreeter : Greeter {
    private val names = mutableSetOf<String>()

    override suspend fun greet(name: String) = if (name in names) "Hello again, $name" else "Hello, $name"

    override fun remember(name: String) {
        names += name
    }
}

fun main() {
    ActorSpace.create(SpaceSettings.named("hello")).use { space ->
        val greeter = space.spawn<Greeter> { PoliteGreeter() }
        greeter.remember("Ada")
        println(runBlocking { withTimeout(10.seconds) { greeter.greet("Ada") } })
    }
}
