package io.troupe.view;

import io.troupe.sim.RobotReading;
import io.troupe.sim.device.Blobfinder;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Ranger;
import io.troupe.sim.device.Scene;
import io.troupe.sim.device.Sonar;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The sensors of a robot of which only the pose is known: computes what they read in a scene. The readings are those of
 * the simulation, bit for bit, except for the noise of lasers and rangers, which is left out.
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

    public ComputedSensors(RobotSpec robot) {
        sonar = robot.sonar() == null ? null : new Sonar(robot.sonar());
        blobfinder = robot.blobfinder() == null ? null : new Blobfinder(robot.blobfinder());
        rangers = robot.rangers().stream()
                .map(ranger -> new Ranger(ranger, most -> 0))
                .toList();
    }

    /**
     * The reading of the robot.
     *
     * @param scene with all poses, refreshed
     * @param robot index of this robot
     */
    public RobotReading read(Scene scene, int robot, Pose pose, Odometry odometry, double wallGapM) {
        return new RobotReading(
                pose,
                odometry,
                sonar == null ? null : sonar.read(scene, robot),
                blobfinder == null ? null : blobfinder.read(scene, robot),
                rangers.stream().map(ranger -> ranger.read(scene, robot)).toList(),
                wallGapM);
    }
}
