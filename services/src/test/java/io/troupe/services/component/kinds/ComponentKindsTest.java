package io.troupe.services.component.kinds;

import static io.troupe.services.behaviour.TestSenses.blob;
import static io.troupe.services.subsumption.FakeRobots.STOP;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.broker.Health;
import io.troupe.common.text.NamedColours;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentBench;
import io.troupe.services.component.ComponentBroker;
import io.troupe.services.component.kinds.BehaviourComponent.Sense;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.subsumption.FakeRobots;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Behaviours, the colour finder, and the robots of a Player server as components. */
class ComponentKindsTest extends ComponentBench {
    private final FakeRobots robots = new FakeRobots(test, 2);
    private final List<Velocity> velocities = listenTo(RobotTopics.velocity("driver"));
    private ComponentBroker.Registered<?, ?> player = player(1, 2);

    private ComponentBroker.Registered<?, ?> player(Integer... numbers) {
        var settings = PlayerComponent.Settings.of("localhost", FakeRobots.PORT, List.of(numbers))
                .withCamera(true);
        return open("robots", PlayerComponent.of(settings), notes);
    }

    @AfterEach
    void noConnectionIsLeft() {
        robots.close();
        test.run(player::close);
        assertThat(robots.connections()).as("connections left open").isZero();
    }

    // ---- behaviours

    private ComponentBroker.Registered<?, ?> start(Supplier<Behaviour> law) {
        return start("driver", BehaviourComponent.of("driver", "driving", List.of("drives"), law));
    }

    private void ranges(double timeSeconds, double everyM) {
        publish(RobotTopics.sonar("driver"), new SonarReading(timeSeconds, Collections.nCopies(8, everyM)));
    }

    private void picture(double timeSeconds, int... seen) {
        var blobs = IntStream.of(seen).mapToObj(colour -> blob(colour, 100, 0)).toList();
        publish(RobotTopics.blobs("driver"), new BlobsReading(timeSeconds, blobs));
    }

    @Test
    void wallFollower_isItsControlLaw_oncePerReading() {
        start(() -> WallFollower.behaviour(CornerStyle.FORWARD));
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(new Velocity(0.2, 0));
        ranges(0.2, 0.3);
        assertThat(velocities).containsExactly(new Velocity(0.2, 0), new Velocity(0, -0.45));
    }

    @Test
    void behaviourThatAsksForThem_getsPoseBlobsLaserAndStall_thatCameBefore() {
        List<Senses> readings = new ArrayList<>();
        var senses = Set.of(Sense.BLOBS, Sense.LASER);
        start("driver", BehaviourComponent.of("driver", "driving", List.of(), senses, () -> reading -> {
            readings.add(reading);
            return Optional.empty();
        }));
        ranges(0.1, 5);
        publish(RobotTopics.position("driver"), new PositionReading(0.2, 3, 4, 0.5, true));
        publish(RobotTopics.laser("driver"), new LaserReading(0.2, -1, 1, 8, List.of(1.0, 2.0, 3.0)));
        picture(0.2, NamedColours.RED);
        ranges(0.2, 5);
        assertThat(readings.getFirst().laser().isEmpty()).isTrue();
        assertThat(readings.getFirst().blobs()).isEmpty();
        assertThat(readings.getLast().pose()).isEqualTo(new RobotPose(3, 4, 0.5));
        assertThat(readings.getLast().stalled()).isTrue();
        assertThat(readings.getLast().blobs()).containsExactly(blob(NamedColours.RED, 100, 0));
        assertThat(readings.getLast().laser().rangeM(2)).isEqualTo(3);
        assertThat(readings.getLast().laser().bearingRad(2)).isEqualTo(1);
        assertThat(velocities).as("it has nothing to say").isEmpty();
    }

    @Test
    void topics_areThoseOfTheSensesThatABehaviourOrAServiceUses() {
        var position = RobotTopics.position("c");
        var sonar = RobotTopics.sonar("c");
        var blobs = RobotTopics.blobs("c");
        Supplier<Behaviour> law = () -> senses -> Optional.empty();
        var plain = BehaviourComponent.of("c", "driving", List.of(), law);
        assertThat(plain.subscribes()).containsExactly(position, sonar);
        var seeing = BehaviourComponent.of("c", "driving", List.of(), Set.of(Sense.BLOBS), law);
        assertThat(seeing.subscribes()).containsExactly(position, sonar, blobs);
        var looking = new Service("looking", false, law);
        var component = BehaviourComponent.of("c", looking);
        assertThat(component.service()).isEqualTo("c");
        assertThat(component.capabilities()).containsExactly("drives");
        assertThat(component.subscribes()).containsExactly(position, sonar, blobs);
        assertThat(BehaviourComponent.of("c", looking.withLaser()).subscribes())
                .endsWith(blobs, RobotTopics.laser("c"));
    }

