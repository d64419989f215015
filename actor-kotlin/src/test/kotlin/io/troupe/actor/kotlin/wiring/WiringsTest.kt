package io.troupe.actor.kotlin.wiring

import io.troupe.petri.wiring.Overflow
import io.troupe.petri.wiring.Protocol
import io.troupe.petri.wiring.Protocol.acquires
import io.troupe.petri.wiring.Protocol.answered
import io.troupe.petri.wiring.Protocol.asks
import io.troupe.petri.wiring.Protocol.cancels
import io.troupe.petri.wiring.Protocol.does
import io.troupe.petri.wiring.Protocol.emits
import io.troupe.petri.wiring.Protocol.finished
import io.troupe.petri.wiring.Protocol.finishes
import io.troupe.petri.wiring.Protocol.provides
import io.troupe.petri.wiring.Protocol.rejected
import io.troupe.petri.wiring.Protocol.rejects
import io.troupe.petri.wiring.Protocol.releases
import io.troupe.petri.wiring.Protocol.requests
import io.troupe.petri.wiring.Protocol.stops
import io.troupe.petri.wiring.Protocol.streams
import io.troupe.petri.wiring.Wiring
import io.troupe.petri.wiring.WiringCheck
import io.troupe.petri.wiring.WiringResult.Deadlock
import io.troupe.petri.wiring.WiringResult.Proved
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Wirings as Kotlin writes them: the same nets as those of the builders. */
class WiringsTest {
    @Test
    fun wiring_canDeadlock_asThatOfTheGuide() {
        val pictures = wiring("pictures") {
            component("camera") {
                state("idle") {
                    does("take a picture", then = "holding")
                    provides("pause", then = "paused")
                }
                state("holding") { requests("store.keep", then = "idle") }
                state("paused") { does("wake up", then = "idle") }
            }
            component("store") {
                state("open") { provides("keep", then = "checking") }
                state("checking") {
                    does("find room", then = "open")
                    does("find none", then = "full")
                }
                state("full") { requests("camera.pause", then = "open") }
            }
        }
        val result = WiringCheck.check(pictures)
        assertThat(result).isInstanceOf(Deadlock::class.java)
        assertThat(result.toString()).contains("camera waits for store.keep; store waits for camera.pause")
    }

    @Test
    fun wiring_hasTheNetOfTheBuilders() {
        val client = protocol("client") {
            state("idle") { does("look", then = "informed") }
            state("informed") {
                requests("planner.plan", then = "idle")
                stops()
            }
        }
        val two = wiring("two clients") {
            components("client", 2, client)
            component("planner") { state("ready") { provides("plan", then = "ready") } }
        }
        val built = Wiring.of("two clients")
            .components(
                "client",
                2,
                Protocol.of("client")
                    .`in`("idle", does("look").then("informed"))
                    .`in`("informed", requests("planner.plan").then("idle"), stops())
                    .build(),
            )
            .component(Protocol.of("planner").`in`("ready", provides("plan").then("ready")).build())
            .build()
        assertThat(two.net().toString()).isEqualTo(built.net().toString())
        assertThat(two.net()).usingRecursiveComparison().isEqualTo(built.net())
        assertThat(WiringCheck.check(two)).isInstanceOf(Proved::class.java)
    }

    @Test
    fun messagesFailuresAndRestarts_areProved() {
        val work = wiring("work") {
            component("boss") {
                state("calm") { sends("worker.go", then = "waiting", onRejection = "calm") }
                state("waiting") {
                    receives("done", then = "calm")
                    does("time out", then = "calm")
                }
            }
            component("worker") {
                state("idle") { receives("go", then = "working") }
                state("working") { sends("boss.done", then = "idle") }
                state("down") { does("restart", then = "idle") }
                failsTo("down")
            }
            mailbox("boss", 1, Overflow.DROP_OLDEST)
            mailbox("worker", 1, Overflow.REJECT)
        }
        assertThat(WiringCheck.check(work)).isInstanceOf(Proved::class.java)
    }

    /** Each function of the steps makes the step of that name. */
    @Test
    fun allSteps_areThoseOfTheBuilders() {
        val camera = protocol("camera") {
            state("idle") {
                streams("frames", then = "on")
                rejects("adjust", then = "idle")
            }
            state("on") {
                emits("frames", then = "on")
                finishes("frames", then = "idle")
                provides("adjust", then = "on")
            }
        }
        val viewer = protocol("viewer") {
            state("dark") { asks("camera.frames", then = "watching") }
            state("watching") {
                answered("camera.frames", then = "adjusting")
                finished("camera.frames", then = "dark")
                cancels("camera.frames", then = "dark")
                rejected("camera.frames", then = "dark")
            }
            state("adjusting") { requests("camera.adjust", then = "holding", "watching", onRejection = "watching") }
            state("holding") { acquires("map", then = "reading") }
            state("reading") { releases("map", then = "watching") }
        }
        val builtCamera = Protocol.of("camera")
            .`in`("idle", streams("frames").then("on"), rejects("adjust").then("idle"))
            .`in`(
                "on",
                emits("frames").then("on"),
                finishes("frames").then("idle"),
                provides("adjust").then("on"),
            )
            .build()
        val builtViewer = Protocol.of("viewer")
            .`in`("dark", asks("camera.frames").then("watching"))
            .`in`(
                "watching",
                answered("camera.frames").then("adjusting"),
                finished("camera.frames").then("dark"),
                cancels("camera.frames").then("dark"),
                rejected("camera.frames").then("dark"),
            )
            .`in`(
                "adjusting",
                requests("camera.adjust").then("holding").orTimeout("watching").orRejected("watching"),
            )
            .`in`("holding", acquires("map").then("reading"))
            .`in`("reading", releases("map").then("watching"))
            .build()
        assertThat(camera).usingRecursiveComparison().isEqualTo(builtCamera)
        assertThat(viewer).usingRecursiveComparison().isEqualTo(builtViewer)
    }

    @Test
    fun badWiring_isRefusedWithTheMessageOfTheBuilder() {
        assertThatThrownBy { protocol("idler") { state("idle") { } } }
            .hasMessageContaining("nothing leads out of state idle; expected a step or a stop")
        assertThatThrownBy { wiring("none") { component("a") { state("x") { requests("b.c", then = "x") } } } }
            .hasMessageContaining("there is no component b")
    }
}
