package io.troupe.actor.kotlin

import io.troupe.actor.Actor
import io.troupe.actor.ActorTypeException
import io.troupe.actor.Callback
import io.troupe.actor.Promise
import java.time.Duration
import kotlinx.coroutines.delay
import kotlinx.coroutines.yield
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Suspend functions in actor types: messages like any other. */
class SuspendingActorTest : InTestSpace() {
    interface Mixed {
        suspend fun greet(name: String): String

        suspend fun greetLater(name: String, millis: Long = 100): String

        fun promised(name: String): Promise<String>

        fun note(text: String)

        fun count(limit: Int, to: Callback<Int>)

        suspend fun forget()

        suspend fun find(name: String): String?

        suspend fun twice(name: String): String = greet(name) + ", " + greet(name)

        fun length(name: String): Int = name.length

        suspend fun sum(a: Byte, b: Long, c: Double, d: Boolean, e: IntArray, vararg f: Char): Double

        suspend fun each(limit: Int, to: Callback<Int>): Int
    }

    private inner class MixedActor : Mixed {
        override suspend fun greet(name: String) = "hello $name"

        override suspend fun greetLater(name: String, millis: Long): String {
            delay(millis)
            return "hello at last, $name"
        }

        override fun promised(name: String): Promise<String> = promise {
            delay(10)
            "promised $name"
        }

        override fun note(text: String) {
            log += text
        }

        override fun count(limit: Int, to: Callback<Int>) {
            (1..limit).forEach(to::next)
            to.finish()
        }

        override suspend fun forget() {
            yield()
            log.clear()
        }

        override suspend fun find(name: String): String? {
            if (name == "late") yield()
            return null
        }

        override suspend fun sum(a: Byte, b: Long, c: Double, d: Boolean, e: IntArray, vararg f: Char): Double =
            a + b + c + (if (d) 1 else 0) + e.sum() + f.size

        override suspend fun each(limit: Int, to: Callback<Int>): Int {
            (1..limit).forEach(to::next)
            return limit
        }
    }

    @Test
    fun functionsOfEveryKind_areMixedInOneType() {
        val mixed = test.spawn<Mixed> { MixedActor() }
        mixed.note("one")
        assertThat(value { mixed.greet("Ada") }).isEqualTo("hello Ada")
        assertThat(log).containsExactly("one")
        assertThat(value { mixed.forget() }).isEqualTo(Unit)
        assertThat(log).isEmpty()
        assertThat(value { mixed.find("x") }).isNull()
        assertThat(value { mixed.find("late") }).isNull()
        assertThat(value { mixed.twice("Bob") }).isEqualTo("hello Bob, hello Bob")
        assertThat(mixed.length("Bob")).isEqualTo(3)
        assertThat(value { mixed.sum(1, 2L, 3.5, true, intArrayOf(4, 5), 'x', 'y') }).isEqualTo(18.5)
        val results = mutableListOf<Int>()
        test.run { mixed.count(2) { number, _ -> results += number!! } }
        assertThat(value { mixed.each(3) { number, _ -> results += number!! } }).isEqualTo(3)
        assertThat(results).containsExactly(1, 2, 1, 2, 3)
    }

    @Test
    fun delay_isByTheClockOfTheSpace() {
        val mixed = test.spawn<Mixed> { MixedActor() }
        val early = run { mixed.greetLater("Ann") }
        val late = run { mixed.greetLater("Bob", 101) }
        val promised = mixed.promised("Cid")
        advance(99)
        assertThat(early.isDone).isFalse()
        assertThat(test.get(promised)).isEqualTo("promised Cid")
        advance(1)
        assertThat(early.now).isEqualTo("hello at last, Ann")
        assertThat(late.isDone).isFalse()
        advance(1)
        assertThat(late.now).isEqualTo("hello at last, Bob")
    }

    open class Counter : Actor() {
        private var value = 0

        open suspend fun add(number: Int): Int {
            yield()
            value += number
            return value
        }

