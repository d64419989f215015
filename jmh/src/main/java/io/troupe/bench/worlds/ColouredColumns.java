package io.troupe.bench.worlds;

import io.troupe.sim.scenario.BlobfinderSpec;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.WorldSpec;
import java.util.Arrays;
import java.util.List;

/** The columns of an image in which a coloured object can be, if nothing hides it. The other columns need no ray. */
final class ColouredColumns {
    private final double[] x;
    private final double[] y;
    private final double halfFovRad;
    private final double columnRad;
    private final boolean[] possible = new boolean[TiledScene.COLUMNS];

    ColouredColumns(WorldSpec spec, BlobfinderSpec camera) {
        List<ObstacleSpec> objects = spec.obstacles().stream()
                .filter(each -> TiledScene.isColoured(each.colour()))
                .toList();
        x = objects.stream().mapToDouble(each -> each.pose().x()).toArray();
        y = objects.stream().mapToDouble(each -> each.pose().y()).toArray();
        halfFovRad = camera.fovRad() / 2;
        columnRad = camera.fovRad() / camera.widthPx();
    }

    /** Finds the columns for a position and a direction. */
    void seek(double fromX, double fromY, double cos, double sin) {
        Arrays.fill(possible, false);
        double reachM = TiledScene.CAMERA_RANGE_M + TiledScene.COLOURED_RADIUS_M;
        for (int i = 0; i < x.length; i++) {
            double dx = x[i] - fromX;
            double dy = y[i] - fromY;
            double squareM2 = dx * dx + dy * dy;
            if (squareM2 < reachM * reachM) {
                double ahead = dx * cos + dy * sin;
                double aside = dy * cos - dx * sin;
                mark(Math.atan2(aside, ahead), Math.sqrt(squareM2));
            }
        }
    }

    private void mark(double leftRad, double distanceM) {
        double halfRad = distanceM <= TiledScene.COLOURED_RADIUS_M
                ? Math.PI
                : Math.asin(TiledScene.COLOURED_RADIUS_M / distanceM);
        int first = (int) Math.floor((halfFovRad - leftRad - halfRad) / columnRad) - 1;
        int last = (int) Math.ceil((halfFovRad - leftRad + halfRad) / columnRad) + 1;
        for (int k = Math.max(0, first); k <= Math.min(possible.length - 1, last); k++) {
            possible[k] = true;
        }
    }

    boolean isPossible(int column) {
        return possible[column];
    }
}
