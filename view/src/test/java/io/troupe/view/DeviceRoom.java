package io.troupe.view;

import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.GripperDevice;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * A robot with devices of all kinds, which carries a thing (obstacle 0) away, puts it down and drives backwards against
 * a wall; and another one that watches it with a finder.
 */
public final class DeviceRoom {
    public static final String TEXT = """
            name "devices"
            interval_sim 100
            model ( name "thing" color "red" pose [ 0.25 0.09 0 20 ] size [ 0.1 0.1 0.2 ] gripper_return 1 fiducial_return 7 )
            model ( name "lamp" color "yellow" pose [ 2 -0.8 0 0 ] size [ 0.2 0.2 0.5 ] laser_return 2 fiducial_return 17 )
            model ( name "east wall" color "black" pose [ 4 0 0 0 ] size [ 0.2 6 0.5 ] )
            model ( name "west wall" color "blue" pose [ -0.8 0 0 0 ] size [ 0.2 6 0.5 ] )
            position
            (
              name "collector" color "green" pose [ 0 0 0 20 ] size [ 0.4 0.4 0.2 ] fiducial_return 1
              laser ( range_max 8 fov 180 samples 19 )
              bumper ( bcount 2 blength 0.4 bpose[0] [ 0.2 0 0 0 ] bpose[1] [ -0.2 0 0 180 ] )
              fiducial ( range_max 8 range_max_id 5 fov 180 )
              gripper ( pose [ 0.24 0 0 0 ] size [ 0.2 0.3 0.2 ] )
              camera ( resolution [ 40 30 ] range [ 0.2 8 ] fov [ 70 50 ] )
            )
            position
            (
              name "watcher" color "orange" pose [ 1 2 0 -120 ] size [ 0.4 0.4 0.2 ]
              laser ( range_max 8 fov 180 samples 5 )
              fiducial ( range_max 8 range_max_id 2 fov 120 )
            )
            """;

    public static final Scenario SCENARIO = ScenarioReader.readText(TEXT, Path.of("devices.world"));

    public static final WorldSpec WORLD = SCENARIO.world();

    /** Index of the gripper among the devices of the first robot. */
    public static final int GRIPPER = 2;

    private DeviceRoom() {}

    /** The start, then the snapshots of 95 intervals. */
    public static List<Snapshot> run() {
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(WORLD, WorldSettings.defaults())) {
            snapshots.add(world.latest());
            for (int tick = 0; tick < 95; tick++) {
                command(world, tick);
                snapshots.add(world.advance());
            }
        }
        return snapshots;
    }

    /** Commands the world as in {@link #run}. */
    public static void command(World world, int tick) {
        switch (tick) {
            case 3 -> world.grip(0, GRIPPER, GripperDevice.Order.CLOSE);
            case 30 -> world.command(0, 0.3, 0.2);
            case 50 -> world.grip(0, GRIPPER, GripperDevice.Order.OPEN);
            case 60 -> world.command(0, -0.6, -0.1);
            default -> {}
        }
    }
}
