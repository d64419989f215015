package io.troupe.services.component.kinds;

import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import java.util.List;
import java.util.function.Supplier;

/**
 * Any behaviour as a component.
 *
 * <p><b>Role.</b> Under the name {@code c} it hears {@code c/sonar} and {@code c/position}, and for each ring of ranges, but not more often than every 100 ms, says
 * {@code c/velocity} if it wants to move. Where no position comes it knows only the pose (0, 0, 0). Its last word, when it is terminated or its law throws, is to stand still.
 * <p><b>Source.</b> Paper, sections 3.1 and 3.2.
 */
public final class BehaviourComponent {
    private BehaviourComponent() {}

    /**
     * @param name of the component on the bus, and of its topics
     * @param service what it provides
     * @param law made anew for each life of the component
     */
    public static Component<?, ?> of(
            String name, String service, List<String> capabilities, Supplier<? extends Behaviour> law) {
        return new Component<>(
                service,
                capabilities,
                List.of(RobotTopics.position(name), RobotTopics.sonar(name)),
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
                return new BehaviourInput.Pose(new RobotPose(at.xM(), at.yM(), at.headingRad()));
            }
            if (input.value() instanceof SonarReading reading) {
                return new BehaviourInput.Ranges(reading.timeSeconds(), ring(reading.rangesM()));
            }
            throw new IllegalArgumentException(input + " is neither ranges nor a position");
        }

        private static SonarRing ring(List<Double> rangesM) {
            var ranges = new float[rangesM.size()];
            for (int sonar = 0; sonar < ranges.length; sonar++) {
                ranges[sonar] = rangesM.get(sonar).floatValue();
            }
            return SonarRing.of(ranges);
        }
    }
}
