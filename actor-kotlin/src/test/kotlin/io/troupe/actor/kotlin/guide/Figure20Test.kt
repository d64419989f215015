package io.troupe.actor.kotlin.guide

import io.troupe.actor.ActorSpace
import io.troupe.actor.SpaceSettings
import io.troupe.actor.kotlin.spawn
import io.troupe.services.subsumption.LeasedRobots
import io.troupe.services.subsumption.RobotServices
import io.troupe.services.subsumption.RobotServicesActor
import io.troupe.services.subsumption.SubsumptionTable
import io.troupe.sim.Simulation
import io.troupe.sim.WorldSettings
import io.troupe.sim.worldfile.ScenarioReader
import io.troupe.view.RecordedRun
import io.troupe.view.RunLog
import io.troupe.view.RunRecorder
import java.nio.file.Path
import kotlin.io.path.readLines
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.ValueSource

/** The paper's main code in Kotlin drives its robots as the main job in Java does: the logs are equal byte for byte. */
@Timeout(180)
class Figure20Test {
    private val scenario = ScenarioReader.read(Path.of("..", "demo", "worlds", "paper-arena.world"))
    private val table = SubsumptionTable.ofThePaper()

    @TempDir lateinit var folder: Path

    @ParameterizedTest
    @ValueSource(longs = [1, 7])
    fun demo3_writesTheLogOfTheMainJob(seed: Long) {
        val settings = RecordedRun.Settings.defaults().withSeed(seed).withSeconds(300.0)
        val inJava = folder.resolve("java.jsonl")
        RecordedRun(scenario, table, settings).run(inJava)
        val inKotlin = folder.resolve("kotlin.jsonl")
        RunLog(inKotlin).use { log -> drive(log, settings) }
        assertThat(inJava.readLines()).filteredOn { "\"state\"" in it }.hasSizeGreaterThan(4)
        assertThat(inKotlin).hasSameBinaryContentAs(inJava)
    }

    private fun drive(log: RunLog, settings: RecordedRun.Settings) {
        val problems = mutableListOf<Throwable>()
        val world = WorldSettings.defaults().withSeed(settings.seed()).withJitter(0.02, StrictMath.toRadians(2.0))
        Simulation.open(scenario, world).use { simulation ->
            log.begin(scenario.world(), settings)
            val recorder = RunRecorder(scenario.world(), table, log) { }
            val onSpace = SpaceSettings.named("robots")
                .withClock(simulation.clock())
                .withoutThread()
                .withOnError { _, error -> problems += error }
            ActorSpace.create(onSpace).use { space ->
                simulation.whileWaiting(space::runQueued)
                val observed = RobotServicesActor.Settings.defaults().withObserver(recorder)
                val robots = space.spawn<RobotServices> { RobotServicesActor(observed) }
                space.spawn<Demo3> { Demo3(LeasedRobots.of(robots), recorder) }.live()
                space.runQueued()
                recorder.start(simulation.latest())
                while (simulation.timeMicros() < 300_000_000) {
                    recorder.record(simulation.tick())
                }
                recorder.finish(false)
            }
        }
        assertThat(problems).isEmpty()
    }
}
