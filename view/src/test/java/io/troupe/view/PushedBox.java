package io.troupe.view;

import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/** A robot that pushes a box, which is obstacle 0, to the east. */
public final class PushedBox {
    public static final Scenario SCENARIO = ScenarioReader.readText("""
            name "push"
            interval_sim 100
            model ( name "box" color "red" pose [ 0.5 0 0 0 ] size [ 0.1 0.1 0.2 ] movable 1 mass 0.1 )
            model ( name "wall" color "black" pose [ 3 0 0 0 ] size [ 0.2 4 0.5 ] )
            model ( name "west wall" color "black" pose [ -1 0 0 0 ] size [ 0.2 4 0.5 ] )
            position
            (
              name "pusher" color "blue" size [ 0.4 0.4 0.2 ] mass 10
              ranger ( scount 2 spose[0] [ 0.2 0 0 ] spose[1] [ 0 0.2 90 ] )
              blobfinder ( image [ 80 60 ] range 4 fov 60 colors_count 1 colors [ "red" ] )
            )
            """, Path.of("push.world"));

    public static final WorldSpec WORLD = SCENARIO.world();

    private PushedBox() {}

    /** The start, then the snapshots of 60 intervals at 0.3 m/s. */
    public static List<Snapshot> run() {
        List<Snapshot> snapshots = new ArrayList<>();
        try (var world = World.create(WORLD, WorldSettings.defaults())) {
            snapshots.add(world.latest());
            world.command(0, 0.3, 0);
            for (int i = 0; i < 60; i++) {
                snapshots.add(world.advance());
            }
        }
        return snapshots;
    }
}
