package io.troupe.actor.kotlin.ports.troupe

import io.troupe.actor.ActorSpace
import io.troupe.actor.kotlin.ports.BoundedCounter
import io.troupe.actor.kotlin.spawn

class BoundedCounterActor(private val limit: Int) : BoundedCounter {
    private var value = 0

    override suspend fun increment(): Boolean = (value < limit).also { if (it) value++ }

    override suspend fun value() = value
}

fun boundedCounter(space: ActorSpace, limit: Int) = space.spawn<BoundedCounter> { BoundedCounterActor(limit) }
