package io.troupe.actor.kotlin.guide

import io.troupe.actor.Actor
import io.troupe.actor.kotlin.actorScope
import io.troupe.actor.kotlin.coAwait
import io.troupe.services.subsumption.Arbitrator.StateListener
import io.troupe.services.subsumption.LeasedRobots
import io.troupe.services.subsumption.SubsumptionTable
import kotlinx.coroutines.CompletableDeferred
import kotlinx.coroutines.coroutineScope
import kotlinx.coroutines.launch

/** The main code of the paper in promise mode, Figure 20, with states 2 and 3, which the paper does not print. */
open class Demo3(private val robots: LeasedRobots, private val log: StateListener) : Actor() {
    private var color2 = 255

    open fun live() {
        actorScope().launch {
            var seenBy: Int? = null
            while (true) {
                log.stateStarted(SubsumptionTable.ofThePaper().state(color2).get(), seenBy)
                seenBy = when (color2) {
                    255 -> drive("wallFollower", "spaceWanderer")
                    16711680 -> drive("spaceWanderer", "wallFollower")
                    else -> drive("spaceWanderer", "spaceWanderer")
                }
            }
        }
    }

    /** Runs a service on each robot until one of them sees the colour of another state; returns that robot. */
    private suspend fun drive(vararg services: String): Int = coroutineScope {
        val seenBy = CompletableDeferred<Int>()
        services.forEachIndexed { robot, service ->
            launch {
                robots.drive(robot, service, color2).coAwait().ifPresent { color ->
                    log.colourReceived(robot, color)
                    if (seenBy.complete(robot)) color2 = color else log.colourTooLate(robot, color)
                }
            }
        }
        seenBy.await().also { services.indices.forEach { robot -> robots.stop(robot).coAwait() } }
    }
}
