package io.troupe.services.component.application;

import static io.troupe.services.subsumption.FakeRobots.STOP;
import static io.troupe.services.subsumption.FakeRobots.ahead;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.ServiceRecord;
import io.troupe.common.text.NamedColours;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentBench;
import io.troupe.services.component.DataConversion.Losses;
import io.troupe.services.component.ScriptedComponent;
import io.troupe.services.component.kinds.BehaviourComponent;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.services.component.kinds.PlayerComponent;
import io.troupe.services.component.kinds.RobotTopics;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.subsumption.FakeRobots;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ApplicationTest extends ComponentBench {
    private static final DeviceCommand.Velocity FOLLOWER_AHEAD = ahead(0.2);
    private static final DeviceCommand.Velocity WANDERER_AHEAD = ahead(0.5);
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

    private final FakeRobots robots = new FakeRobots(test, 2);
    private final List<String> events = new ArrayList<>();
    private final Map<String, Health> states = new HashMap<>();
    private Application application;

    @AfterEach
    void nothingIsLeft() {
        robots.close();
        test.get(application.closeAsync().handle((ended, error) -> true));
        test.runQueued();
        assertThat(robots.connections()).as("connections left open").isZero();
    }

    private static ApplicationPlan plan(String text) {
        return ApplicationReader.parse(text, Path.of("test.app"), ComponentKinds.standard(), Map.of());
    }

    private void start(ApplicationPlan plan) {
        test.run(() -> {
            var settings = ApplicationSettings.defaults()
                    .withBroker(BrokerSettings.defaults().withObserver(this::note))
                    .withComponentObserver(notes)
                    .withObserver(this::note);
            application = Application.start(plan, bus, settings);
            application.started().handle((runs, error) -> error); // handled here; the test reads the result later
        });
    }

    private void run(ApplicationPlan plan) {
        start(plan);
        test.get(application.started());
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

    private void note(BrokerEvent event) {
        switch (event) {
            case BrokerEvent.Registered(var provider) -> note(provider);
            case BrokerEvent.Starting(var provider) -> note(provider);
            case BrokerEvent.Started(var provider) -> note(provider);
            case BrokerEvent.StartFailed(var provider, var why) -> note(provider);
            case BrokerEvent.Failed(var provider, var why) -> note(provider);
            case BrokerEvent.Stopped(var provider) -> note(provider);
            case BrokerEvent.StopFailed(var provider, var why) -> note(provider);
            default -> {}
        }
    }

    private void note(ServiceRecord provider) {
        states.put(provider.provider().name(), provider.health());
    }

    /** As the broker has last reported it. */
    private Health state(String component) {
        return states.getOrDefault(component, Health.NOT_STARTED);
    }

    private Losses losses(String component) {
        return application.componentInterface(component).conversion().losses();
    }

    @Test
    void paperRobots_areDrivenByTheServicesThatTheBrokerStarts_andOnlyThose() {
        run(plan(TWO_ROBOTS));
        assertThat(events)
                .containsExactly(
                        "two-robots uses robots []",
                        "robot1 uses follower [robot1/position -> follower/position, robot1/sonar -> follower/sonar,"
                                + " follower/velocity -> robot1/velocity]",
                        "robot2 uses wanderer [robot2/position -> wanderer/position, robot2/sonar -> wanderer/sonar,"
                                + " wanderer/velocity -> robot2/velocity]");
        assertThat(state("idle")).isEqualTo(Health.NOT_STARTED);
        robots.tick(100);
        assertThat(robots.commands(0)).containsExactly(FOLLOWER_AHEAD);
        assertThat(robots.commands(1)).containsExactly(WANDERER_AHEAD);
    }

    @Test
    void stop_endsEverythingThatWasStarted_robotsStandStill_andChangesAreRefused() {
        run(plan(TWO_ROBOTS));
        robots.tick(100);
        test.get(application.closeAsync());
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        assertThat(List.of(state("robots"), state("follower"), state("wanderer")))
                .containsOnly(Health.STOPPED);
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
        assertThat(test.error(provider.newLife().start())).hasMessageContaining("here/follower has left the bus");
        assertThat(state("follower")).isEqualTo(Health.STOPPED);
    }

    @Test
    void missingService_endsTheApplicationCleanly_andOneLineSaysAll() {
        start(plan(TWO_ROBOTS.replace("service wallFollower", "service wallFolower")));
        var error = test.error(application.started());
        assertThat(error)
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("robot1", "wallFolower", "did you mean \"wallFollower\"")
                .hasMessageContainingAll("registered:", "player", "spaceWanderer");
        assertThat(error.getMessage()).doesNotContain("\n");
        assertThat(state("robots")).isEqualTo(Health.STOPPED);
        assertThat(robots.connections()).isZero();
        assertThat(application.ended().error()).isSameAs(error);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "robot1 needs service idling | robot1/velocity would be fed twice, because robot1 needs wallFollower and because robot1 needs idling, expected once",
                "connect idle/velocity to robot1/velocity | robot1/velocity would be fed twice, because idle/velocity -> robot1/velocity is declared and because robot1 needs wallFollower, expected once",
                "connect robot1/velocity to follower/velocity | the wire follower/velocity -> robot1/velocity closes a cycle, expected wires that end somewhere"
            })
    void twoThatWouldDriveOneRobot_orValuesInACircle_endTheApplication(String line, String message) {
        start(plan(TWO_ROBOTS + line + "\n"));
        assertThat(test.error(application.started()))
                .isInstanceOf(ApplicationException.class)
                .hasMessage(message);
        assertThat(robots.connections()).isZero();
    }

    // ---- replacements

    @Test
    void componentThatHasTakenAPlace_isReplacedUnderThatService_evenByTheOneBefore() {
        run(plan(TWO_ROBOTS + "component relief is spaceWanderer\n"
                + "at 150ms replace follower by relief\nat 250ms replace relief by follower\n"));
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
    void providerIsReplacedWhileTheApplicationRuns_noTickIsWithoutACommand_andNothingIsLost() {
        run(plan(TWO_ROBOTS + "component other is spaceWanderer\nat 450ms replace follower by other\n"));
        assertThat(state("other")).isEqualTo(Health.NOT_STARTED);
        for (int tick = 1; tick <= 10; tick++) {
            test.advance(Duration.ofMillis(100));
            robots.tick(100);
            assertThat(robots.commands(0)).as("commands at tick %d", tick).hasSize(tick);
        }
        assertThat(robots.commands(0).subList(0, 4)).containsOnly(FOLLOWER_AHEAD);
        assertThat(robots.commands(0).subList(4, 10)).containsOnly(WANDERER_AHEAD);
        assertThat(events).contains("other in the place of follower");
        assertThat(state("follower")).isEqualTo(Health.STOPPED);
        assertThat(List.of("robots", "follower", "other"))
                .allSatisfy(component -> assertThat(losses(component)).isEqualTo(new Losses(0, 0, 0)));
    }

    @Test
    void replacementThatDoesNotStart_leavesTheOldOneInUse() {
        var broken = BehaviourComponent.of("broken", "breaking", List.of(), () -> {
            throw new IllegalStateException("no law");
        });
        run(plan(TWO_ROBOTS).with("broken", broken).replacing(Duration.ofMillis(150), "follower", "broken"));
        test.advance(Duration.ofMillis(200));
        assertThat(events.getLast()).startsWith("not replaced: ").contains("no law");
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FOLLOWER_AHEAD);
    }

    // ---- providers that die

    @Test
    void reconnectLimit_countsFromTheLossThatLasts_notFromOneBefore() {
        var dizzy = new AtomicBoolean();
        var flickering = BehaviourComponent.of("flickering", "driving", List.of(), () -> senses -> {
            if (dizzy.getAndSet(false)) {
                throw new IllegalStateException("dizzy");
            }
            return Optional.of(new Velocity(0.1, 0));
        });
        run(plan(ONE_ROBOT).with("flickering", flickering).needing("robot1", "driving"));
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

    /** Starts a driver whose first run fails at its first reading; if it dies for good, restarts fail, too. */
    private void runWithDriverThatDies(boolean forGood) {
        var runs = new AtomicInteger();
        Component<?, ?> mortal = BehaviourComponent.of("mortal", "dying", List.of(), () -> {
            if (runs.incrementAndGet() > 1 && forGood) {
                throw new IllegalStateException("dizzy for good");
            }
            return senses -> {
                if (runs.get() == 1) {
                    throw new IllegalStateException("dizzy");
                }
                return Optional.of(new Velocity(0.1, 0));
            };
        });
        run(plan(ONE_ROBOT).with("mortal", mortal).needing("robot1", "dying"));
        robots.tick(100);
        assertThat(events.getLast()).isEqualTo("robot1 has lost its provider");
    }

    @Test
    void providerThatDies_isStartedAgainWithinTheReconnectLimit_andTheRobotStandsStillMeanwhile() {
        runWithDriverThatDies(false);
        assertThat(robots.commands(0)).contains(STOP);
        test.advance(Duration.ofSeconds(2)); // the broker pauses before it restarts the provider
        assertThat(events.getLast()).startsWith("robot1 uses mortal");
        assertThat(application.ended().isDone()).isFalse();
    }

    @Test
    void providerThatStaysDead_endsTheApplication() {
        runWithDriverThatDies(true);
        for (int step = 0; step < 50 && !application.ended().isDone(); step++) {
            test.advance(Duration.ofMillis(100));
        }
        assertThat(application.ended().error())
                .isInstanceOf(MissingServiceException.class)
                .hasMessageContainingAll("robot1", "dying", "dizzy");
        assertThat(state("robots")).isEqualTo(Health.STOPPED);
    }

    @Test
    void componentThatIsAddedOnTheFly_takesOverFromOneThatDied() {
        runWithDriverThatDies(true);
        var heir = BehaviourComponent.of("heir", "dying", List.of(), () -> senses -> Optional.of(new Velocity(0.3, 0)));
        test.run(() -> application.add("heir", heir));
        assertThat(events.getLast()).startsWith("robot1 uses heir [robot1/position -> heir/position");
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(ahead(0.3));
        test.advance(Duration.ofSeconds(10));
        assertThat(application.ended().isDone()).isFalse();
    }

    // ---- topics

    @Test
    void colourFinder_seesWhatTheCameraOfItsRobotSees_andSaysEachColourOnce() {
        run(plan(TWO_ROBOTS + "component finder is colourFinder\nrobot2 needs service colourFinder\n"));
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
    void declaredWire_carriesValues_fromTheStart_toAComponentThatNobodyElseIsConnectedWith() {
        run(plan(TWO_ROBOTS + "connect robot1/sonar to idle/sonar\ntwo-robots needs service idling\n"));
        var sonar = listenTo(RobotTopics.sonar("idle"));
        var velocities = listenTo(RobotTopics.velocity("idle"));
        assertThat(state("idle")).isEqualTo(Health.WELL);
        robots.tick(100);
        assertThat(velocities).containsExactly(new Velocity(0.5, 0));
        assertThat(robots.commands(0)).as("it drives nobody").containsExactly(FOLLOWER_AHEAD);
        robots.range(0, 3, 1.25);
        robots.tick(100);
        assertThat(sonar).extracting(SonarReading::timeSeconds).containsExactly(0.1, 0.2);
        assertThat(sonar).extracting(reading -> reading.rangesM().get(3)).containsExactly(5.0, 1.25);
        assertThat(losses("idle")).isEqualTo(new Losses(0, 0, 0));
    }

    // ---- providers that hang or answer late: a robot has only one driver at a time

    private final ScriptedComponent<SonarReading, Velocity> first = driver("first", 0.1);

    /** Outputs one fixed velocity for each sonar reading, or without a reading. */
    private static ScriptedComponent<SonarReading, Velocity> driver(String name, double forwardMps) {
        var driver = new ScriptedComponent<SonarReading, Velocity>(
                input -> (SonarReading) input.value(),
                output -> new ApplicationData<>(RobotTopics.velocity(name), output));
        driver.data = reading -> driver.signals().data(new Velocity(forwardMps, 0));
        return driver;
    }

    private void startDrivers() {
        var next = driver("next", 0.3).component("driving", RobotTopics.sonar("next"), RobotTopics.velocity("next"));
        start(ApplicationPlan.named("one-robot")
                .with("robots", PlayerComponent.of(PlayerComponent.Settings.of("localhost", 7001, List.of(1))))
                .with("first", first.component("driving", RobotTopics.sonar("first"), RobotTopics.velocity("first")))
                .with("next", next)
                .needing("one-robot", "player")
                .needing("robot1", "driving"));
    }

    private List<String> usedByRobot1() {
        return events.stream()
                .filter(event -> event.startsWith("robot1 uses"))
                .map(event -> event.split(" ")[2])
                .toList();
    }

    /** The robot receives this command only, in one tick. */
    private void assertTick(int tick, double forwardMps) {
        int before = robots.commands(0).size();
        robots.tick(100);
        assertThat(robots.commands(0).subList(before, robots.commands(0).size()))
                .as("commands of tick %d", tick)
                .containsExactly(ahead(forwardMps));
    }

    @Test
    void providerWhoseHealthHangs_isFailedOver_andTheRobotObeysTheNextOnly() {
        first.health = ScriptedComponent::later;
        first.terminate = ScriptedComponent::later; // control hangs, but the driver still outputs velocities
        startDrivers();
        test.get(application.started());
        for (int tick = 1; tick < 60; tick++) {
            test.advance(Duration.ofMillis(100));
            assertTick(tick, 0.1);
        }
        assertThat(usedByRobot1()).as("after two misses").containsExactly("first");
        test.advance(Duration.ofMillis(100)); // the third missed check: sent after 5 s, overdue after 6 s
        assertThat(usedByRobot1()).containsExactly("first", "next");
        int before = robots.commands(0).size();
        for (int tick = 61; tick < 120; tick++) {
            test.run(() -> first.signals().data(new Velocity(0.1, 0)));
            assertTick(tick, 0.3);
            test.advance(Duration.ofMillis(100));
        }
        assertThat(robots.commands(0)).hasSize(before + 59);
        assertThat(first.calls).containsExactly("invoke", "terminate");
        assertThat(application.ended().isDone()).isFalse();
        application.closeAsync().handle((ended, error) -> true);
        test.advance(Duration.ofSeconds(20)); // the limit for a hanging provider
    }

    @Test
    void providerThatStartsLate_isNotWired_andIsTerminatedAgain() {
        var late = ScriptedComponent.later();
        first.invoke = () -> late;
        startDrivers();
        test.advance(Duration.ofSeconds(9));
        assertThat(usedByRobot1()).isEmpty();
        test.advance(Duration.ofSeconds(1));
        test.get(application.started());
        assertThat(usedByRobot1()).containsExactly("next");
        test.run(() -> late.resolve(null));
        assertThat(first.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(state("first")).isEqualTo(Health.FAILED);
        for (int tick = 1; tick <= 5; tick++) {
            test.run(() -> first.signals().data(new Velocity(0.1, 0)));
            assertTick(tick, 0.3);
        }
        assertThat(robots.commands(0)).hasSize(5);
        assertThat(usedByRobot1()).containsExactly("next");
    }
}
