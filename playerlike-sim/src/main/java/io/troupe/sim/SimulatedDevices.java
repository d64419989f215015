package io.troupe.sim;

import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Device;
import io.troupe.sim.device.Position2d;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Scratch;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.model.BlobfinderSpec;
import io.troupe.sim.model.OdometryError;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RangerSpec;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/** The sensors and the odometry of one robot. */
record SimulatedDevices(
        Position2d position2d,
        @Nullable Sonar sonar,
        @Nullable Blobfinder blobfinder,
        List<Ranger> rangers,
        List<double[]> rangersM,
        List<Device> others) {
    /** Creates the devices of all robots. Devices of one specification share their immutable tables. */
    static List<SimulatedDevices> of(List<RobotSpec> robots, List<Pose> starts, long seed) {
        Map<SonarSpec, Sonar> sonars = new HashMap<>();
        Map<BlobfinderSpec, Blobfinder> blobfinders = new HashMap<>();
        List<SimulatedDevices> all = new ArrayList<>(robots.size());
        for (int i = 0; i < robots.size(); i++) {
            RobotSpec robot = robots.get(i);
            SonarSpec sonar = robot.sonar();
            BlobfinderSpec blobfinder = robot.blobfinder();
            try {
                List<Ranger> rangers = createRangers(robot, seed);
                all.add(new SimulatedDevices(
                        new Position2d(starts.get(i), robot.startOdometry(), drawOdometryError(robot, seed)),
                        sonar == null
                                ? null
                                : sonars.computeIfAbsent(sonar, Sonar::new).twin(),
                        blobfinder == null
                                ? null
                                : blobfinders
                                        .computeIfAbsent(blobfinder, Blobfinder::new)
                                        .twin(),
                        rangers,
                        rangers.stream()
                                .map(ranger -> new double[ranger.size()])
                                .toList(),
                        robot.devices().stream().map(Device::of).toList()));
            } catch (IllegalArgumentException e) {
                throw new WorldFileException(robot.where(), "robot '" + robot.name() + "': " + e.getMessage());
            }
        }
        return all;
    }

    /** Odometry error of this run, uniform within plus or minus half of the specified proportions. */
    private static OdometryError drawOdometryError(RobotSpec robot, long seed) {
        OdometryError most = robot.odometryError();
        if (most.equals(OdometryError.NONE)) {
            return most;
        }
        for (double proportion : new double[] {most.x(), most.y(), most.heading()}) {
            if (!(proportion >= 0 && proportion < 2)) {
                throw new IllegalArgumentException(
                        "odometry error is " + most + ", expected proportions from 0 to less than 2");
            }
        }
        var random = new RandomStream(seed, robot.name(), "odometry");
        return new OdometryError(
                random.nextWithin(most.x() / 2),
                random.nextWithin(most.y() / 2),
                random.nextWithin(most.heading() / 2));
    }

    private static List<Ranger> createRangers(RobotSpec robot, long seed) {
        return IntStream.range(0, robot.rangers().size())
                .mapToObj(i -> new Ranger(
                        robot.rangers().get(i), new RandomStream(seed, robot.name(), "ranger" + i)::nextWithin))
                .toList();
    }

    /**
     * Index of the first ranger that can replace a sonar ring, because each of its sensors casts one ray; -1 if there
     * is none.
     */
    int sonarRanger() {
        for (int i = 0; i < rangers.size(); i++) {
            RangerSpec spec = rangers.get(i).spec();
            // each sensor casts at least one ray, so equal counts mean exactly one ray each
            if (spec.kind() == RangerSpec.Kind.RANGER
                    && rangers.get(i).size() == spec.sensors().size()) {
                return i;
            }
        }
        return -1;
    }

    /** Updates the devices that cast rays. */
    void sense(Scene scene, int robot, Scratch scratch) {
        if (sonar != null) {
            sonar.sense(scene, robot, scratch);
        }
        if (blobfinder != null) {
            blobfinder.sense(scene, robot, scratch);
        }
        for (int i = 0; i < rangers.size(); i++) {
            rangers.get(i).read(scene, robot, scratch, rangersM.get(i));
        }
        for (int i = 0; i < others.size(); i++) {
            others.get(i).sense(scene, robot, scratch);
        }
    }
}
