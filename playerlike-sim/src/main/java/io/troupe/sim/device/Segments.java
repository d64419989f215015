package io.troupe.sim.device;

import java.util.Arrays;

/**
 * Edges that stop rays: a start point and a vector, with the body to the left. Each belongs to a thing, identified by
 * number.
 *
 * <p>The coordinates of one edge are adjacent in memory, because ray casting is bound by memory access.
 */
final class Segments {
    /** {@code x, y, dx, dy} of segment {@code s} begin at {@code FIELDS * s}. */
    static final int FIELDS = 4;

    private static final int KINDS = 3; // bits of Ray.RANGE, Ray.SIGHT and Ray.GRIP

    double[] geometry = new double[64 * FIELDS];
    private int[] tags = new int[64]; // carrier, whose own rays pass, and the kinds of ray that the segment stops
    private int[] things = new int[64];
    int count;

    void clear() {
        count = 0;
    }

    void add(Outline outline, int thing, int rayKinds) {
        add(outline, thing, thing, rayKinds);
    }

    /** Adds the outline of a thing that another one carries. */
    void add(Outline outline, int thing, int carrier, int rayKinds) {
        for (int p = 0; p < outline.rings().size(); p++) {
            Ring ring = outline.rings().get(p);
            for (int i = 0; i < ring.x.length; i++) {
                int j = ring.next(i);
                if (count == tags.length) {
                    tags = Arrays.copyOf(tags, 2 * count);
                    things = Arrays.copyOf(things, 2 * count);
                    geometry = Arrays.copyOf(geometry, 2 * count * FIELDS);
                }
                int at = count * FIELDS;
                geometry[at] = ring.x[i];
                geometry[at + 1] = ring.y[i];
                geometry[at + 2] = ring.x[j] - ring.x[i];
                geometry[at + 3] = ring.y[j] - ring.y[i];
                tags[count] = carrier << KINDS | rayKinds;
                things[count] = thing;
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
        return things[s];
    }

    /** True if a ray of this kind ends at the segment. Segments with the ignored carrier stop no ray. */
    boolean stops(int s, int kind, int ignored) {
        return (tags[s] & kind) != 0 && tags[s] >> KINDS != ignored;
    }
}
