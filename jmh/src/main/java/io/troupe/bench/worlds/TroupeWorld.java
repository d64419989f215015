package io.troupe.bench.worlds;

import io.troupe.sim.SnapshotHash;
import io.troupe.sim.World;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.WorldView;
import io.troupe.sim.model.WorldSpec;

/** Our simulator with a controller inside its loop, which reads the view and needs no snapshots. */
final class TroupeWorld implements BenchWorld {
    private final World world;
    private final Readings readings;
    private final Wander wander;
    private final boolean driving;
    private final int robotCount;

    TroupeWorld(WorldSpec spec, boolean driving, int sensingThreads) {
        this.driving = driving;
        robotCount = spec.robots().size();
        readings = new Readings(robotCount);
        wander = new Wander(robotCount);
        world = World.create(spec, WorldSettings.DEFAULT.withSensingThreads(sensingThreads));
        take(world.view());
    }

    @Override
    public void advance(int intervals) {
        world.advance(intervals, this::control);
        take(world.view());
    }

    private void control(WorldView view) {
        if (driving) {
            take(view);
            for (int i = 0; i < robotCount; i++) {
                wander.decide(i, readings);
                view.command(i, wander.forwardMps[i], wander.turnRadps[i]);
            }
        }
    }

    private void take(WorldView view) {
        for (int i = 0; i < robotCount; i++) {
            for (int k = 0; k < TiledScene.SONARS; k++) {
                readings.setSonarM(i, k, rangeM(view, i, k));
            }
            readings.clearRuns(i);
            for (int k = 0; k < view.blobCount(i); k++) {
                readings.addRun(i, view.blobLeft(i, k), view.blobRight(i, k));
            }
        }
    }

    /** The range in the direction of a sonar; of a robot with a laser of half a turn only, ranges behind it are 5 m. */
    private static double rangeM(WorldView view, int robot, int sonar) {
        if (view.rangerCount(robot) == 0) {
            return view.rangeM(robot, sonar);
        }
        int fromRight = (sonar + TiledScene.SONARS / 4) % TiledScene.SONARS;
        int last = view.rangeCount(robot, 0) - 1;
        return fromRight > TiledScene.SONARS / 2
                ? TiledScene.SONAR_RANGE_M
                : view.rangeM(robot, 0, fromRight * last / (TiledScene.SONARS / 2));
    }

    /** Checksum over every bit of the latest readings. */
    String checksum() {
        var hash = new SnapshotHash();
        hash.update(world.view().snapshot());
        return hash.toString();
    }

    @Override
    public Readings readings() {
        return readings;
    }
}
