package io.troupe.sim.device;

import java.util.Arrays;

/** Edges that stop rays: from a start point along a vector, the body to the left; each belongs to a thing, known by number. */
final class Segments {
    double[] x = new double[64];
    double[] y = new double[64];
    double[] dx = new double[64];
    double[] dy = new double[64];
    int[] thing = new int[64];
    int[] carrier = new int[64]; // whose own rays pass
    int[] stops = new int[64]; // kinds of ray, as bits
    int count;

    void clear() {
        count = 0;
    }

    void add(Outline outline, int thingNumber, int rayKinds) {
        add(outline, thingNumber, thingNumber, rayKinds);
    }

    /** A thing that another one carries. */
    void add(Outline outline, int thingNumber, int carrierNumber, int rayKinds) {
        for (int p = 0; p < outline.rings().size(); p++) {
            Ring ring = outline.rings().get(p);
            for (int i = 0; i < ring.x.length; i++) {
                int j = ring.next(i);
                if (count == x.length) {
                    grow();
                }
                x[count] = ring.x[i];
                y[count] = ring.y[i];
                dx[count] = ring.x[j] - ring.x[i];
                dy[count] = ring.y[j] - ring.y[i];
                thing[count] = thingNumber;
                carrier[count] = carrierNumber;
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
        carrier = Arrays.copyOf(carrier, length);
        stops = Arrays.copyOf(stops, length);
    }
}
