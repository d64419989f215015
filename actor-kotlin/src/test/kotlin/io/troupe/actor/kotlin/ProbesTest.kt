package io.troupe.actor.kotlin

import java.util.concurrent.CancellationException
import java.util.concurrent.TimeoutException
import kotlin.time.Duration.Companion.milliseconds
import kotlinx.coroutines.withTimeout
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Probes of interfaces with suspend functions. */
class ProbesTest : InTestSpace() {
    @JvmInline value class Amount(val cents: Int)

    interface Risk {
        suspend fun allows(order: String, amount: Int): Boolean

        suspend fun find(order: String): String?

        suspend fun save(order: String)

        suspend fun limit(amount: Amount): Long

        fun note(amount: Amount)
    }

    interface Desk {
        suspend fun order(order: String): String
    }

    class CarefulDesk(private val risk: Risk) : Desk {
        override suspend fun order(order: String): String {
            if (!risk.allows(order, 5)) return "refused"
            risk.save(order)
            return risk.find(order) ?: "nothing"
        }
    }

    private val probe = test.probe(Risk::class.java)
    private val desk = test.spawn<Desk> { CarefulDesk(probe.actor()) }

    @Test
    fun suspendFunctions_waitForTheAnswerOfTheTest_andTheContinuationIsNoArgument() {
        val answer = run { desk.order("lamp") }
        assertThat(probe.expectCall("allows(lamp, 5)")).containsExactly("lamp", 5)
        probe.expectNoCall()
        assertThat(answer.isDone).isFalse()
        probe.answer(true)
        probe.expectCall("save(lamp)")
        assertThat(answer.isDone).isFalse()
        probe.answer(null)
        probe.expectCall("find(lamp)")
        probe.answer("a lamp")
        assertThat(test.get(answer)).isEqualTo("a lamp")
        assertThat(probe.calls()).containsExactly("allows(lamp, 5)", "save(lamp)", "find(lamp)")
    }

    @Test
    fun functionsWithoutAResult_areAnsweredByUnitToo_andNullableOnesByNull() {
        val answer = run { desk.order("lamp") }
        probe.answer(true)
        probe.answer(Unit)
        probe.answer(null)
        assertThat(test.get(answer)).isEqualTo("nothing")
        val saved = run { probe.actor().save("bulb") }
        probe.answer(null)
        assertThat(test.get(saved)).isSameAs(Unit)
    }

    @Test
    fun rejectedFunction_throwsTheErrorInItsCaller() {
        val answer = run { desk.order("lamp") }
        probe.reject(IllegalStateException("no credit"))
        assertThat(test.error(answer)).hasMessage("no credit")
    }

    @Test
    fun answerOfAnotherType_isAMistakeOfTheTest() {
        run { desk.order("lamp") }
        assertThatThrownBy { probe.answer("yes") }
            .isInstanceOf(AssertionError::class.java)
            .hasMessageContaining("is a java.lang.String, and allows(lamp, 5) answers a java.lang.Boolean")
        probe.answer(false)
    }

    @Test
    fun functionWithoutAnAnswer_failsTheTest_unlessItIsTaken() {
        val answer = run { desk.order("lamp") }
        assertThat(probe.takeUnanswered()).containsExactly("allows(lamp, 5)")
        assertThat(answer.isDone).isFalse()
    }

    @Test
    fun functionWhoseCallerHasGivenUp_canBeAnsweredAllTheSame() {
        val answer = run { withTimeout(10.milliseconds) { desk.order("lamp") } }
        advance(10)
        assertThat(test.error(answer)).isInstanceOf(TimeoutException::class.java)
        probe.answer(true)
        probe.expectCall("allows(lamp, 5)")
        probe.expectNoCall()
        val cancelled = run { desk.order("bulb") }
        cancelled.cancel()
        assertThat(test.error(cancelled)).isInstanceOf(CancellationException::class.java)
        probe.reject(IllegalStateException("too late"))
    }

    @Test
    fun namesOfFunctionsWithValueClasses_areThoseOfTheSource() {
        probe.actor().note(Amount(7))
        probe.expectCall("note(7)")
        val limit = run { probe.actor().limit(Amount(8)) }
        probe.expectCall("limit(8)")
        probe.answer(3L)
        assertThat(test.get(limit)).isEqualTo(3L)
    }
}
