package io.troupe.actor.kotlin.guide

import io.troupe.common.text.NamedColours
import io.troupe.services.behaviour.Avoid
import io.troupe.services.behaviour.Behaviour
import io.troupe.services.behaviour.RobotPose
import io.troupe.services.behaviour.Senses
import io.troupe.services.behaviour.SonarRing
import io.troupe.services.behaviour.Velocity
import io.troupe.services.subsumption.Assignment.everyRobot
import io.troupe.services.subsumption.Service
import io.troupe.services.subsumption.Service.SPACE_WANDERER
import io.troupe.services.subsumption.Service.WALL_FOLLOWER
import io.troupe.services.subsumption.SubsumptionTable
import java.util.Optional
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** Tables and behaviours in Kotlin, which needs no functions for them. */
class TablesTest {
    private val avoid = Service("avoid", false) { Avoid.DEFAULT.behaviour() }

    @Test
    fun table_isBuiltAsInJava() {
        val table = SubsumptionTable.forRobots(9)
            .ignoring(NamedColours.BLACK, "walls")
            .holdSeconds(2.0)
            .state(NamedColours.BLUE, everyRobot(SPACE_WANDERER).robots(3, 5, WALL_FOLLOWER))
            .state(NamedColours.RED, everyRobot(avoid.over(SPACE_WANDERER)))
            .priority(NamedColours.RED, 1)
            .build()
        assertThat(table.states()).hasSize(2)
        assertThat(table.first().services()[2]).isEqualTo(WALL_FOLLOWER)
    }

    private fun spin() = Service("spin", true) {
        var began = Double.NaN
        Behaviour { senses ->
            if (began.isNaN()) began = senses.timeSeconds
            if (senses.timeSeconds - began > 5) Optional.empty() else Optional.of(Velocity(0.0, 0.5))
        }
    }

    @Test
    fun behaviour_hasAMemoryForEachRobot() {
        val service = spin()
        val one = service.behaviour().get()
        val other = service.behaviour().get()

        fun at(seconds: Double) = Senses(seconds, SonarRing.of(FloatArray(16) { 5f }), RobotPose(0.0, 0.0, 0.0))
        assertThat(one.step(at(1.0))).contains(Velocity(0.0, 0.5))
        assertThat(one.step(at(6.1))).isEmpty()
        assertThat(other.step(at(6.1))).contains(Velocity(0.0, 0.5))
    }
}