        open suspend fun addTwice(number: Int): Int {
            self<Counter>().add(number)
            return self<Counter>().add(number)
        }

        open fun now(): Promise<Int> = Promise.of(value)

        protected open suspend fun hidden() = yield()
    }

    @Test
    fun openClass_isAnActorType() {
        val counter = test.spawn<Counter> { Counter() }
        assertThat(value { counter.add(2) }).isEqualTo(2)
        assertThat(value { counter.addTwice(3) }).isEqualTo(8)
        assertThat(test.get(counter.now())).isEqualTo(8)
    }

    abstract class Register<T> : Actor() {
        private val items = mutableListOf<T>()

        open suspend fun add(item: T, times: Int = 1): Int {
            repeat(times) { items += item }
            return items.size
        }

        abstract suspend fun checked(item: T): T?

        open suspend fun all(): List<T> = items.toList()

        open fun clear(): Promise<Unit> = promise { items.clear() }
    }

    open class TextRegister : Register<String>() {
        override suspend fun add(item: String, times: Int): Int {
            yield()
            return super.add(item.trim(), times)
        }

        override suspend fun checked(item: String): String? = item.trim().ifEmpty { null }

        open suspend fun later(): Promise<String> = Promise.of("later")
    }

    @Test
    fun openClass_ofAGenericClass_withDefaultArguments() {
        val register = test.spawn<TextRegister> { TextRegister() }
        assertThat(value { register.add(" a") }).isEqualTo(1)
        assertThat(value { (register as Register<String>).add("b ", 2) }).isEqualTo(3)
        assertThat(value { register.all() }).containsExactly("a", "b", "b")
        assertThat(value { (register as Register<String>).checked(" ") }).isNull()
        assertThat(value { register.later().coAwait() }).isEqualTo("later")
        assertThat(test.get(register.clear())).isEqualTo(Unit)
        assertThat(value { register.all() }).isEmpty()
    }

    interface Box<T> {
        suspend fun put(item: T): T?

        suspend fun <R> map(change: (T) -> R): R
    }

    interface TextBox : Box<String> {
        override suspend fun put(item: String): String?

        suspend fun size(): Int = map { it.length }
    }

    class TextBoxActor : TextBox {
        private var content: String? = null

        override suspend fun put(item: String): String? = content.also { content = item }

        override suspend fun <R> map(change: (String) -> R): R = change(content!!)
    }

    @Test
    fun genericAndInheritedFunctions_work() {
        val box = test.spawn<TextBox> { TextBoxActor() }
        assertThat(value { box.put("a") }).isNull()
        assertThat(value { (box as Box<String>).put("bcd") }).isEqualTo("a")
        assertThat(value { box.map { it.uppercase() } }).isEqualTo("BCD")
        assertThat(value { box.size() }).isEqualTo(3)
        val plain = test.spawn<Box<Int>> {
            object : Box<Int> {
                override suspend fun put(item: Int): Int? = item + 1

                override suspend fun <R> map(change: (Int) -> R): R = change(7)
            }
        }
        assertThat(value { plain.put(3) }).isEqualTo(4)
    }

    interface Broadcaster {
        suspend fun channel(): Callback<Int>
    }

    @Test
    fun callbackAsAResult_isRejected() {
        assertThatThrownBy { test.spawn<Broadcaster> { throw AssertionError() } }
            .isInstanceOf(ActorTypeException::class.java)
            .hasMessageContainingAll("Broadcaster.channel()", "answers io.troupe.actor.Callback<java.lang.Integer>")
    }

    @JvmInline value class Name(val text: String)

    @JvmInline value class Degrees(val number: Int)

    interface Named {
        suspend fun rename(name: Name, degrees: Degrees, maybe: Name?): String

        fun tell(name: Name)

        fun ask(name: Name): Promise<Name>

        suspend fun nowDegrees(): Degrees

        suspend fun laterDegrees(): Degrees?

        suspend fun unsigned(number: UInt): ULong
    }

