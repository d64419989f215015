package io.troupe.bench.worlds;

import static java.util.Objects.requireNonNull;

import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.device.Blob;
import io.troupe.sim.scenario.WorldSpec;
import java.util.List;

/** Our simulator, as a program in the same JVM uses it: commands in, snapshots out. */
final class TroupeWorld implements BenchWorld {
    private final World world;
    private final Readings readings;
    private final Wander wander;
    private final boolean driving;
    private final int robotCount;

    TroupeWorld(WorldSpec spec, boolean driving) {
        this.driving = driving;
        robotCount = spec.robots().size();
        readings = new Readings(robotCount);
        wander = new Wander(robotCount);
        world = World.create(spec, WorldSettings.DEFAULT);
        take(world.latest());
    }

    @Override
    public void advance() {
        if (driving) {
            for (int i = 0; i < robotCount; i++) {
                wander.decide(i, readings);
                world.command(i, wander.forwardMps[i], wander.turnRadps[i]);
            }
        }
        take(world.advance());
    }

    private void take(Snapshot snapshot) {
        List<RobotReading> robots = snapshot.robots();
        for (int i = 0; i < robotCount; i++) {
            RobotReading robot = robots.get(i);
            List<Double> sonarM = requireNonNull(robot.sonarM());
            for (int k = 0; k < TiledScene.SONARS; k++) {
                readings.setSonarM(i, k, sonarM.get(k));
            }
            readings.clearRuns(i);
            for (Blob blob : requireNonNull(robot.blobs()).blobs()) {
                if (TiledScene.isColoured(blob.colour())) {
                    readings.addRun(i, blob.left(), blob.right());
                }
            }
        }
    }

    @Override
    public Readings readings() {
        return readings;
    }
}
