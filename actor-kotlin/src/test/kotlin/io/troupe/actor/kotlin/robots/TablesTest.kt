package io.troupe.actor.kotlin.robots

import io.troupe.common.text.NamedColours
import io.troupe.services.behaviour.Avoid
import io.troupe.services.behaviour.RobotPose
import io.troupe.services.behaviour.Senses
import io.troupe.services.behaviour.SonarRing
import io.troupe.services.behaviour.Velocity
import io.troupe.services.subsumption.Assignment
import io.troupe.services.subsumption.Assignment.everyRobot
import io.troupe.services.subsumption.Service
import io.troupe.services.subsumption.Service.SPACE_WANDERER
import io.troupe.services.subsumption.Service.WALL_FOLLOWER
import io.troupe.services.subsumption.SubsumptionTable
import kotlin.time.Duration.Companion.seconds
import org.assertj.core.api.Assertions.assertThat
import org.assertj.core.api.Assertions.assertThatThrownBy
import org.junit.jupiter.api.Test

/** Tables and behaviours as Kotlin writes them: equal to those of the builder. */
class TablesTest {
    private val avoid = Service("avoid", false) { Avoid.DEFAULT.behaviour() }

    @Test
    fun table_equalsThatOfTheBuilder() {
        val table = subsumptionTable(robots = 9) {
            ignoring(NamedColours.BLACK, "walls")
            hold(2.seconds)
            state(NamedColours.BLUE, everyRobot(SPACE_WANDERER).robots(3..5, WALL_FOLLOWER))
            state(NamedColours.RED, everyRobot(avoid.over(SPACE_WANDERER)), priority = 1)
        }
        val built = SubsumptionTable.forRobots(9)
            .ignoring(NamedColours.BLACK, "walls")
            .`when`(NamedColours.BLUE, Assignment.everyRobot(SPACE_WANDERER).robots(3, 5, WALL_FOLLOWER))
            .`when`(NamedColours.RED, Assignment.everyRobot(avoid.over(SPACE_WANDERER)))
            .priority(NamedColours.RED, 1)
            .hold(2.0)
            .build()
        assertThat(table).isEqualTo(built)
    }

    @Test
    fun tableOfThePaper_isThreeLines() {
        val table = subsumptionTable(robots = 2) {
            ignoring(NamedColours.BLACK, "walls and robot 2")
            ignoring(NamedColours.ORANGE, "robot 1")
            state(NamedColours.BLUE, WALL_FOLLOWER, SPACE_WANDERER)
            state(NamedColours.RED, SPACE_WANDERER, WALL_FOLLOWER)
            state(NamedColours.GREEN, SPACE_WANDERER, SPACE_WANDERER)
        }
        assertThat(table).isEqualTo(SubsumptionTable.ofThePaper())
    }

    @Test
    fun badTable_isRefusedWithTheMessageOfTheBuilder() {
        assertThatThrownBy { subsumptionTable(robots = 2) { state(NamedColours.BLUE, SPACE_WANDERER) } }
            .hasMessageContaining("names 1 services, expected one for each of 2 robots")
        assertThatThrownBy { subsumptionTable(robots = 1) { hold((-1).seconds) } }
            .hasMessageContaining("a state is held for -1.0 s, expected 0 or more")
    }

    private fun spin() = Service("spin", true) {
        var began = Double.NaN
        behaviour { senses ->
            if (began.isNaN()) began = senses.timeSeconds
            if (senses.timeSeconds - began > 5) null else Velocity(0.0, 0.5)
        }
    }

    @Test
    fun behaviour_hasAMemoryForEachRobot_andLeavesTheRobotWithNull() {
        val service = spin()
        val one = service.behaviour().get()
        val other = service.behaviour().get()

        fun at(seconds: Double) = Senses(seconds, SonarRing.of(FloatArray(16) { 5f }), RobotPose(0.0, 0.0, 0.0))
        assertThat(one.step(at(1.0))).contains(Velocity(0.0, 0.5))
        assertThat(one.step(at(6.1))).isEmpty()
        assertThat(other.step(at(6.1))).contains(Velocity(0.0, 0.5))
    }
}
