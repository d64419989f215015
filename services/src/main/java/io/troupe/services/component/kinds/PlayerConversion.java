package io.troupe.services.component.kinds;

import io.troupe.player.structures.laser.PlayerLaserData;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.PlayerSignal.Blobs;
import io.troupe.services.component.kinds.PlayerSignal.Laser;
import io.troupe.services.component.kinds.PlayerSignal.Position;
import io.troupe.services.component.kinds.PlayerSignal.Reading;
import io.troupe.services.component.kinds.PlayerSignal.SetSpeed;
import io.troupe.services.component.kinds.PlayerSignal.Sonar;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.LaserReading;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

/**
 * Converts between the structures of the Player client, which identify a robot by its index, and the topics and records
 * on the bus, which identify it by its name.
 */
final class PlayerConversion implements Conversion<SetSpeed, Reading> {
    private final Map<Integer, String> names;

    /** @param names names of the robots by Player index */
    PlayerConversion(Map<Integer, String> names) {
        this.names = Map.copyOf(names);
    }

    @Override
    public List<ApplicationData<?>> toApplication(Reading reading) {
        String robot = names.get(reading.index());
        double timeSeconds = reading.timestamp();
        return List.of(
                switch (reading) {
                    case Sonar sonar ->
                        new ApplicationData<>(
                                RobotTopics.sonar(robot),
                                new SonarReading(
                                        timeSeconds, metres(sonar.data().getRanges())));
                    case Position position ->
                        new ApplicationData<>(RobotTopics.position(robot), position(timeSeconds, position));
                    case Blobs blobs ->
                        new ApplicationData<>(
                                RobotTopics.blobs(robot), new BlobsReading(timeSeconds, Blob.of(blobs.data())));
                    case Laser laser ->
                        new ApplicationData<>(RobotTopics.laser(robot), scan(timeSeconds, laser.data()));
                });
    }

    private static List<Double> metres(float[] ranges) {
        List<Double> metres = new ArrayList<>(ranges.length);
        for (float range : ranges) {
            metres.add((double) range);
        }
        return metres;
    }

    private static LaserReading scan(double timeSeconds, PlayerLaserData scan) {
        return new LaserReading(
                timeSeconds, scan.getMin_angle(), scan.getMax_angle(), scan.getMax_range(), metres(scan.getRanges()));
    }

    private static PositionReading position(double timeSeconds, Position position) {
        var pose = position.data().getPos();
        boolean stalled = position.data().getStall() != 0;
        return new PositionReading(timeSeconds, pose.getPx(), pose.getPy(), pose.getPa(), stalled);
    }

    @Override
    public SetSpeed toComponent(ApplicationData<?> input) {
        if (!(input.value() instanceof Velocity velocity)) {
            throw new IllegalArgumentException(input + " is no velocity");
        }
        if (!Double.isFinite(velocity.forwardMps()) || !Double.isFinite(velocity.turnRadps())) {
            throw new IllegalArgumentException(
                    input + " is no speed that a robot could have, expected finite numbers of m/s and rad/s");
        }
        for (var robot : names.entrySet()) {
            if (RobotTopics.velocity(robot.getValue()).equals(input.topic())) {
                return new SetSpeed(robot.getKey(), velocity.forwardMps(), velocity.turnRadps());
            }
        }
        throw new IllegalArgumentException(input + " is for none of the robots " + names.values());
    }
}
