package io.troupe.actor.kotlin

import io.troupe.actor.Promise
import io.troupe.actor.testkit.TestSpace
import java.time.Duration
import org.junit.jupiter.api.AfterEach

/** A test in a [TestSpace], with coroutines of its space. */
abstract class InTestSpace {
    protected val test = TestSpace()
    protected val log = mutableListOf<String>()

    @AfterEach
    fun close() = test.close()

    /** Runs a coroutine on the space until nothing is left to do without time. */
    protected fun <T> run(block: suspend () -> T): Promise<T> {
        val result = test.space().scope.promise { block() }
        test.runQueued()
        return result
    }

    protected fun <T> value(block: suspend () -> T): T = test.get(run(block))

    protected fun error(block: suspend () -> Any?): Throwable = test.error(run(block))

    protected fun advance(millis: Long) = test.advance(Duration.ofMillis(millis))

    protected fun takeProblems(): List<String> = test.takeProblems().map { "${it.where}: ${it.error.message}" }
}
