package io.troupe.sim.physics;

import io.troupe.sim.model.Point;
import io.troupe.sim.model.Shape;
import java.util.List;
import org.jbox2d.collision.AABB;
import org.jbox2d.common.Settings;

/**
 * The fat boxes of a robot's polygons in the tree. While the polygons stay inside them, jbox2d finds no new contacts.
 */
final class FatBoxes {
    /** The polygon skin, and more than the error of single precision. */
    private static final double MARGIN_M = Settings.polygonRadius + 1e-3;
    /** More than the error of the sine table, for each metre from the centre of rotation. */
    private static final double SINE_MARGIN = 2 * Settings.SINCOS_LUT_PRECISION;

    private final RepairedTree tree;
    private final int[] proxies;
    private final double[][] x; // of the vertices, by polygon, in the robot's frame
    private final double[][] y;
    private final double[] marginM; // by polygon

    /** @param proxies by polygon */
    FatBoxes(RepairedTree tree, int[] proxies, Shape shape) {
        this.tree = tree;
        this.proxies = proxies;
        List<List<Point>> polygons = shape.polygons();
        x = new double[polygons.size()][];
        y = new double[polygons.size()][];
        marginM = new double[polygons.size()];
        for (int i = 0; i < x.length; i++) {
            x[i] = polygons.get(i).stream().mapToDouble(Point::x).toArray();
            y[i] = polygons.get(i).stream().mapToDouble(Point::y).toArray();
            double radiusM = polygons.get(i).stream()
                    .mapToDouble(vertex -> StrictMath.hypot(vertex.x(), vertex.y()))
                    .max()
                    .orElse(0);
            marginM[i] = MARGIN_M + SINE_MARGIN * radiusM;
        }
    }

    /** True if the boxes certainly enclose the robot at this pose. */
    boolean hold(double robotX, double robotY, double cos, double sin) {
        for (int i = 0; i < proxies.length; i++) {
            AABB box = tree.getFatAABB(proxies[i]);
            double minX = box.lowerBound.x + marginM[i] - robotX;
            double minY = box.lowerBound.y + marginM[i] - robotY;
            double maxX = box.upperBound.x - marginM[i] - robotX;
            double maxY = box.upperBound.y - marginM[i] - robotY;
            for (int k = 0; k < x[i].length; k++) {
                double dx = cos * x[i][k] - sin * y[i][k];
                double dy = sin * x[i][k] + cos * y[i][k];
                if (dx < minX || dx > maxX || dy < minY || dy > maxY) {
                    return false;
                }
            }
        }
        return true;
    }
}
