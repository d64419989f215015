package io.troupe.services.component.application;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.MissingServiceException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.common.text.NamedColours;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentState;
import io.troupe.services.component.DataConversion;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.BehaviourComponent;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.services.component.kinds.RobotTopics;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.subsumption.FakeRobots;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class ApplicationTest {
    private static final DeviceCommand.Velocity STOP = new DeviceCommand.Velocity(0, 0, 0, true);
    private static final DeviceCommand.Velocity FOLLOWER_AHEAD = new DeviceCommand.Velocity(0.2, 0, 0, true);
    private static final DeviceCommand.Velocity WANDERER_AHEAD = new DeviceCommand.Velocity(0.5, 0, 0, true);
    private static final String TWO_ROBOTS = """
            application two-robots
            component robots   is player port=7001 robots=1,2
            component follower is wallFollower
            component wanderer is spaceWanderer
            component idle     is spaceWanderer service=idling
            two-robots needs service player
            robot1 needs service wallFollower
            robot2 needs capability wanders
            """;

    private static final String ONE_ROBOT = TWO_ROBOTS.replace("robot1 needs service wallFollower\n", "");

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final RecordingObserver notes = new RecordingObserver();
    private final List<String> events = new ArrayList<>();
    private Application application;
    private Bus bus;

    @AfterEach
    void nothingIsLeft() {
        test.get(application.stop().handle((ended, error) -> true));
        test.crank();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        test.close();
    }

    private static ApplicationPlan plan(String text) {
        return ApplicationReader.parse(text, Path.of("test.app"), ComponentKinds.standard(), Map.of());
    }

    private void start(ApplicationPlan plan) {
        test.run(() -> {
            bus = Bus.inProcess("here", BusSettings.on(test.space()));
            application = Application.start(
                    plan,
                    bus,
                    Broker.open(test.space(), BrokerSettings.DEFAULT.withObserver(event -> {})),
                    ApplicationSettings.DEFAULT.withObservers(notes, this::note));
            application.started().handle((runs, error) -> error); // handled here; the test reads the result later
        });
    }

    private void note(ApplicationEvent event) {
        switch (event) {
            case ApplicationEvent.Connected it ->
                events.add(it.need().by() + " uses " + it.provider().provider().name() + " " + it.wires());
            case ApplicationEvent.Lost it -> events.add(it.need().by() + " has lost its provider");
            case ApplicationEvent.Forwarded it -> {}
            case ApplicationEvent.Replaced it ->
                events.add(it.what().by() + " in the place of " + it.what().old());
            case ApplicationEvent.NotReplaced it ->
                events.add("not replaced: " + it.why().getMessage());
        }
    }

    private ComponentState state(String component) {
        return application.componentInterface(component).state();
    }

    @Test
    void paperRobots_areDrivenByTheServicesThatTheBrokerStarts_andOnlyThose() {
        start(plan(TWO_ROBOTS));
        test.get(application.started().thenApply(runs -> true));
        assertThat(events)
                .containsExactly(
                        "two-robots uses robots []",
                        "robot1 uses follower [robot1/position -> follower/position, robot1/sonar -> follower/sonar,"
                                + " follower/velocity -> robot1/velocity]",
                        "robot2 uses wanderer [robot2/position -> wanderer/position, robot2/sonar -> wanderer/sonar,"
                                + " wanderer/velocity -> robot2/velocity]");
        assertThat(state("idle")).isEqualTo(ComponentState.NOT_INVOKED);
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD);
        assertThat(robots.commands(1)).containsExactly(WANDERER_AHEAD);
    }

    @Test
    void theSameApplication_inCode() {
        var inCode = ApplicationPlan.named("two-robots");
        for (var component : plan(TWO_ROBOTS).components().entrySet()) {
            inCode = inCode.with(component.getKey(), component.getValue());
        }
        start(inCode.needing("two-robots", "player")
                .needing("robot1", "wallFollower")
                .needing("robot2", "spaceWanderer"));
        test.get(application.started().thenApply(runs -> true));
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        assertThat(robots.lastCommand(1)).isEqualTo(WANDERER_AHEAD);
    }

    @Test
    void stop_endsEverythingThatWasStarted_robotsStandStill() {
        start(plan(TWO_ROBOTS));
        test.crank();
        robots.tick(100);
        test.get(application.stop().thenApply(ended -> true));
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        assertThat(List.of(state("robots"), state("follower"), state("wanderer")))
                .containsOnly(ComponentState.TERMINATED);
    }

    @Test
    void stoppedApplication_refusesChanges() {
        start(plan(TWO_ROBOTS));
        test.get(application.started().thenApply(runs -> true));
        test.get(application.stop().thenApply(ended -> true));
        var component = BehaviourComponent.of("late", "driving", List.of(), () -> senses -> Optional.empty());
        var refusals = new ArrayList<Throwable>();
        test.run(() -> application.add("late", component).handle((added, error) -> refusals.add(error)));
        assertThat(refusals.getFirst())
                .isInstanceOf(ApplicationException.class)
                .hasMessage("two-robots has been stopped, and takes no component late");
        assertThat(test.error(application.replace("follower", "idle")))
                .isInstanceOf(ApplicationException.class)
                .hasMessage("two-robots has been stopped, and replaces nothing");
        var provider = application.componentInterface("follower");
        assertThat(test.error(provider.start())).hasMessageContaining("here/follower has left the bus");
        assertThat(provider.state()).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void missingService_endsTheApplicationCleanly_andOneLineSaysAll() {
        start(plan(TWO_ROBOTS.replace("service wallFollower", "service wallFolower")));
        var error = test.error(application.started());
        assertThat(error)
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll(
                        "robot1",
                        "wallFolower",
                        "did you mean \"wallFollower\"",
                        "registered:",
                        "player",
                        "spaceWanderer");
        assertThat(error.getMessage()).doesNotContain("\n");
        assertThat(state("robots")).isEqualTo(ComponentState.TERMINATED);
        assertThat(robots.connections()).isZero();
        assertThat(application.ended().error()).isSameAs(error);
    }

    @Test
    void twoProvidersThatWouldDriveOneRobot_endTheApplication() {
        start(plan(TWO_ROBOTS + "robot1 needs service idling\n"));
        assertThat(test.error(application.started()))
                .isInstanceOf(ApplicationException.class)
                .hasMessage("robot1/velocity would be fed twice, because robot1 needs wallFollower and because robot1"
                        + " needs idling, expected once");
        assertThat(robots.connections()).isZero();
    }

    @Test
    void declaredWireAndNeedThatWouldDriveOneRobot_endTheApplication() {
        start(plan(TWO_ROBOTS + "connect idle/velocity to robot1/velocity\n"));
        assertThat(test.error(application.started()))
                .isInstanceOf(ApplicationException.class)
                .hasMessage(
                        "robot1/velocity would be fed twice, because idle/velocity -> robot1/velocity is declared and"
                                + " because robot1 needs wallFollower, expected once");
    }

    @Test
    void needThatWouldSendValuesInACircle_endsTheApplication() {
        start(plan(TWO_ROBOTS + "connect robot1/velocity to follower/velocity\n"));
        assertThat(test.error(application.started()))
                .isInstanceOf(ApplicationException.class)
                .hasMessage(
                        "over follower/velocity -> robot1/velocity values would go round in a circle, expected wires"
                                + " that end somewhere");
    }

    @Test
    void componentThatHasTakenAPlace_isReplacedUnderThatService_evenByTheOneBefore() {
        start(plan(TWO_ROBOTS + "component relief is spaceWanderer\n"
                + "at 150ms replace follower by relief\nat 250ms replace relief by follower\n"));
        test.get(application.started().thenApply(runs -> true));
        test.advance(Duration.ofMillis(160));
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(WANDERER_AHEAD);
        test.advance(Duration.ofMillis(100));
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
        assertThat(events)
                .contains("relief in the place of follower", "follower in the place of relief")
                .noneMatch(event -> event.contains("lost"));
    }

    @Test
    void reconnectLimit_countsFromTheLossThatLasts_notFromOneBefore() {
        var dizzy = new AtomicBoolean();
        var flickering = BehaviourComponent.of("flickering", "driving", List.of(), () -> senses -> {
            if (dizzy.getAndSet(false)) {
                throw new IllegalStateException("dizzy");
            }
            return Optional.of(new Velocity(0.1, 0));
        });
        start(plan(ONE_ROBOT).with("flickering", flickering).needing("robot1", "driving"));
        test.get(application.started().thenApply(runs -> true));
        for (int loss = 1; loss <= 2; loss++) {
            dizzy.set(true);
            robots.tick(100);
            assertThat(events.getLast()).isEqualTo("robot1 has lost its provider");
            test.advance(Duration.ofMillis(900)); // the second time: 3.4 s after the first loss
            assertThat(application.ended().isDone())
                    .as("ended by loss %d", loss)
                    .isFalse();
            test.advance(Duration.ofMillis(1600));
            assertThat(events.getLast()).startsWith("robot1 uses flickering");
        }
    }

    @Test
    void providerIsReplacedWhileTheApplicationRuns_noTickIsWithoutACommand_andNothingIsLost() {
        start(plan(TWO_ROBOTS + "component other is spaceWanderer\nat 450ms replace follower by other\n"));
        test.get(application.started().thenApply(runs -> true));
        assertThat(state("other")).isEqualTo(ComponentState.NOT_INVOKED);
        for (int tick = 1; tick <= 10; tick++) {
            int commands = robots.commands(0).size();
            test.advance(Duration.ofMillis(100));
            robots.tick(100);
            assertThat(robots.commands(0).size())
                    .as("commands at tick %d", tick)
                    .isEqualTo(commands + 1);
            assertThat(robots.lastCommand(0)).as("command at tick %d", tick).isNotEqualTo(STOP);
        }
        assertThat(robots.commands(0).subList(0, 4)).containsOnly(FOLLOWER_AHEAD);
        assertThat(robots.commands(0).subList(4, 10)).containsOnly(WANDERER_AHEAD);
        assertThat(events).contains("other in the place of follower");
        assertThat(state("follower")).isEqualTo(ComponentState.TERMINATED);
        for (String component : List.of("robots", "follower", "other")) {
            var losses = application.componentInterface(component).conversion().losses();
            assertThat(losses.dropped() + losses.superseded() + losses.refused())
                    .as("lost by " + component)
                    .isZero();
        }
    }

    @Test
    void replacementThatDoesNotStart_leavesTheOldOneInUse() {
        var broken = BehaviourComponent.of("broken", "breaking", List.of(), () -> {
            throw new IllegalStateException("no law");
        });
        start(plan(TWO_ROBOTS).with("broken", broken).replacing(Duration.ofMillis(150), "follower", "broken"));
        test.get(application.started().thenApply(runs -> true));
        test.advance(Duration.ofMillis(200));
        assertThat(events.getLast()).startsWith("not replaced: ").contains("no law");
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
    }

    @Test
    void providerThatDies_isStartedAgainWithinTheReconnectLimit_andTheRobotStandsStillMeanwhile() {
        var deaths = new ArrayList<Integer>(List.of(1));
        start(plan(ONE_ROBOT).with("mortal", mortal(deaths)).needing("robot1", "dying"));
        test.get(application.started().thenApply(runs -> true));
        robots.tick(100);
        assertThat(robots.commands(0)).contains(STOP);
        assertThat(events.getLast()).isEqualTo("robot1 has lost its provider");
        test.advance(Duration.ofSeconds(2)); // the broker pauses before it restarts the provider
        assertThat(events.getLast()).startsWith("robot1 uses mortal");
        assertThat(application.ended().isDone()).isFalse();
    }

    @Test
    void providerThatStaysDead_endsTheApplication() {
        var deaths = new ArrayList<Integer>(List.of(1, 2, 3, 4, 5, 6, 7, 8, 9));
        start(plan(ONE_ROBOT).with("mortal", mortal(deaths)).needing("robot1", "dying"));
        test.get(application.started().thenApply(runs -> true));
        robots.tick(100);
        for (int step = 0; step < 50 && !application.ended().isDone(); step++) {
            test.advance(Duration.ofMillis(100));
        }
        assertThat(application.ended().error())
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("robot1", "dying", "dizzy");
        assertThat(state("robots")).isEqualTo(ComponentState.TERMINATED);
    }

    @Test
    void componentThatIsAddedOnTheFly_takesOverFromOneThatDied() {
        var deaths = new ArrayList<Integer>(List.of(1, 2, 3, 4, 5, 6, 7, 8, 9));
        start(plan(ONE_ROBOT).with("mortal", mortal(deaths)).needing("robot1", "dying"));
        test.get(application.started().thenApply(runs -> true));
        robots.tick(100);
        assertThat(events.getLast()).isEqualTo("robot1 has lost its provider");
        test.run(() -> application.add(
                "heir",
                BehaviourComponent.of("heir", "dying", List.of(), () -> senses -> Optional.of(new Velocity(0.3, 0)))));
        assertThat(events.getLast()).startsWith("robot1 uses heir [robot1/position -> heir/position");
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(new DeviceCommand.Velocity(0.3, 0, 0, true));
        test.advance(Duration.ofSeconds(10));
        assertThat(application.ended().isDone()).isFalse();
    }

    /** Subscribes to a topic and collects its values. */
    private <T extends Record> List<T> listenTo(BusTopic<T> topic) {
        List<T> heard = new ArrayList<>();
        test.run(() -> bus.attach("listener").subscribe(topic, (value, from) -> heard.add(value)));
        return heard;
    }

    @Test
    void colourFinder_seesWhatTheCameraOfItsRobotSees_andSaysEachColourOnce() {
        start(plan(TWO_ROBOTS + "component finder is colourFinder\nrobot2 needs service colourFinder\n"));
        test.get(application.started().thenApply(runs -> true));
        assertThat(events.getLast()).isEqualTo("robot2 uses finder [robot2/blobs -> finder/blobs]");
        var seen = listenTo(RobotTopics.colours("finder"));
        robots.show(0, NamedColours.GREEN); // the camera of the other robot has no effect
        robots.tick(100);
        assertThat(seen).as("walls alone").isEmpty();
        robots.show(1, NamedColours.RED);
        robots.tick(100);
        robots.tick(100);
        assertThat(seen).containsExactly(new ColourSeen(0.2, NamedColours.RED));
        robots.show(1, NamedColours.BLUE);
        robots.tick(100);
        assertThat(seen).last().isEqualTo(new ColourSeen(0.4, NamedColours.BLUE));
    }

    @Test
    void declaredWire_carriesValues_fromTheStart() {
        start(plan(TWO_ROBOTS + "connect robot1/sonar to idle/sonar\ntwo-robots needs service idling\n"));
        test.get(application.started().thenApply(runs -> true));
        var sonar = listenTo(RobotTopics.sonar("idle"));
        assertThat(state("idle")).isEqualTo(ComponentState.RUNNING);
        robots.range(0, 3, 1.25);
        robots.tick(100);
        robots.tick(100);
        assertThat(sonar).extracting(SonarReading::timeSeconds).containsExactly(0.1, 0.2);
        assertThat(sonar).extracting(reading -> reading.rangesM().get(3)).containsOnly(1.25);
        assertThat(application.componentInterface("idle").conversion().losses())
                .isEqualTo(new DataConversion.Losses(0, 0, 0));
    }

    @Test
    void declaredWire_feedsAComponentThatNobodyElseIsConnectedWith() {
        start(plan(TWO_ROBOTS + "connect robot1/sonar to idle/sonar\ntwo-robots needs service idling\n"));
        test.get(application.started().thenApply(runs -> true));
        var velocities = listenTo(RobotTopics.velocity("idle"));
        robots.tick(100);
        assertThat(velocities).containsExactly(new Velocity(0.5, 0));
        assertThat(robots.commands(0)).as("it drives nobody").containsExactly(FOLLOWER_AHEAD);
    }

    /** A driver whose first run fails at its first reading. While more than one death is left, restarts fail, too. */
    private static Component<?, ?> mortal(List<Integer> deaths) {
        var runs = new ArrayList<Integer>();
        return BehaviourComponent.of("mortal", "dying", List.of(), () -> {
            runs.add(runs.size());
            if (runs.size() > 1 && deaths.size() > 1) {
                throw new IllegalStateException("dizzy for good");
            }
            return senses -> {
                if (runs.size() == 1) {
                    throw new IllegalStateException("dizzy");
                }
                return Optional.of(new Velocity(0.1, 0));
            };
        });
    }
}
