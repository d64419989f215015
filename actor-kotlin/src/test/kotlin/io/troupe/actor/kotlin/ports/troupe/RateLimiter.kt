package io.troupe.actor.kotlin.ports.troupe

import io.troupe.actor.Actor
import io.troupe.actor.ActorSpace
import io.troupe.actor.kotlin.ports.RateLimiter
import io.troupe.actor.kotlin.spawn
import kotlin.time.Duration
import kotlin.time.Duration.Companion.nanoseconds
import kotlinx.coroutines.delay
import kotlinx.coroutines.sync.Mutex
import kotlinx.coroutines.sync.withLock

class RateLimiterActor(private val permits: Int, private val period: Duration) : Actor(), RateLimiter {
    private val recent = ArrayDeque<Duration>()
    private val turn = Mutex() // a call that waits keeps the later ones behind it

    override suspend fun acquire() = turn.withLock {
        if (recent.size == permits) {
            delay(recent.first() + period - now())
            recent.removeFirst()
        }
        recent += now()
    }

    private fun now() = context().space().clock().nanos().nanoseconds
}

fun rateLimiter(space: ActorSpace, permits: Int, period: Duration) =
    space.spawn<RateLimiter> { RateLimiterActor(permits, period) }
