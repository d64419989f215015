package greeter

import io.troupe.actor.Actor
import io.troupe.actor.ActorSpace
import io.troupe.actor.Callback
import io.troupe.actor.Promise

/** An actor type as Kotlin code writes it: Unit is void, the companion and the default arguments stay where they are called. */
interface Greeter {
    fun greet(name: String, times: Int = 2): Promise<String>

    fun greetOrNot(name: String?): Promise<String?>

    fun add(micros: Long, more: Long?): Promise<Long>

    fun count(limit: Int, numbers: Callback<Int>)

    fun forget()

    fun `turn left`(by: Double)

    fun greetAll(vararg names: String): Promise<List<String>> = greet(names.joinToString(" and ")).thenApply { listOf(it) }

    val turned: Promise<Double>

    companion object {
        const val LIMIT = 3

        fun spawnIn(space: ActorSpace): Greeter = space.spawn(Greeter::class.java) { Polite() }
    }
}

internal class Polite : Greeter {
    private var sum = 0L
    private var angle = 0.0

    override fun greet(name: String, times: Int): Promise<String> = Promise.of("hello ".repeat(times) + name)

    override fun greetOrNot(name: String?): Promise<String?> = Promise.of(name?.let { "hello $it" })

    override fun add(micros: Long, more: Long?): Promise<Long> {
        sum += micros + (more ?: 0L)
        return Promise.of(sum)
    }

    override fun count(limit: Int, numbers: Callback<Int>) {
        for (number in 1..limit) numbers.next(number)
        numbers.finish()
    }

    override fun forget() {
        sum = 0
    }

    override fun `turn left`(by: Double) {
        angle += by
    }

    override val turned: Promise<Double>
        get() = Promise.of(angle)
}

/** A class actor: open, because its proxy is a subclass. */
open class Counter(private val step: Int) : Actor() {
    private var count = 0

    override fun started() {
        count = 100
    }

    open fun increment() {
        count += step
        check(self<Counter>() !== this)
    }

    open fun count(): Promise<Int> = Promise.of(count)
}

/** Class actors that Kotlin's defaults make impossible. */
class Closed : Actor()

open class HalfClosed : Actor() {
    fun fixed() {}
}

interface ManyCallbacks {
    fun listen(vararg all: Callback<Int>)
}

/** The callers' side. */
object Callers {
    @JvmStatic
    fun callAll(greeter: Greeter, log: MutableList<String>) {
        greeter.greet("Ann").then { text -> log.add(text) }
        greeter.greet(name = "Bob", times = 1).then { text, error -> log.add("$text $error") }
        greeter.greetOrNot(null).then { text -> log.add("$text") }
        greeter.add(5_000_000_000L, null).then { sum -> log.add("${sum + 1}") }
        greeter.forget()
        greeter.add(1, 2).thenApply { it * 2 }.thenCompose { greeter.add(it, 0L) }.then { sum -> log.add("$sum") }
        greeter.count(Greeter.LIMIT) { number, error -> log.add("number $number $error") }
        greeter.`turn left`(0.5)
        greeter.turned.then { angle -> log.add("$angle") }
        greeter.greetAll("Cid", "Dan").then { all -> log.add(all.first()) }
    }

    @JvmStatic
    fun spawnCounter(space: ActorSpace): Counter = space.spawn(Counter::class.java) { Counter(5) }
}
