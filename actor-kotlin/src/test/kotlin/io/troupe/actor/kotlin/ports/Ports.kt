package io.troupe.actor.kotlin.ports

import kotlinx.coroutines.flow.Flow

/** Counts up to a limit. */
interface BoundedCounter {
    suspend fun increment(): Boolean

    suspend fun value(): Int
}

/** Lets a number of calls through in each period, in the order of their arrival. */
interface RateLimiter {
    suspend fun acquire()
}

/** Sends each line to all members but the speaker, in one order. */
interface ChatRoom {
    fun join(name: String): Flow<String>

    suspend fun say(name: String, line: String): Int
}
