package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.LaserScan;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.bus.BusTopic;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.function.Supplier;

/**
 * Any behaviour as a component.
 *
 * <p><b>Role.</b> Under the name {@code c} it hears {@code c/sonar} and {@code c/position}, and for each ring of
 * ranges, but not more often than every 100 ms, says {@code c/velocity} if it wants to move. Where no position comes it
 * knows only the pose (0, 0, 0), not stalled. One that asks for blobs or laser subscribes to {@code c/blobs} or
 * {@code c/laser} too; until the first of them comes there are no blobs, and the scan is empty. Its last command, when
 * it is terminated or its law throws, is to stand still.
 *
 * <p><b>Source.</b> Paper, sections 3.1 and 3.2.
 */
public final class BehaviourComponent {
    /** What a behaviour senses only if it asks for it, since it costs messages. */
    public enum Sense {
        /** What the camera sees, from {@code c/blobs}. */
        BLOBS,
        /** The scans of the laser, from {@code c/laser}. */
        LASER
    }

    private BehaviourComponent() {}

    /** A behaviour that asks for neither blobs nor laser. */
    public static Component<?, ?> of(
            String name, String service, List<String> capabilities, Supplier<? extends Behaviour> law) {
        return of(name, service, capabilities, Set.of(), law);
    }

    /**
     * @param name of the component on the bus, and of its topics
     * @param service what it provides
     * @param senses what it asks for besides sonar and position
     * @param law made anew for each life of the component
     */
    public static Component<?, ?> of(
            String name,
            String service,
            List<String> capabilities,
            Set<Sense> senses,
            Supplier<? extends Behaviour> law) {
        List<BusTopic<?>> hears = new ArrayList<>(List.of(RobotTopics.position(name), RobotTopics.sonar(name)));
        if (senses.contains(Sense.BLOBS)) {
            hears.add(RobotTopics.blobs(name));
        }
        if (senses.contains(Sense.LASER)) {
            hears.add(RobotTopics.laser(name));
        }
        return new Component<>(
                service,
                capabilities,
                hears,
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
}
