package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Scene;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Readings that are computed from a pose alone. */
class ComputedSensorsTest {
    @Test
    void readings_areThoseOfTheSimulation_atTheSamePose() {
        WorldSpec world = PushedBox.WORLD;
        RobotReading simulated;
        try (var simulation = World.create(world, WorldSettings.defaults())) {
            simulation.command(0, 0, 0.7);
            simulation.advance();
            simulated = simulation.advance().robots().getFirst();
        }
        Pose pose = simulated.pose();
        Odometry odometry = simulated.odometry();
        var scene = new Scene(world);
        scene.place(0, pose);
        scene.refresh();
        RobotReading reading =
                new ComputedSensors(world.robots().get(0)).read(scene, 0, pose, odometry, scene.wallGapM(0));
        assertThat(pose.headingRad()).isNotZero();
        assertThat(reading).isEqualTo(simulated);
    }

    @Test
    void devices_areThoseOfTheSimulation_exceptForTheGripper() {
        WorldSpec world = DeviceRoom.WORLD;
        Snapshot simulated;
        try (var simulation = World.create(world, WorldSettings.defaults())) {
            simulation.command(0, -0.4, 0.3);
            simulation.command(1, 0.1, -0.2);
            simulated = simulation.advance(17);
        }
        var scene = new Scene(world);
        for (int robot = 0; robot < 2; robot++) {
            scene.place(robot, simulated.robots().get(robot).pose());
        }
        scene.place(2, simulated.moved().getFirst());
        scene.refresh();
        for (int robot = 0; robot < 2; robot++) {
            RobotReading had = simulated.robots().get(robot);
            RobotReading reading = new ComputedSensors(world.robots().get(robot))
                    .read(scene, robot, had.pose(), had.odometry(), scene.wallGapM(robot));
            assertThat(reading.intensities()).isEqualTo(had.intensities());
            for (int i = 0; i < had.devices().size(); i++) {
                assertThat(reading.devices().get(i))
                        .as("device %d of robot %d", i, robot)
                        .isEqualTo(
                                had.devices().get(i) instanceof DeviceReading.Grip
                                        ? new DeviceReading.Unknown()
                                        : had.devices().get(i));
            }
        }
        List<DeviceReading> devices = simulated.robots().getFirst().devices();
        assertThat(devices.get(0))
                .as("it has left the thing, and is at the wall behind it")
                .isEqualTo(new DeviceReading.Pressed(List.of(false, true)));
        assertThat(((DeviceReading.Fiducials) devices.get(1)).seen())
                .extracting(DeviceReading.Fiducial::id)
                .containsExactly(7, 17);
        assertThat(simulated.robots().getFirst().intensities().getFirst()).contains(0.0, 1.0);
    }
}