    @Test
    fun valueClasses_areTheSameAfterACall() {
        val named = test.spawn<Named> {
            object : Named {
                override suspend fun rename(name: Name, degrees: Degrees, maybe: Name?) = "$name $degrees $maybe"

                override fun tell(name: Name) {
                    log += name.toString()
                }

                override fun ask(name: Name): Promise<Name> = Promise.of(name)

                override suspend fun nowDegrees() = Degrees(1)

                override suspend fun laterDegrees(): Degrees? {
                    yield()
                    return Degrees(2)
                }

                override suspend fun unsigned(number: UInt): ULong = number.toULong()
            }
        }
        assertThat(value { named.rename(Name("a"), Degrees(3), null) })
            .isEqualTo("Name(text=a) Degrees(number=3) null")
        named.tell(Name("b"))
        assertThat(test.get(named.ask(Name("c"))).text).isEqualTo("c")
        assertThat(log).containsExactly("Name(text=b)")
        assertThat(value { named.nowDegrees().number }).isEqualTo(1)
        assertThat(value { named.laterDegrees()?.number }).isEqualTo(2)
        assertThat(value { named.unsigned(4u) == 4uL }).isTrue()
    }

    interface NamedNow {
        suspend fun now(): Name
    }

    interface Attempt {
        suspend fun attempt(): Result<String>
    }

    @Test
    fun valueClassAroundAReference_cannotBeReturned() {
        assertThatThrownBy { test.spawn<NamedNow> { throw AssertionError() } }
            .isInstanceOf(ActorTypeException::class.java)
            .hasMessageContainingAll("NamedNow.now(", "Test\$Name, a value class", "return what it holds")
        assertThatThrownBy { test.spawn<Attempt> { throw AssertionError() } }
            .isInstanceOf(ActorTypeException::class.java)
            .hasMessageContainingAll("Attempt.attempt", "kotlin.Result<java.lang.String>")
    }

    interface Motor {
        fun stop()

        fun release()

        suspend fun after(millis: Long): String

        suspend fun started(times: Int): String
    }

    private inner class GearMotor : Actor(), Motor {
        override fun started() {
            context().hold()
            context().after(Duration.ofSeconds(1)) { release() }
        }

        override fun stop() {
            log += "stop"
            context().stop()
        }

        override fun release() {
            log += "release"
            context().release()
        }

        override suspend fun after(millis: Long): String {
            delay(millis)
            return "after $millis in ${context().space()}"
        }

        override suspend fun started(times: Int) = "started $times"

        override fun stopped() {
            log += "the end"
        }
    }

    @Test
    fun namesOfTheContext_areMessages_andTheContextWorksBesideThem() {
        val motor = test.spawn<Motor> { GearMotor() }
        val later = run { motor.after(10) }
        assertThat(later.isDone).isFalse()
        advance(1_000)
        advance(10)
        assertThat(test.get(later)).isEqualTo("after 10 in test-space")
        assertThat(value { motor.started(2) }).isEqualTo("started 2")
        motor.stop()
        test.runQueued()
        assertThat(log).containsExactly("release", "stop", "the end")
    }

    interface Race {
        fun started()
    }

    private inner class Runner : Actor(), Race {
        public override fun started() {
            log += "hook or message?"
        }
    }

    open class PublicStart : Actor() {
        public override fun started() = Unit
    }

    @Test
    fun messageThatIsAHookToo_isRefusedByName() {
        test.spawn<Race> { Runner() }
        val problem = test.takeProblems().single()
        assertThat(problem.error)
            .isInstanceOf(ActorTypeException::class.java)
            .hasMessageContainingAll("Race.started()", "Runner also the hook Actor.started()", "another name")
        assertThatThrownBy { test.spawn<PublicStart> { PublicStart() } }
            .isInstanceOf(ActorTypeException::class.java)
            .hasMessageContainingAll("PublicStart.started()", "make it protected")
        assertThat(log).isEmpty()
    }
}
