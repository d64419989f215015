package io.troupe.actor.kotlin.ports

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.InTestSpace
import io.troupe.actor.kotlin.asDispatcher
import io.troupe.actor.kotlin.ports.channels.boundedCounter as channelCounter
import io.troupe.actor.kotlin.ports.channels.chatRoom as channelRoom
import io.troupe.actor.kotlin.ports.channels.rateLimiter as channelLimiter
import io.troupe.actor.kotlin.ports.troupe.boundedCounter
import io.troupe.actor.kotlin.ports.troupe.chatRoom
import io.troupe.actor.kotlin.ports.troupe.rateLimiter
import kotlin.time.Duration.Companion.milliseconds
import kotlin.time.Duration.Companion.nanoseconds
import kotlinx.coroutines.CoroutineScope
import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.Job
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.cancel
import kotlinx.coroutines.delay
import kotlinx.coroutines.flow.take
import kotlinx.coroutines.flow.toList
import kotlinx.coroutines.joinAll
import kotlinx.coroutines.launch
import kotlinx.coroutines.runBlocking
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.AfterEach
import org.junit.jupiter.api.Test

/** Three examples as actors of a space and as actors of kotlinx.coroutines: both give the same results. */
class PortsTest : InTestSpace() {
    private val scope = CoroutineScope(test.space().asDispatcher() + Job())

    @AfterEach
    fun cancel() {
        scope.cancel()
        test.runQueued()
    }

    @Test
    fun boundedCounter_countsToItsLimit_onRealThreads() {
        fun results(counter: BoundedCounter): List<Int> = runBlocking(Dispatchers.Default) {
            val done = (1..8).map { async { (1..20).count { counter.increment() } } }.awaitAll()
            listOf(done.sum(), counter.value())
        }
        ActorSpace.create(SpaceSettings.named("counter")).use { space ->
            val other = CoroutineScope(Dispatchers.Default + Job())
            assertThat(results(boundedCounter(space, 100)))
                .isEqualTo(results(channelCounter(other, 100)))
                .containsExactly(100, 100)
            other.cancel()
        }
    }

    /** When each of seven calls goes through; two are cancelled while they wait, the third as the next. */
    private fun times(limiter: RateLimiter): List<String> {
        val began = test.space().clock().nanos()
        val times = mutableListOf<String>()
        val calls = (1..7).map { call ->
            scope.launch {
                delay(call * 10L)
                limiter.acquire()
                times += "$call at ${(test.space().clock().nanos() - began) / 1_000_000} ms"
            }
        }
        test.runQueued()
        advance(45)
        calls[2].cancel()
        calls[4].cancel()
        repeat(400) { advance(1) }
        assertThat(calls).allMatch { it.isCompleted }
        return times
    }

    @Test
    fun rateLimiter_letsTwoThroughInAPeriod_atTheSameVirtualTimes() {
        val ours = times(rateLimiter(test.space(), 2, 100.milliseconds))
        val theirs = times(channelLimiter(scope, 2, 100.milliseconds) { test.space().clock().nanos().nanoseconds })
        assertThat(ours)
            .isEqualTo(theirs)
            .containsExactly("1 at 10 ms", "2 at 20 ms", "4 at 110 ms", "6 at 120 ms", "7 at 210 ms")
    }

    private fun conversation(room: ChatRoom): List<Any> {
        val heard = sortedMapOf<String, List<String>>()
        val reached = mutableListOf<Int>()
        val members = listOf("Ada" to 3, "Bob" to 2, "Cid" to 1).map { (name, lines) ->
            scope.launch { heard[name] = room.join(name).take(lines).toList() }.also { test.runQueued() }
        }
        val talk = scope.launch {
            val lines = listOf("Ada" to "hello", "Bob" to "hi", "Ada" to "well", "Bob" to "bye", "Bob" to "?")
            for ((name, line) in lines) {
                reached += room.say(name, line)
                delay(1) // time for those who have enough to leave
            }
        }
        repeat(10) { advance(1) }
        runBlocking { (members + talk).joinAll() }
        return listOf(heard, reached)
    }

    @Test
    fun chatRoom_sendsEachLineToTheOthers_untilTheyLeave() {
        val ours = conversation(chatRoom(test.space()))
        assertThat(ours).isEqualTo(conversation(channelRoom(scope)))
        assertThat(ours.toString()).isEqualTo(
            "[{Ada=[Bob: hi, Bob: bye, Bob: ?], Bob=[Ada: hello, Ada: well], Cid=[Ada: hello]}, [2, 1, 1, 1, 1]]",
        )
    }
}
