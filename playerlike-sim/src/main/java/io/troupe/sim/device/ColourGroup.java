package io.troupe.sim.device;

import java.util.Arrays;
import java.util.Comparator;
import java.util.List;

/**
 * The visible things of one colour, each with a bounding circle, sorted by x so that those near a camera are found
 * quickly.
 */
final class ColourGroup {
    /** Added to the radius of every circle; far larger than rounding errors. */
    private static final double MARGIN_M = 1e-6;

    final int colour;
    private final BoundingCircles circles;
    private final int[] things;
    private final double[] x; // sorted
    private final double greatestRadiusM;

    ColourGroup(int colour, List<Integer> members, BoundingCircles circles) {
        this.colour = colour;
        this.circles = circles;
        things = members.stream()
                .sorted(Comparator.comparingDouble(thing -> circles.x[thing]))
                .mapToInt(Integer::intValue)
                .toArray();
        x = Arrays.stream(things).mapToDouble(thing -> circles.x[thing]).toArray();
        greatestRadiusM = Arrays.stream(things)
                        .mapToDouble(thing -> circles.radiusM[thing])
                        .max()
                        .orElse(0)
                + MARGIN_M;
    }

    /** Sorts again after things have moved, by insertion: few change places from one time to the next. */
    void sort() {
        for (int i = 0; i < things.length; i++) {
            int thing = things[i];
            double thingX = circles.x[thing];
            int to = i;
            while (to > 0 && x[to - 1] > thingX) {
                x[to] = x[to - 1];
                things[to] = things[to - 1];
                to--;
            }
            x[to] = thingX;
            things[to] = thing;
        }
    }

    /**
     * Marks the rays of a camera that may meet one of the things within range. It may mark too many rays, never too
     * few.
     */
    void mark(Camera camera, boolean[] wanted) {
        double reachM = camera.rangeM + greatestRadiusM;
        double lastX = camera.x + reachM;
        for (int i = firstFrom(camera.x - reachM); i < x.length && x[i] <= lastX; i++) {
            int thing = things[i];
            if (thing != camera.carrier) {
                camera.mark(x[i] - camera.x, circles.y[thing] - camera.y, circles.radiusM[thing] + MARGIN_M, wanted);
            }
        }
    }

    private int firstFrom(double leastX) {
        int low = 0;
        int high = x.length;
        while (low < high) {
            int middle = (low + high) >>> 1;
            if (x[middle] < leastX) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low;
    }
}
