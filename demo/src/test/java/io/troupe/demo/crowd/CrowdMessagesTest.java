package io.troupe.demo.crowd;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(120)
class CrowdMessagesTest {
    private static final int TICKS = 10;

    /** Messages served per robot and tick by the actor space of broker, services and arbitrator. */
    private static double servedPerRobot(int robots) throws InterruptedException {
        var table = CrowdTable.of(robots, CrowdWorld.colours(8), 3, CrowdTable.HOLD_SECONDS, CornerStyle.FORWARD);
        try (var simulation = Simulation.open(CrowdWorld.scenario(robots, 8), WorldSettings.DEFAULT);
                var space = ActorSpace.create(SpaceSettings.named("crowd").withClock(simulation.clock()))) {
            var settings = RobotServicesActor.Settings.ofThePaper().withTable(table);
            var actors = new ActorServices(
                    Broker.open(space, BrokerSettings.DEFAULT), "robots", space, BrokerObserver.logging());
            actors.publish(
                    space,
                    RobotServices.class,
                    RobotServices.SERVICE,
                    List.of(),
                    () -> new RobotServicesActor(settings));
            RobotServices services = actors.connect(
                            RobotServices.class,
                            Need.ofService("arbitrator", RobotServices.SERVICE),
                            ConnectionSettings.DEFAULT.withoutAnswerLimit())
                    .actor();
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, services, table, (state, seenBy) -> {}));
            arbitrator.live();
            var begun = new CountDownLatch(1);
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
