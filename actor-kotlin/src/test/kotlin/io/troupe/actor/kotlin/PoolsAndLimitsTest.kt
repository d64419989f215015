package io.troupe.actor.kotlin

import io.troupe.actor.ActorPool
import io.troupe.actor.ActorSettings
import io.troupe.actor.ActorSpace
import io.troupe.actor.Deferred
import io.troupe.actor.Promise
import java.time.Duration
import java.util.concurrent.TimeoutException
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.coroutineScope
import kotlinx.coroutines.delay
import kotlinx.coroutines.yield
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** Pools of actors with suspend functions, and time limits that suspend functions share. */
class PoolsAndLimitsTest : InTestSpace() {
    interface Desk {
        suspend fun serve(customer: String): String

        suspend fun anyDesk(): String

        fun promised(customer: String): Promise<String>
    }

    private var desks = 0

    private inner class NumberedDesk : Desk {
        private val number = desks++
        private var served = 0

        override suspend fun serve(customer: String): String {
            val mine = ++served
            delay(10)
            return "$customer is number $mine at desk $number"
        }

        override suspend fun anyDesk() = "desk $number"

        override fun promised(customer: String): Promise<String> = promise { serve(customer) }
    }

    private fun pool(size: Int): ActorPool<Desk> =
        ActorPool.on(List(size) { test.space() }, Desk::class.java, { NumberedDesk() }, ActorSettings.defaults())

    @Test
    fun roundRobin_suspendsUntilTheChosenActorHasAnswered() {
        val pool = pool(3)
        val answers = run { coroutineScope { (1..6).map { async { pool.roundRobin().serve("c$it") } }.awaitAll() } }
        advance(10)
        assertThat(test.get(answers))
            .containsExactly(
                "c1 is number 1 at desk 0",
                "c2 is number 1 at desk 1",
                "c3 is number 1 at desk 2",
                "c4 is number 2 at desk 0",
                "c5 is number 2 at desk 1",
                "c6 is number 2 at desk 2",
            )
        pool.close()
        test.runQueued()
    }

    @Test
    fun byFirstArgument_sendsOneCustomerToOneDesk_whateverTheContinuation() {
        val pool = pool(4)
        val answers = run { (1..3).map { pool.byFirstArgument().serve("ann") } }
        advance(30)
        val desk = test.get(answers).first().substringAfterLast(' ')
        assertThat(test.get(answers)).allMatch { it.endsWith(desk) }
        assertThat(value { pool.actor("ann").anyDesk() }).isEqualTo("desk $desk")
        assertThat(error { pool.byFirstArgument().anyDesk() })
            .isInstanceOf(UnsupportedOperationException::class.java)
            .hasMessageContaining("no argument by which")
        pool.close()
        test.runQueued()
    }

    @Test
    fun broadcast_ofASuspendFunction_isRejected_andThatOfAPromiseReachesAll() {
        val pool = pool(2)
        assertThat(error { pool.broadcast().serve("ann") })
            .isInstanceOf(UnsupportedOperationException::class.java)
            .hasMessageContaining("call it on each of actors()")
        val first = run { pool.broadcast().promised("ann").coAwait() }
        advance(10)
        assertThat(test.get(first)).isEqualTo("ann is number 1 at desk 0")
        val second = run { pool.actors().map { it.serve("bob") } }
        advance(20)
        assertThat(test.get(second)).containsExactly("bob is number 2 at desk 0", "bob is number 2 at desk 1")
        pool.close()
        test.runQueued()
    }

    interface Clerk {
        suspend fun left(): Duration?

        suspend fun leftAfter(millis: Long): Duration?

        suspend fun never(): String
    }

    private class AskingClerk(private val other: Clerk?) : Clerk {
        override suspend fun left(): Duration? = other?.left() ?: ActorSpace.timeLeft()

        override suspend fun leftAfter(millis: Long): Duration? {
            other?.left()
            yield()
            delay(millis)
            return coroutineScope { async { left() }.await() }
        }

        override suspend fun never(): String = other?.never() ?: Deferred<String>().coAwait()
    }

    private fun clerk(): Clerk {
        val other = test.spawn<Clerk> { AskingClerk(null) }
        return test.spawn<Clerk> { AskingClerk(other) }
    }

    private fun <T> within(millis: Long, block: suspend () -> T): Promise<T> {
        val answer =
            test.space().within<T>(Duration.ofMillis(millis)) { test.space().scope.promise { block() } }
        test.runQueued()
        return answer
    }

    @Test
    fun limit_isInheritedBySuspendFunctions_alsoAfterTheyHaveSuspended() {
        val clerk = clerk()
        assertThat(test.get(within(100) { clerk.left() })).isEqualTo(Duration.ofMillis(100))
        val later = within(100) { clerk.leftAfter(30) }
        advance(30)
        assertThat(test.get(later)).isEqualTo(Duration.ofMillis(70))
        assertThat(value { clerk.left() }).isNull()
    }

    @Test
    fun limitThatIsOver_endsTheSuspendedCalls() {
        val clerk = clerk()
        val answer = within(100) { clerk.never() }
        advance(100)
        assertThat(test.error(answer))
            .isInstanceOf(TimeoutException::class.java)
            .hasMessageContaining("within PT0.1S from Clerk.never(")
        assertThat(test.space().metrics().expired()).isEqualTo(2)
    }
}
