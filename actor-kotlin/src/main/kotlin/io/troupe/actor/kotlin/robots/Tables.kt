@file:JvmName("Tables")

package io.troupe.actor.kotlin.robots

import io.troupe.services.behaviour.Behaviour
import io.troupe.services.behaviour.Senses
import io.troupe.services.behaviour.Velocity
import io.troupe.services.subsumption.Assignment
import io.troupe.services.subsumption.Service
import io.troupe.services.subsumption.SubsumptionTable
import io.troupe.services.subsumption.SubsumptionTableBuilder
import java.util.Optional
import kotlin.time.Duration
import kotlin.time.DurationUnit

/**
 * A control law, called by one thread at a time; it returns null where it leaves the robot to the layer below it.
 *
 * ```
 * fun spin() = Service("spin", true) {
 *     var began = Double.NaN
 *     behaviour { senses ->
 *         if (began.isNaN()) began = senses.timeSeconds
 *         if (senses.timeSeconds - began > 5) null else Velocity(0.0, 0.5)
 *     }
 * }
 * ```
 */
public fun behaviour(step: (Senses) -> Velocity?): Behaviour = Behaviour { Optional.ofNullable(step(it)) }

/**
 * Builds a table of states. The functions of the builder are at hand, and [state] in place of `when`, which is a
 * keyword of Kotlin.
 *
 * ```
 * val table = subsumptionTable(robots = 9) {
 *     ignoring(NamedColours.BLACK, "walls")
 *     hold(2.seconds)
 *     state(NamedColours.BLUE, everyRobot(SPACE_WANDERER).robots(3..5, WALL_FOLLOWER))
 *     state(NamedColours.RED, everyRobot(avoid.over(SPACE_WANDERER)), priority = 1)
 * }
 * ```
 *
 * @throws IllegalStateException if the table is incomplete or contradictory
 */
public fun subsumptionTable(robots: Int, declare: SubsumptionTableBuilder.() -> Unit): SubsumptionTable =
    SubsumptionTable.forRobots(robots).apply(declare).build()

/**
 * Adds the next state, with one service for each robot in order; [priority] is that of its colour.
 *
 * @throws IllegalArgumentException if the colour has a state already, or there is not exactly one service per robot
 */
public fun SubsumptionTableBuilder.state(colour: Int, vararg services: Service, priority: Int = 0) {
    `when`(colour, services.asList())
    rank(colour, priority)
}

/**
 * Adds the next state, with an assignment of services by ranges of robots; [priority] is that of its colour.
 *
 * @throws IllegalArgumentException if the colour has a state already, or a robot no service
 */
public fun SubsumptionTableBuilder.state(colour: Int, services: Assignment, priority: Int = 0) {
    `when`(colour, services)
    rank(colour, priority)
}

private fun SubsumptionTableBuilder.rank(colour: Int, priority: Int) {
    if (priority != 0) {
        priority(colour, priority)
    }
}

/** Sets the minimum duration of each state, for example `hold(2.seconds)`. */
public fun SubsumptionTableBuilder.hold(atLeast: Duration) {
    hold(atLeast.toDouble(DurationUnit.SECONDS))
}

/**
 * Adds a range of robots to an assignment: `everyRobot(SPACE_WANDERER).robots(3..5, WALL_FOLLOWER)`.
 *
 * @throws IllegalArgumentException if the range is empty or begins below 1, or a robot of it has a service already
 */
public fun Assignment.robots(numbers: IntRange, service: Service): Assignment =
    robots(numbers.first, numbers.last, service)
