package io.troupe.sim.device;

import java.util.Arrays;

/** Edges that stop rays: from a start point along a vector, the body to the left; each belongs to a thing, known by number. */
final class Segments {
    double[] x = new double[64];
    double[] y = new double[64];
    double[] dx = new double[64];
    double[] dy = new double[64];
    int[] thing = new int[64];
    int[] stops = new int[64]; // kinds of ray, as bits
    int count;

    void clear() {
        count = 0;
    }

    void add(Outline outline, int thingNumber, int rayKinds) {
        for (int p = 0; p < outline.polygons().size(); p++) {
            ConvexPolygon polygon = outline.polygons().get(p);
            for (int i = 0; i < polygon.x.length; i++) {
                int j = polygon.next(i);
                if (count == x.length) {
                    grow();
                }
                x[count] = polygon.x[i];
                y[count] = polygon.y[i];
                dx[count] = polygon.x[j] - polygon.x[i];
                dy[count] = polygon.y[j] - polygon.y[i];
                thing[count] = thingNumber;
                stops[count] = rayKinds;
                count++;
            }
        }
    }

    private void grow() {
        int length = 2 * count;
        x = Arrays.copyOf(x, length);
        y = Arrays.copyOf(y, length);
        dx = Arrays.copyOf(dx, length);
        dy = Arrays.copyOf(dy, length);
        thing = Arrays.copyOf(thing, length);
        stops = Arrays.copyOf(stops, length);
    }
}
