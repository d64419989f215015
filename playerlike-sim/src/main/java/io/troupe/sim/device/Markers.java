package io.troupe.sim.device;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.stream.IntStream;

/** The markers of a world, sorted by x so that those near a finder are found quickly. */
final class Markers {
    /** A marker; {@code body} is -1 for that of an obstacle that stands still. */
    private record Marker(int thing, int body, int id, int key, Pose pose) {}

    private final Marker[] markers; // in the order of things
    private final double[] x;
    private final double[] y;
    private final double[] headingRad;
    private final int[] sorted; // numbers of markers, by x

    Markers(WorldSpec spec) {
        List<Marker> all = new ArrayList<>();
        List<Integer> movers = spec.movingObstacles();
        int thing = 0;
        for (ObstacleSpec obstacle : spec.obstacles()) {
            if (obstacle.traits().fiducial() != 0) {
                int mover = movers.indexOf(thing);
                all.add(new Marker(
                        thing,
                        mover < 0 ? -1 : spec.robots().size() + mover,
                        obstacle.traits().fiducial(),
                        obstacle.traits().fiducialKey(),
                        obstacle.pose()));
            }
            thing++;
        }
        for (int i = 0; i < spec.robots().size(); i++) {
            RobotSpec robot = spec.robots().get(i);
            if (robot.traits().fiducial() != 0) {
                all.add(new Marker(
                        thing + i, i, robot.traits().fiducial(), robot.traits().fiducialKey(), robot.pose()));
            }
        }
        markers = all.toArray(Marker[]::new);
        x = all.stream().mapToDouble(marker -> marker.pose().x()).toArray();
        y = all.stream().mapToDouble(marker -> marker.pose().y()).toArray();
        headingRad =
                all.stream().mapToDouble(marker -> marker.pose().headingRad()).toArray();
        sorted = IntStream.range(0, markers.length)
                .boxed()
                .sorted(Comparator.comparingDouble(i -> x[i]))
                .mapToInt(Integer::intValue)
                .toArray();
    }

    int count() {
        return markers.length;
    }

    /** Moves the markers of robots and of things that move to where these are now. */
    void refresh(Scene scene) {
        for (int i = 0; i < markers.length; i++) {
            int body = markers[i].body;
            if (body >= 0) {
                x[i] = scene.isThere(body) ? scene.x(body) : Double.POSITIVE_INFINITY;
                y[i] = scene.y(body);
                headingRad[i] = scene.headingRad(body);
            }
        }
        for (int i = 1; i < sorted.length; i++) { // by insertion: few change places from one time to the next
            int marker = sorted[i];
            int to = i;
            while (to > 0 && x[sorted[to - 1]] > x[marker]) {
                sorted[to] = sorted[to - 1];
                to--;
            }
            sorted[to] = marker;
        }
    }

    /** Finds the markers at most so far away along x; they are put into the array, in the order of things. */
    int within(double fromX, double rangeM, int[] into) {
        int count = 0;
        for (int i = firstFrom(fromX - rangeM); i < sorted.length && x[sorted[i]] <= fromX + rangeM; i++) {
            into[count++] = sorted[i];
        }
        Arrays.sort(into, 0, count);
        return count;
    }

    private int firstFrom(double leastX) {
        int low = 0;
        int high = sorted.length;
        while (low < high) {
            int middle = (low + high) >>> 1;
            if (x[sorted[middle]] < leastX) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }

    double x(int marker) {
        return x[marker];
    }

    double y(int marker) {
        return y[marker];
    }

    double headingRad(int marker) {
        return headingRad[marker];
    }

    int id(int marker) {
        return markers[marker].id;
    }

    int key(int marker) {
        return markers[marker].key;
    }

    int thing(int marker) {
        return markers[marker].thing;
    }
}
