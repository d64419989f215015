package io.troupe.services.component.kinds;

import io.troupe.actor.Promise;
import io.troupe.bus.BusTopic;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import io.troupe.services.robot.ControlCycle;
import io.troupe.services.subsumption.Service;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Makes a component of any {@link Behaviour}.
 *
 * <p><b>Role.</b> A component named {@code c} subscribes to {@code c/sonar} and {@code c/position}. For each sonar
 * reading, but at most every 100 ms, it runs a step of its control law and publishes the velocity on {@code c/velocity}
 * if the step returns one. Until a position arrives, the pose is (0, 0, 0) and the robot is not stalled. A behaviour
 * that needs blobs or laser scans also subscribes to {@code c/blobs} or {@code c/laser}; until the first of them
 * arrives, there are no blobs and the scan is empty. When the component is terminated or its control law throws, its
 * last output is a command to stop.
 *
 * <p><b>Source.</b> Paper, sections 3.1 and 3.2.
 */
public final class BehaviourComponent {
    /** Optional inputs of a behaviour, which cost messages and are therefore subscribed to only on request. */
    public enum Sense {
        /** Camera blobs, from {@code c/blobs}. */
        BLOBS,
        /** Laser scans, from {@code c/laser}. */
        LASER
    }

    private BehaviourComponent() {}

    /** Makes a component without blobs and laser scans. */
    public static Component<?, ?> of(
            String name, String service, List<String> capabilities, Supplier<? extends Behaviour> law) {
        return of(name, service, capabilities, Set.of(), law);
    }

    /**
     * Makes a component of a service that a table can name, so that the same behaviour drives a robot of
     * {@link io.troupe.services.subsumption.SubsumptionRun} or of an application. The component provides a service of
     * its name with the capability {@code drives}. It gets blobs, and laser scans if the service uses the laser.
     */
    public static Component<?, ?> of(String name, Service service) {
        Set<Sense> senses = service.usesLaser() ? Set.of(Sense.BLOBS, Sense.LASER) : Set.of(Sense.BLOBS);
        return of(name, name, List.of("drives"), senses, service.behaviour());
    }

    /**
     * Makes a component.
     *
     * @param name name of the component on the bus, and prefix of its topics
     * @param service name of the provided service
     * @param capabilities further terms by which the broker finds the service
     * @param senses optional inputs besides sonar and position
     * @param law creates the behaviour, once for each run of the component
     */
    public static Component<?, ?> of(
            String name,
            String service,
            List<String> capabilities,
            Set<Sense> senses,
            Supplier<? extends Behaviour> law) {
        List<BusTopic<?>> subscribes = new ArrayList<>(List.of(RobotTopics.position(name), RobotTopics.sonar(name)));
        if (senses.contains(Sense.BLOBS)) {
            subscribes.add(RobotTopics.blobs(name));
        }
        if (senses.contains(Sense.LASER)) {
            subscribes.add(RobotTopics.laser(name));
        }
        return new Component<>(
                service,
                capabilities,
                subscribes,
                List.of(RobotTopics.velocity(name)),
                () -> new BehaviourCommunication(law),
                new SensesConversion(name),
                Buffering.STREAM,
                Buffering.STREAM);
    }

    private record SensesConversion(String name) implements Conversion<BehaviourInput, Velocity> {
        @Override
        public List<ApplicationData<?>> toApplication(Velocity output) {
            return List.of(new ApplicationData<>(RobotTopics.velocity(name), output));
        }

        @Override
        public BehaviourInput toComponent(ApplicationData<?> input) {
            if (input.value() instanceof PositionReading at) {
                return new BehaviourInput.Position(new RobotPose(at.xM(), at.yM(), at.headingRad()), at.stalled());
            }
            if (input.value() instanceof BlobsReading image) {
                return new BehaviourInput.Image(image.blobs());
            }
            if (input.value() instanceof LaserReading scan) {
                return new BehaviourInput.Laser(LaserScan.of(
                        scan.minBearingRad(), scan.maxBearingRad(), scan.maxRangeM(), floats(scan.rangesM())));
            }
            if (input.value() instanceof SonarReading reading) {
                return new BehaviourInput.Ranges(reading.timeSeconds(), SonarRing.of(floats(reading.rangesM())));
            }
            throw new IllegalArgumentException(input + " is neither ranges, a position, blobs nor a scan");
        }

        private static float[] floats(List<Double> rangesM) {
            var ranges = new float[rangesM.size()];
            for (int each = 0; each < ranges.length; each++) {
                ranges[each] = rangesM.get(each).floatValue();
            }
            return ranges;
        }
    }

    /** Input of a behaviour, in the types that control laws use. */
    private sealed interface BehaviourInput {
        record Position(RobotPose pose, boolean stalled) implements BehaviourInput {}

        record Image(List<Blob> blobs) implements BehaviourInput {}

        record Laser(LaserScan scan) implements BehaviourInput {}

        record Ranges(double timeSeconds, SonarRing sonar) implements BehaviourInput {}
    }

    /**
     * The CCU of a behaviour: runs one step of the control law for each sonar reading, at most one per control cycle.
     */
    private static final class BehaviourCommunication implements ComponentCommunication<BehaviourInput, Velocity> {
        private static final RobotPose UNKNOWN = new RobotPose(0, 0, 0);

        private final Supplier<? extends Behaviour> law;
        private @Nullable ControlCycle cycle;
        private @Nullable Signals<? super Velocity> signals;
        private RobotPose pose = UNKNOWN;
        private boolean stalled;
        private List<Blob> blobs = List.of();
        private LaserScan scan = LaserScan.EMPTY;
        private final ReadingTime time = new ReadingTime();

        BehaviourCommunication(Supplier<? extends Behaviour> law) {
            this.law = law;
        }

        @Override
        public Promise<@Nullable Void> invoke(Signals<? super Velocity> newSignals) {
            cycle = new ControlCycle(law.get(), newSignals::data);
            signals = newSignals;
            return Promise.done();
        }

        @Override
        public void data(BehaviourInput input) {
            switch (input) {
                case BehaviourInput.Position position -> {
                    pose = position.pose();
                    stalled = position.stalled();
                }
                case BehaviourInput.Image image -> blobs = image.blobs();
                case BehaviourInput.Laser laser -> scan = laser.scan();
                case BehaviourInput.Ranges ranges -> step(ranges);
            }
        }

        private void step(BehaviourInput.Ranges ranges) {
            double nowSeconds = time.at(ranges.timeSeconds());
            if (cycle != null && signals != null && cycle.isDue(nowSeconds)) {
                cycle.step(new Senses(nowSeconds, ranges.sonar(), pose, stalled, blobs, scan))
                        .ifPresent(signals::data);
            }
        }

        @Override
        public Promise<@Nullable Void> terminate() {
            if (cycle != null) {
                cycle.halt();
                cycle = null;
            }
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> health() {
            return Promise.done();
        }
    }
}
