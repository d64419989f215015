package io.troupe.view;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.RobotReading;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Scene;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.WorldSpec;
import org.junit.jupiter.api.Test;

/** Readings that are computed from a pose alone. */
class ComputedSensorsTest {
    @Test
    void readings_areThoseOfTheSimulation_atTheSamePose() {
        WorldSpec world = PushedBox.WORLD;
        RobotReading simulated;
        try (var simulation = World.create(world, WorldSettings.DEFAULT)) {
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
}