    @Test
    void rangesFasterThanACycle_arePassedOver_butNotWhenTheClockIsSetBackOrForward_andTimeGoesOn() {
        start(() -> senses -> Optional.of(new Velocity(senses.timeSeconds(), 0)));
        for (int millis = 0; millis <= 200; millis += 50) {
            ranges(millis / 1000.0, 5);
        }
        assertThat(velocities).containsExactly(new Velocity(0, 0), new Velocity(0.1, 0), new Velocity(0.2, 0));
        for (double stamp : new double[] {100, 100.1, 40.1, 40.2, 100.2, 100.3}) {
            ranges(stamp, 5);
        }
        assertThat(velocities).hasSize(3 + 6).extracting(Velocity::forwardMps).isSorted();
    }

    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void lawThatThrows_orEndsInAnError_standsStill_andTheComponentHasFailed(boolean error) {
        var provider = start(() -> senses -> {
            if (error) {
                throw new StackOverflowError("dizzy");
            }
            throw new IllegalStateException("dizzy");
        });
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(Velocity.STOP);
        assertThat(test.error(provider.check())).hasMessage("here/driver has failed: dizzy");
    }

    @Test
    void ringWithTooFewSonars_isRefused_andTheBehaviourGoesOn() {
        start(() -> senses -> Optional.of(new Velocity(0.1, 0)));
        publish(RobotTopics.sonar("driver"), new SonarReading(0.1, List.of(1.0)));
        assertThat(notes.take()).singleElement().asString().endsWith("a sonar ring has 1 readings, expected 8 or more");
        ranges(0.2, 5);
        assertThat(velocities).containsExactly(new Velocity(0.1, 0));
    }

    @Test
    void termination_standsStill_andTheNextLifeBeginsAnew() {
        var laws = new ArrayList<Integer>();
        var provider = start(() -> {
            laws.add(laws.size());
            return senses -> Optional.of(new Velocity(1, 0));
        });
        ranges(0.1, 5);
        test.get(provider.stop());
        assertThat(velocities).containsExactly(new Velocity(1, 0), Velocity.STOP);
        test.get(provider.start());
        assertThat(laws).containsExactly(0, 1);
    }

    @Test
    void colourFinder_saysEachColourWhenItComesIntoSight() {
        var colours = listenTo(RobotTopics.colours("driver"));
        start("driver", ColourFinderComponent.of("driver", Set.of(NamedColours.BLACK, NamedColours.ORANGE)));
        picture(0.1, NamedColours.BLACK);
        picture(0.2, NamedColours.BLACK, NamedColours.RED);
        picture(0.3, NamedColours.RED, NamedColours.ORANGE);
        picture(0.4, NamedColours.GREEN);
        picture(0.5);
        picture(0.6, NamedColours.GREEN);
        var green = NamedColours.GREEN;
        assertThat(colours)
                .containsExactly(
                        new ColourSeen(0.2, NamedColours.RED), new ColourSeen(0.4, green), new ColourSeen(0.6, green));
    }

    // ---- robots of a Player server

    private void startPlayer() {
        test.get(player.start());
        notes.take();
    }

    private void drive(String robot, double forwardMps, double turnRadps) {
        publish(RobotTopics.velocity(robot), new Velocity(forwardMps, turnRadps));
    }

    private void ticks(int count) {
        for (int tick = 0; tick < count; tick++) {
            robots.tick(100);
        }
    }

    @Test
    void robots_saySonarPositionAndBlobs_underTheirNames_andOnceForEachReading() {
        var sonar = listenTo(RobotTopics.sonar("robot1"));
        var positions = listenTo(RobotTopics.position("robot2"));
        var blobs = listenTo(RobotTopics.blobs("robot2"));
        startPlayer();
        robots.range(0, 3, 1.5);
        robots.show(1, NamedColours.RED);
        robots.tick(100);
        assertThat(sonar).singleElement().satisfies(reading -> {
            assertThat(reading.timeSeconds()).isEqualTo(0.1);
            assertThat(reading.rangesM().get(3)).isEqualTo(1.5);
        });
        assertThat(positions).singleElement().extracting(PositionReading::xM).isEqualTo(0.0);
        assertThat(blobs).singleElement().satisfies(reading -> {
            assertThat(reading.blobs()).hasSize(2);
            assertThat(reading.blobs().get(1).colour()).isEqualTo(NamedColours.RED);
        });
        robots.tick(100);
        assertThat(List.of(sonar, positions, blobs))
                .allSatisfy(readings -> assertThat(readings).hasSize(2));
    }

