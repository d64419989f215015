package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(120)
class CrowdMessagesTest {
    private static final int TICKS = 10;

    /** Messages served by the actor space per robot and tick. */
    private static double servedPerRobot(int robots) throws InterruptedException {
        var table = CrowdTable.of(robots, CrowdWorld.colours(8), 3, CrowdTable.HOLD_SECONDS, CornerStyle.FORWARD);
        try (var simulation = Simulation.open(CrowdWorld.scenario(robots, 8), WorldSettings.DEFAULT);
                var space = ActorSpace.create(SpaceSettings.named("crowd").withClock(simulation.clock()))) {
            var settings = RobotServicesActor.Settings.ofThePaper().withTable(table);
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, services, table, (state, seenBy) -> {}));
            arbitrator.live();
            var begun = new java.util.concurrent.CountDownLatch(1);
            space.onIdle(begun::countDown);
            begun.await();
            simulation.tick(); // reaches the initial state and an idle space
            long before = space.metrics().served();
            for (int tick = 0; tick < TICKS; tick++) {
                simulation.tick();
            }
            return (double) (space.metrics().served() - before) / TICKS / robots;
        }
    }

    @Test
    void messagesOfATick_growAsTheCrowdDoes() throws Exception {
        double few = servedPerRobot(50);
        assertThat(few).isPositive();
        assertThat(servedPerRobot(500)).isCloseTo(few, within(few / 10));
    }
}
