package io.troupe.view;

import io.troupe.sim.RobotReading;
import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Device;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Scratch;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/**
 * The sensors of a robot of which only the pose is known: computes what they read in a scene. The readings are those of
 * the simulation, bit for bit, except for the noise of lasers and rangers, which is left out. Intensities are computed
 * for the lasers and rangers that measure them from the start. The state of a gripper does not follow from poses.
 *
 * <p>The scene must know what grippers hold ({@link Scene#carry}) and which things are in the world
 * ({@link Scene#show}). A robot senses what it holds as if it stood there, unless the scene knows that it is held.
 *
 * {@snippet :
 * scene.place(0, pose);
 * scene.refresh();
 * RobotReading reading = new ComputedSensors(world.robots().get(0)).read(scene, 0, pose, odometry, scene.wallGapM(0));
 * }
 *
 * <p><b>Threads.</b> One at a time.
 */
public final class ComputedSensors {
    private final @Nullable Sonar sonar;
    private final @Nullable Blobfinder blobfinder;
    private final List<Ranger> rangers;
    private final List<Device> devices;
    private final boolean measuresIntensities;
    private final Scratch scratch = new Scratch();
    private @Nullable List<Double> sonarM;
    private @Nullable BlobImage blobs;
    private List<List<Double>> rangersM = List.of();

    public ComputedSensors(RobotSpec robot) {
        sonar = robot.sonar() == null ? null : new Sonar(robot.sonar());
        blobfinder = robot.blobfinder() == null ? null : new Blobfinder(robot.blobfinder());
        rangers = robot.rangers().stream()
                .map(ranger -> new Ranger(ranger, most -> 0))
                .toList();
        devices = robot.devices().stream().map(Device::of).toList();
        measuresIntensities = rangers.stream().anyMatch(Ranger::measuresIntensities);
    }

    /**
     * The reading of the robot, in which its grippers are {@link DeviceReading.Unknown}.
     *
     * @param scene with all poses, refreshed
     * @param robot index of this robot
     */
    public RobotReading read(Scene scene, int robot, Pose pose, Odometry odometry, double wallGapM) {
        sense(scene, robot);
        return reading(scene, robot, pose, odometry, wallGapM, Map.of());
    }

    /**
     * The first half of a reading, for a scene in which grippers hold things: they act after sensors have read, so
     * things have the carriers of the reading before.
     */
    public void sense(Scene scene, int robot) {
        if (measuresIntensities) {
            scene.readReflectances();
        }
        sonarM = sonar == null ? null : sonar.read(scene, robot);
        blobs = blobfinder == null ? null : blobfinder.read(scene, robot);
        rangersM = rangers.stream().map(ranger -> ranger.read(scene, robot)).toList();
        devices.forEach(device -> device.sense(scene, robot, scratch));
    }

    /**
     * The second half: things have the carriers of this reading, because bumpers are compared with their surroundings
     * after grippers have acted.
     *
     * @param grips the states of grippers, by their index in {@link RobotSpec#devices}; the others are
     *     {@link DeviceReading.Unknown}
     */
    public RobotReading reading(
            Scene scene,
            int robot,
            Pose pose,
            Odometry odometry,
            double wallGapM,
            Map<Integer, DeviceReading.Grip> grips) {
        List<DeviceReading> read = new ArrayList<>();
        for (int i = 0; i < devices.size(); i++) {
            DeviceReading.Grip grip = grips.get(i);
            if (devices.get(i) instanceof GripperDevice) {
                read.add(grip == null ? new DeviceReading.Unknown() : grip);
            } else {
                read.add(devices.get(i).reading(scene, robot));
            }
        }
        return new RobotReading(
                pose,
                odometry,
                sonarM,
                blobs,
                rangersM,
                measuresIntensities ? rangers.stream().map(Ranger::intensities).toList() : List.of(),
                read,
                wallGapM);
    }
}
