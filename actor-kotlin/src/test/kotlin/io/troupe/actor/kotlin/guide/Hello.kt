package io.troupe.actor.kotlin.guide

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.spawn
import kotlinx.coroutines.runBlocking

interface Greeter {
    suspend fun greet(name: String): String // a request

    fun remember(name: String) // a one-way message
}

class PoliteGreeter : Greeter {
    private val names = mutableSetOf<String>() // no lock: only the space's thread gets here

    override suspend fun greet(name: String) = if (name in names) "Hello again, $name" else "Hello, $name"

    override fun remember(name: String) {
        names += name
    }
}

fun main() {
    ActorSpace.create(SpaceSettings.named("hello")).use { space ->
        val greeter = space.spawn<Greeter> { PoliteGreeter() }
        greeter.remember("Ada")
        runBlocking { println(greeter.greet("Ada")) }
    }
}
