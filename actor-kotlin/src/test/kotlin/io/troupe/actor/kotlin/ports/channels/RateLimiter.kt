package io.troupe.actor.kotlin.ports.channels

import io.troupe.actor.kotlin.ports.RateLimiter
import kotlin.time.Duration
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.ObsoleteCoroutinesApi
import kotlinx.coroutines.channels.actor
import kotlinx.coroutines.delay

private class Acquire(val allowed: CompletableDeferred<Unit>)

@OptIn(ObsoleteCoroutinesApi::class)
fun rateLimiter(scope: CoroutineScope, permits: Int, period: Duration, now: () -> Duration): RateLimiter {
    val mailbox = scope.actor<Acquire> {
        val recent = ArrayDeque<Duration>()
        for (message in channel) {
            if (message.allowed.isCompleted) continue // its caller was cancelled
            if (recent.size == permits) delay(recent.first() + period - now())
            if (message.allowed.complete(Unit)) {
                if (recent.size == permits) recent.removeFirst()
                recent += now()
            }
        }
    }
    return object : RateLimiter {
        override suspend fun acquire() {
            val allowed = CompletableDeferred<Unit>()
            mailbox.send(Acquire(allowed))
            try {
                allowed.await()
            } finally {
                allowed.cancel()
            }
        }
    }
}
