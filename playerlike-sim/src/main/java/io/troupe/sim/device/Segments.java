package io.troupe.sim.device;

import java.util.Arrays;

/**
 * Edges that stop rays: from a start point along a vector, the body to the left; each belongs to a thing, known by number.
 *
 * <p>What a ray needs of one edge lies together in memory: rays spend most of their time waiting for it.
 */
final class Segments {
    /** {@code x, y, dx, dy} of segment {@code s} begin at {@code FIELDS * s}. */
    static final int FIELDS = 4;

    private static final int KINDS = 2; // bits of Ray.RANGE and Ray.SIGHT

    double[] geometry = new double[64 * FIELDS];
    private int[] tags = new int[64]; // the thing, and the kinds of ray it stops
    int count;

    void clear() {
        count = 0;
    }

    void add(Outline outline, int thing, int rayKinds) {
        for (int p = 0; p < outline.polygons().size(); p++) {
            ConvexPolygon polygon = outline.polygons().get(p);
            for (int i = 0; i < polygon.x.length; i++) {
                int j = polygon.next(i);
                if (count == tags.length) {
                    tags = Arrays.copyOf(tags, 2 * count);
                    geometry = Arrays.copyOf(geometry, 2 * count * FIELDS);
                }
                int at = count * FIELDS;
                geometry[at] = polygon.x[i];
                geometry[at + 1] = polygon.y[i];
                geometry[at + 2] = polygon.x[j] - polygon.x[i];
                geometry[at + 3] = polygon.y[j] - polygon.y[i];
                tags[count] = thing << KINDS | rayKinds;
                count++;
            }
        }
    }

    double x(int s) {
        return geometry[FIELDS * s];
    }

    double y(int s) {
        return geometry[FIELDS * s + 1];
    }

    double dx(int s) {
        return geometry[FIELDS * s + 2];
    }

    double dy(int s) {
        return geometry[FIELDS * s + 3];
    }

    int thing(int s) {
        return tags[s] >> KINDS;
    }

    /** Whether a ray of this kind ends here, if it does not ignore this thing. */
    boolean stops(int s, int kind, int ignored) {
        return (tags[s] & kind) != 0 && tags[s] >> KINDS != ignored;
    }
}
