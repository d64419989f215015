package io.troupe.sim.physics;

import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.util.List;
import org.jbox2d.common.Settings;

/**
 * The fat boxes of a robot's polygons. While the polygons stay inside them, jbox2d finds no new contacts of a robot
 * that moves.
 */
final class FatBoxes {
    /** The polygon skin, and more than the error of single precision. */
    private static final double MARGIN_M = Settings.polygonRadius + 1e-3;
    /** More than the error of the sine table, for each metre from the centre of rotation. */
    static final double SINE_MARGIN = 2 * Settings.SINCOS_LUT_PRECISION;

    private final BodyCells cells;
    private final int[] proxies;
    private final Vertices vertices;

    /** The polygons of a shape, in the robot's frame; robots of one shape share them. */
    static final class Vertices {
        private final double[][] x; // by polygon
        private final double[][] y;
        private final double[] marginM;
        private final double radiusM;

        Vertices(Shape shape) {
            List<List<Point>> polygons = shape.polygons();
            x = new double[polygons.size()][];
            y = new double[polygons.size()][];
            marginM = new double[polygons.size()];
            double greatestM = 0;
            for (int i = 0; i < x.length; i++) {
                x[i] = polygons.get(i).stream().mapToDouble(Point::x).toArray();
                y[i] = polygons.get(i).stream().mapToDouble(Point::y).toArray();
                double radius = polygons.get(i).stream()
                        .mapToDouble(vertex -> StrictMath.hypot(vertex.x(), vertex.y()))
                        .max()
                        .orElse(0);
                marginM[i] = MARGIN_M + SINE_MARGIN * radius;
                greatestM = Math.max(greatestM, radius);
            }
            radiusM = greatestM;
        }
    }

    /** @param proxies by polygon */
    FatBoxes(BodyCells cells, int[] proxies, Vertices vertices) {
        this.cells = cells;
        this.proxies = proxies;
        this.vertices = vertices;
    }

    /** Distance of the farthest vertex from the centre of rotation. */
    double radiusM() {
        return vertices.radiusM;
    }

    /**
     * A distance that every point of a robot at this pose can move without leaving the boxes; negative if the boxes may
     * not enclose the robot.
     */
    double slackM(double robotX, double robotY, double cos, double sin) {
        double slackM = Double.POSITIVE_INFINITY;
        for (int i = 0; i < proxies.length; i++) {
            double marginM = vertices.marginM[i];
            double minX = cells.minX(proxies[i]) + marginM - robotX;
            double minY = cells.minY(proxies[i]) + marginM - robotY;
            double maxX = cells.maxX(proxies[i]) - marginM - robotX;
            double maxY = cells.maxY(proxies[i]) - marginM - robotY;
            double[] x = vertices.x[i];
            double[] y = vertices.y[i];
            for (int k = 0; k < x.length; k++) {
                double dx = cos * x[k] - sin * y[k];
                double dy = sin * x[k] + cos * y[k];
                slackM = Math.min(slackM, Math.min(Math.min(dx - minX, maxX - dx), Math.min(dy - minY, maxY - dy)));
            }
        }
        return slackM;
    }
}
