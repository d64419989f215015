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
    private final boolean hasLasers; // instead of sonars

    TroupeWorld(WorldSpec spec, boolean driving, int sensingThreads) {
        this.driving = driving;
        robotCount = spec.robots().size();
        wander = new Wander(robotCount);
        world = World.create(spec, WorldSettings.defaults().withSensingThreads(sensingThreads));
        WorldView view = world.view();
        hasLasers = view.rangerCount(0) > 0;
        readings = new Readings(robotCount, hasLasers ? view.rangeCount(0, 0) : TiledScene.SONARS);
        take(view);
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
            for (int k = 0; k < readings.rays; k++) {
                readings.setRangeM(i, k, hasLasers ? view.rangeM(i, 0, k) : view.rangeM(i, k));
            }
            readings.clearRuns(i);
            for (int k = 0; k < view.blobCount(i); k++) {
                readings.addRun(i, view.blobLeft(i, k), view.blobRight(i, k));
            }
        }
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
