package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.MissingServiceException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The samples of the Javadoc about the main job over hosts, with provider and arbitrator in one process. */
@Timeout(300)
class HostedSamplesTest {
    private static final Duration A_MOMENT = Duration.ofMillis(100);

    private final ActorSpace space = ActorSpace.create(SpaceSettings.named("broker"));
    private final ActorSpace driving = ActorSpace.create(SpaceSettings.named("robots"));
    private final Bus bus = Bus.inProcess("host", BusSettings.on(space));
    private final TestSpace unused = new TestSpace();
    private final FakeRobots robots = new FakeRobots(unused, 2);
    private final int port = FakeRobots.PORT;
    private final CountDownLatch driven = new CountDownLatch(2);
    private final List<String> states = Collections.synchronizedList(new ArrayList<>());
    private final AtomicLong stateNanos = new AtomicLong();

    private final SubsumptionRun.HostsListener listener = new SubsumptionRun.HostsListener() {
        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            stateNanos.set(System.nanoTime());
            states.add("state " + state.number());
        }

        @Override
        public void reported(DriverReport report, String node) {
            if (report.event() == DriverReport.Event.STARTED) {
                states.add(node + " " + report.robotIndex() + " " + report.service());
                driven.countDown();
            }
        }
    };

    @AfterEach
    void close() {
        bus.close();
        driving.close();
        space.close();
        robots.close();
        unused.close();
    }

    private boolean goesOn() throws InterruptedException {
        robots.tick(100);
        return !driven.await(20, TimeUnit.MILLISECONDS); // the clients are on other threads, and need not keep up
    }

    @Test
    void node_offersServices_andRunsTheArbitrator() throws Exception {
        var node = RobotNode.open(bus, space, BrokerObserver.logging(), 0);
        var robots = RobotServicesActor.Settings.defaults().withPort(port);
        var offer = node.offer(driving, robots, List.of("wallFollower", "spaceWanderer"));
        offer.published().get(Duration.ofMinutes(1));
        long beginNanos = System.nanoTime();
        try (var run = SubsumptionRun.overHosts(node, Mode.PROMISE, SubsumptionTable.ofThePaper(), listener)) {
            while (goesOn()) {
                run.check();
            }
        }
        assertThat(stateNanos.get() - beginNanos)
                .as("the leases of an earlier arbitrator are over")
                .isGreaterThanOrEqualTo(LeasedRobots.CERTAINLY_OVER.toNanos());
        assertThat(states).startsWith("state 1").contains("host 0 wallFollower", "host 1 spaceWanderer");
        offer.withdraw().get(Duration.ofMinutes(1));
        node.close();
    }

    /** Its node answers when the other one has been known for long. */
    @Test
    void providerWithTheLeastRank_isChosen_howeverLateItIsHeardOf() throws Exception {
        var hosts = new HostsPipe(space);
        var settings = BusSettings.on(space).withObserver(loss -> {});
        List<String> both = List.of("wallFollower", "spaceWanderer");
        var robots = RobotServicesActor.Settings.defaults().withPort(port);
        try (var arbitrator = hosts.open("arbitrator", settings);
                var early = hosts.open("a", settings);
                var late = hosts.open("b", settings);
                var second = RobotNode.open(early, space, BrokerObserver.logging(), 1);
                var first = RobotNode.open(late, space, BrokerObserver.logging(), 0)) {
            second.offer(driving, robots, both).published().get(Duration.ofMinutes(1));
            first.offer(driving, robots, both).published().get(Duration.ofMinutes(1));
            hosts.lose("b");
            try (var node = RobotNode.open(arbitrator, space, BrokerObserver.logging(), 0)) {
                while (node.actors().offers(A_MOMENT).get(Duration.ofMinutes(1)).isEmpty()) {
                    // asks again
                }
                hosts.loseNoMore("b"); // it publishes its offers each second
                try (var run = SubsumptionRun.overHosts(node, Mode.PROMISE, SubsumptionTable.ofThePaper(), listener)) {
                    while (goesOn()) {
                        run.check();
                    }
                }
            }
        }
        assertThat(states).contains("b 0 wallFollower", "b 1 spaceWanderer");
    }

    @Test
    void serviceThatNoNodeOffers_isNamed() throws Exception {
        var node = RobotNode.open(bus, space, BrokerObserver.logging(), 0);
        assertThatMissing(() -> SubsumptionRun.overHosts(node, Mode.CALLBACK, SubsumptionTable.ofThePaper(), listener));
        node.close();
    }

    private interface Start {
        SubsumptionRun run() throws InterruptedException;
    }

    private static void assertThatMissing(Start start) throws InterruptedException {
        try (var run = start.run()) {
            run.check();
            throw new AssertionError("it was started");
        } catch (MissingServiceException missing) {
            assertThat(missing)
                    .hasMessage("\"arbitrator\" needs the capability \"wallFollower\", which no provider offers;"
                            + " registered: nothing");
        }
    }
}
