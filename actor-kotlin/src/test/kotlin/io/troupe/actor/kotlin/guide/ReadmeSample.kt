package io.troupe.actor.kotlin.guide

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.spawn
import kotlinx.coroutines.runBlocking

interface Counter { suspend fun add(n: Int): Int }

class Sum(private var sum: Int = 0) : Counter { override suspend fun add(n: Int) = (sum + n).also { sum = it } }

/** The sample of the README. */
fun readmeSample() {
    ActorSpace.create(SpaceSettings.named("hello")).use { space ->
        val counter = space.spawn<Counter> { Sum() }
        runBlocking { println(counter.add(2) + counter.add(3)) } // 2 + 5
    }
}
