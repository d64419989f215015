package io.troupe.actor.kotlin.guide

import io.troupe.actor.ActorSettings
import io.troupe.actor.CallObserver
import io.troupe.actor.kotlin.guide.GuideTest.Bank
import io.troupe.actor.kotlin.guide.GuideTest.Purse
import io.troupe.actor.kotlin.guide.GuideTest.PurseActor
import io.troupe.actor.kotlin.promise
import io.troupe.actor.kotlin.scope
import io.troupe.actor.kotlin.spawn
import io.troupe.actor.testkit.RingFinder
import io.troupe.actor.testkit.TestSpace
import io.troupe.petri.testkit.FollowedActors
import io.troupe.petri.wiring.Protocol
import io.troupe.petri.wiring.Wiring
import io.troupe.petri.wiring.WiringCheck
import io.troupe.petri.wiring.WiringMonitor
import io.troupe.petri.wiring.WiringObserver
import io.troupe.petri.wiring.WiringRecorder
import io.troupe.petri.wiring.WiringResult.Proved
import java.nio.file.Files
import java.nio.file.Path
import java.time.Duration
import kotlin.reflect.KFunction
import kotlinx.coroutines.delay
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.extension.RegisterExtension

/** The bank and the purse of the guide, recorded; and what a lock makes of them. */
class RecordedTest {
    private class SlowBank : Bank {
        override suspend fun confirm(amount: Int) = delay(10)
    }

    /** Two payments, the second of which waits for the lock and is refused. */
    private fun run(observer: CallObserver, bank: Bank = SlowBank(), pay: suspend (Purse) -> Unit = ::payTwice) {
        val test = TestSpace(observer)
        val theBank = test.spawn<Bank>(ActorSettings.named("bank")) { bank }
        val purse = test.spawn<Purse>(ActorSettings.named("purse")) { PurseActor(theBank) }
        (bank as? AskingBank)?.purse = purse
        test.space().scope.promise { pay(purse) }
        repeat(5) { test.advance(Duration.ofMillis(10)) }
        if (observer is RingFinder) observer.idle()
        test.takeProblems()
        test.space().close()
    }

    private suspend fun payTwice(purse: Purse) {
        purse.paySafely(70)
        purse.paySafely(70)
    }

    private fun monitor(): WiringMonitor {
        val wiring = PurseWiring.wiring()
        return WiringMonitor.of(wiring).observing(WiringObserver.stepsFromOutside(wiring))
    }

    @Test
    fun recordedPurse_isProved_andIsTheSourceBesideThisTest() {
        val recorder = WiringRecorder("purse")
        run(recorder)
        assertThat(recorder.problems()).isEmpty()
        assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(Proved::class.java)
        val source = Path.of("src/test/kotlin/io/troupe/actor/kotlin/guide/PurseWiring.kt")
        assertThat(recorder.kotlin("io.troupe.actor.kotlin.guide", "PurseWiring")).isEqualTo(Files.readString(source))
    }

    @Test
    fun compiledSource_acceptsItsRun_andNoOther() {
        val same = monitor()
        run(WiringObserver(same))
        same.idle()
        same.check()
        assertThat(same.count()).isEqualTo(7)

        val content = monitor() // another function of the purse
        run(WiringObserver(content)) { it.pay(70) }
        assertThat(content.violation().orElseThrow().problem())
            .startsWith("purse asks bank.confirm is not allowed: purse is in \"idle\"")

        val asking = monitor() // another bank
        run(WiringObserver(asking), AskingBank())
        assertThat(asking.violation().orElseThrow().problem()).startsWith("bank asks purse.paySafely is not allowed")
    }

    /** The rule of the guide: two functions that lock a mutex and call each other wait for ever. */
    @Test
    fun mutexThatIsLockedAgainThroughAnotherActor_isARing() {
        val rings = RingFinder()
        run(rings, AskingBank())
        assertThat(rings.rings()).singleElement().hasToString(
            """
            purse is called while it waits for that call: a ring that blocks purse, bank
              - purse serves paySafely, which waits for bank.confirm
              - bank serves confirm, which waits for purse.paySafely, which that has begun and does not answer
            """.trimIndent(),
        )
    }

    @Test
    fun sameCallsWithoutTheMutex_pass() {
        val rings = RingFinder()
        run(rings, object : Bank {
            override suspend fun confirm(amount: Int) = delay(10)
        })
        assertThat(rings.rings()).isEmpty()
    }

    // ---- names that the compiler checks

    private inline fun <reified A> protocol(name: String) = Protocol.of(name, A::class.java)

    private fun provides(call: KFunction<*>) = Protocol.provides(call.name)

    private fun requests(component: String, call: KFunction<*>) = Protocol.requests("$component.${call.name}")

    @Test
    fun functionReferences_areWords() {
        val wiring = Wiring.of("purse")
            .component(protocol<Bank>("bank").state("open", provides(Bank::confirm).then("open")).build())
            .component(protocol<Purse>("purse").state("idle", requests("bank", Bank::confirm).then("idle")).build())
            .build()
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved::class.java)
    }

    @JvmField @RegisterExtension val actors: FollowedActors = FollowedActors.forRings()

    @Test
    fun purse_isPaid() {
        val test = actors.testSpace()
        val bank = test.spawn<Bank> { SlowBank() }
        val purse = test.spawn<Purse> { PurseActor(bank) }
        val paid = test.space().scope.promise { purse.paySafely(70) }
        test.advance(Duration.ofMillis(10))
        assertThat(test.get(paid)).isTrue()
    }
}

internal class AskingBank : Bank {
    lateinit var purse: Purse

    override suspend fun confirm(amount: Int) {
        purse.paySafely(amount)
    }
}
