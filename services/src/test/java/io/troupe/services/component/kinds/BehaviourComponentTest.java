package io.troupe.services.component.kinds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.TestBlobs;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.BehaviourComponent.Sense;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Supplier;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class BehaviourComponentTest {
    private final TestSpace test = new TestSpace();
    private final Bus bus = Bus.inProcess("here", BusSettings.on(test.space()));
    private final RecordingObserver notes = new RecordingObserver();
    private final BusPort user = bus.attach("user");
    private final List<Velocity> velocities = new ArrayList<>();
    private final List<String> colours = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        bus.close();
        test.crank();
        test.close();
    }

    private ComponentInterface<?, ?> start(Component<?, ?> component) {
        var opened = new ArrayList<ComponentInterface<?, ?>>();
        test.run(() -> {
            user.subscribe(RobotTopics.velocity("driver"), (velocity, from) -> velocities.add(velocity));
            user.subscribe(
                    RobotTopics.colours("driver"),
                    (seen, from) -> colours.add(seen.timeSeconds() + " " + NamedColours.name(seen.colour())));
            opened.add(ComponentInterface.open(bus, "driver", component, notes));
        });
        test.get(opened.getFirst().start().thenApply(runs -> true));
        notes.take();
        return opened.getFirst();
    }

    private ComponentInterface<?, ?> start(Supplier<Behaviour> law) {
        return start(BehaviourComponent.of("driver", "driving", List.of("drives"), law));
    }

    private void ranges(double timeSeconds, double everyM) {
        var reading = new SonarReading(timeSeconds, Collections.nCopies(8, everyM));
        test.run(() -> user.publish(RobotTopics.sonar("driver"), reading));
    }

    @Test
    void wallFollower_isItsControlLaw_oncePerReading() {
        start(() -> WallFollower.behaviour(CornerStyle.FORWARD));
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(new Velocity(0.2, 0));
        ranges(0.2, 0.3);
        assertThat(velocities.getLast()).isEqualTo(new Velocity(0, -0.45));
    }

    @Test
    void behaviour_knowsThePoseThatCameBefore() {
        start(() -> senses ->
                Optional.of(new Velocity(senses.pose().xM(), senses.pose().headingRad())));
        test.run(() -> user.publish(RobotTopics.position("driver"), new PositionReading(0.1, 3, 4, 0.5, false)));
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(new Velocity(3, 0.5));
    }

    @Test
    void behaviourThatAsksForThem_getsBlobsLaserAndStall_thatCameBefore() {
        List<Senses> readings = new ArrayList<>();
        start(BehaviourComponent.of("driver", "driving", List.of(), Set.of(Sense.BLOBS, Sense.LASER), () -> senses -> {
            readings.add(senses);
            return Optional.empty();
        }));
        ranges(0.1, 5);
        test.run(() -> {
            user.publish(RobotTopics.position("driver"), new PositionReading(0.2, 0, 0, 0, true));
            user.publish(RobotTopics.laser("driver"), new LaserReading(0.2, -1, 1, 8, List.of(1.0, 2.0, 3.0)));
        });
        picture(0.2, NamedColours.RED);
        ranges(0.2, 5);
        assertThat(readings.getFirst().laser().isEmpty()).isTrue();
        assertThat(readings.getFirst().blobs()).isEmpty();
        assertThat(readings.getLast().stalled()).isTrue();
        assertThat(readings.getLast().blobs()).containsExactly(TestBlobs.of(NamedColours.RED, 100, 0));
        assertThat(readings.getLast().laser().rangeM(2)).isEqualTo(3);
        assertThat(readings.getLast().laser().bearingRad(2)).isEqualTo(1);
    }

    @Test
    void behaviourThatDoesNotAsk_hearsNeitherBlobsNorLaser() {
        var plain = BehaviourComponent.of("c", "driving", List.of(), () -> senses -> Optional.empty());
        assertThat(plain.subscribes()).containsExactly(RobotTopics.position("c"), RobotTopics.sonar("c"));
        var looking =
                BehaviourComponent.of("c", "driving", List.of(), Set.of(Sense.BLOBS), () -> senses -> Optional.empty());
        assertThat(looking.subscribes())
                .containsExactly(RobotTopics.position("c"), RobotTopics.sonar("c"), RobotTopics.blobs("c"));
    }

    @Test
    void serviceOfATable_isAComponentWithTheSensesThatItUses() {
        var looking = new Service("looking", false, () -> senses -> Optional.empty());
        var component = BehaviourComponent.of("c", looking);
        assertThat(component.service()).isEqualTo("c");
        assertThat(component.capabilities()).containsExactly("drives");
        assertThat(component.subscribes())
                .containsExactly(RobotTopics.position("c"), RobotTopics.sonar("c"), RobotTopics.blobs("c"));
        assertThat(BehaviourComponent.of("c", looking.withLaser()).subscribes())
                .endsWith(RobotTopics.blobs("c"), RobotTopics.laser("c"));
    }

    @Test
    void rangesFasterThanACycle_arePassedOver() {
        start(() -> senses -> Optional.of(new Velocity(senses.timeSeconds(), 0)));
        for (int millis = 0; millis <= 200; millis += 50) {
            ranges(millis / 1000.0, 5);
        }
        assertThat(velocities).containsExactly(new Velocity(0, 0), new Velocity(0.1, 0), new Velocity(0.2, 0));
    }

    @Test
    void clockThatIsSetBackOrForward_leavesNoRingWithoutAVelocity_andTimeGoesOn() {
        List<Double> times = new ArrayList<>();
        start(() -> senses -> {
            times.add(senses.timeSeconds());
            return Optional.of(new Velocity(0.1, 0));
        });
        double[] stamps = {100, 100.1, 40.1, 40.2, 100.2, 100.3};
        for (double stamp : stamps) {
            ranges(stamp, 5);
        }
        assertThat(velocities).hasSize(stamps.length);
        assertThat(times).isSorted();
    }

    @Test
    void behaviourWithNothingToSay_saysNothing() {
        start(() -> senses -> Optional.empty());
        ranges(0.1, 5);
        assertThat(velocities).isEmpty();
    }

    @Test
    void lawThatThrows_standsStill_andTheComponentHasFailed() {
        var provider = start(() -> senses -> {
            throw new IllegalStateException("dizzy");
        });
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(Velocity.STOP);
        assertThat(test.error(provider.check())).hasMessage("here/driver has failed: dizzy");
    }

    @Test
    void lawThatEndsInAnError_standsStill_andTheComponentHasFailed() {
        var provider = start(() -> senses -> {
            throw new StackOverflowError("too deep");
        });
        ranges(0.1, 5);
        assertThat(velocities).containsExactly(Velocity.STOP);
        assertThat(test.error(provider.check())).hasMessage("here/driver has failed: too deep");
    }

    @Test
    void ringWithTooFewSonars_isRefused_andTheBehaviourGoesOn() {
        start(() -> senses -> Optional.of(new Velocity(0.1, 0)));
        test.run(() -> user.publish(RobotTopics.sonar("driver"), new SonarReading(0.1, List.of(1.0))));
        assertThat(notes.take())
                .hasSize(1)
                .first()
                .asString()
                .endsWith("a sonar ring has 1 readings, expected 8 or more");
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
        test.get(provider.stop().thenApply(ended -> true));
        assertThat(velocities).containsExactly(new Velocity(1, 0), Velocity.STOP);
        test.get(provider.start().thenApply(runs -> true));
        assertThat(laws).containsExactly(0, 1);
    }

    @Test
    void colourFinder_saysEachColourWhenItComesIntoSight() {
        start(ColourFinderComponent.of("driver", Set.of(NamedColours.BLACK, NamedColours.ORANGE)));
        picture(0.1, NamedColours.BLACK);
        picture(0.2, NamedColours.BLACK, NamedColours.RED);
        picture(0.3, NamedColours.RED, NamedColours.ORANGE);
        picture(0.4, NamedColours.GREEN);
        picture(0.5);
        picture(0.6, NamedColours.GREEN);
        assertThat(colours).containsExactly("0.2 red", "0.4 green", "0.6 green");
    }

    private void picture(double timeSeconds, int... seen) {
        List<Blob> blobs = new ArrayList<>();
        for (int colour : seen) {
            blobs.add(TestBlobs.of(colour, 100, 0));
        }
        test.run(() -> user.publish(RobotTopics.blobs("driver"), new BlobsReading(timeSeconds, blobs)));
    }
}