    @Test
    void laser_isSubscribedToAndPublished_onlyIfTheSettingsSaySo() {
        robots.get(0).hasLaser = true;
        robots.get(1).hasLaser = true;
        var scans = listenTo(RobotTopics.laser("robot1"));
        startPlayer();
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isZero();
        assertThat(scans).isEmpty();

        var settings = PlayerComponent.Settings.of("localhost", FakeRobots.PORT, List.of(1))
                .withLaser(true);
        Component<?, ?> component = PlayerComponent.of(settings);
        var withLaser = start("lasers", component);
        robots.tick(100);
        assertThat(robots.laserSubscriptions(0)).isOne();
        assertThat(robots.laserSubscriptions(1)).isZero();
        float quarter = (float) (Math.PI / 2);
        assertThat(scans).containsExactly(new LaserReading(0.2, -quarter, quarter, 8, List.of(1.0, 2.0, 3.0)));
        test.run(withLaser::close);
    }

    @Test
    void velocity_drivesTheRobotThatItIsFor_unlessItIsNoNumber_untilTheTermination() {
        startPlayer();
        drive("robot2", 0.3, -0.1);
        assertThat(robots.lastCommand(1)).isEqualTo(new DeviceCommand.Velocity(0.3, 0, -0.1, true));
        drive("robot1", Double.NaN, 0);
        assertThat(robots.commands(0)).isEmpty();
        assertThat(notes.take()).singleElement().asString().contains("robot1/velocity", "expected finite numbers");
        test.get(player.stop());
        assertThat(robots.lastCommand(1)).isEqualTo(STOP);
        assertThat(robots.connections()).isZero();
        test.get(player.start());
        assertThat(robots.connections()).isEqualTo(1);
    }

    @Test
    void robotThatNobodyCommandsAnyMore_isStopped_andThisIsTold() {
        startPlayer();
        drive("robot1", 0.3, 0);
        ticks(PlayerComponent.MAX_READINGS_WITHOUT_COMMAND - 1);
        assertThat(robots.commands(0)).hasSize(1);
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(notes.take())
                .containsExactly("robots robot 1 has received no command for 5 readings, and is stopped");
        robots.tick(100);
        assertThat(robots.commands(0)).hasSize(2);
    }

    @Test
    void clockThatIsSetBackOrForward_leavesNoReadingUnsaid_andStillStopsARobotThatNobodyCommands() {
        var topics = List.of(RobotTopics.sonar("robot1"), RobotTopics.position("robot1"), RobotTopics.blobs("robot1"));
        var heard = topics.stream().map(this::listenTo).toList();
        startPlayer();
        robots.tick(100_000);
        for (int steppedMillis : new int[] {-60_000, 60_000}) {
            drive("robot1", 0.3, 0);
            heard.forEach(List::clear);
            robots.tick(steppedMillis);
            assertThat(heard).allSatisfy(readings -> assertThat(readings).hasSize(1));
            ticks(PlayerComponent.MAX_READINGS_WITHOUT_COMMAND - 1);
            assertThat(robots.lastCommand(0))
                    .as("after a step of %s ms", steppedMillis)
                    .isEqualTo(STOP);
        }
    }

    @Test
    void serverThatIsLost_getsZeroSpeed_andIsNamedByTheHealth_itStopsTheRobotsIfThisEnds() {
        startPlayer();
        assertThat(robots.limits)
                .containsExactly(
                        "silence PT5S",
                        "robot 1 troupe_command_limit_ms 400",
                        "robot 1 troupe_command_age_ms 300",
                        "robot 2 troupe_command_limit_ms 400",
                        "robot 2 troupe_command_age_ms 300");
        drive("robot1", 0.3, 0);
        test.get(player.check());
        test.run(robots::vanish);
        assertThat(test.get(player.health())).isEqualTo(Health.FAILED);
        assertThat(robots.lastCommand(0)).isEqualTo(STOP);
        assertThat(test.error(player.check()))
                .hasMessage("here/robots has failed: Player server localhost:7001: the server has gone");
    }

    @Test
    void missingRobot_isNamedByTheStart() {
        test.run(player::close);
        player = player(3);
        assertThat(test.error(player.start())).hasMessageContainingAll("here/robots has failed", "2");
    }
}
