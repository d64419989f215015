package io.troupe.sim.physics;

import java.util.Arrays;
import org.jbox2d.callbacks.ContactImpulse;
import org.jbox2d.callbacks.ContactListener;
import org.jbox2d.collision.Manifold;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.contacts.Contact;

/**
 * Tracks which bodies touch. Bodies have ids: robots from 0, obstacles after them.
 *
 * <p>jbox2d reports contacts of fixtures, and does so inside its step, where its world must not be changed. The
 * callbacks therefore only write to a buffer, and {@link #settle} converts it into pairs of bodies after the step. Two
 * bodies touch once, however many of their polygons do.
 */
final class TouchTracker implements ContactListener {
    private static final long END = 1L << 63;

    private final TouchingPairs open = new TouchingPairs();
    private final Touches begun;
    private final boolean[] touched;
    private long[] buffer = new long[64];
    private int buffered;
    private long[] started = new long[64];
    private int startedCount;
    private boolean recent; // the last step had contact events, so `touched` may contain a touch that has ended

    TouchTracker(int robotCount) {
        touched = new boolean[robotCount];
        begun = new Touches(robotCount);
    }

    @Override
    public void beginContact(Contact contact) {
        append(pair(contact));
    }

    @Override
    public void endContact(Contact contact) {
        append(pair(contact) | END);
    }

    @Override
    public void preSolve(Contact contact, Manifold oldManifold) {}

    @Override
    public void postSolve(Contact contact, ContactImpulse impulse) {}

    private void append(long event) {
        if (buffered == buffer.length) {
            buffer = Arrays.copyOf(buffer, 2 * buffered);
        }
        buffer[buffered++] = event;
    }

    private static long pair(Contact contact) {
        int a = id(contact.getFixtureA().getBody());
        int b = id(contact.getFixtureB().getBody());
        return (long) Math.min(a, b) << 32 | Math.max(a, b);
    }

    private static int id(Body body) {
        return (Integer) body.getUserData();
    }

    /** Processes the contact events of the step that ended at this time. */
    void settle(long timeMicros) {
        if (buffered == 0 && !recent) {
            return;
        }
        recent = buffered > 0;
        open.remember();
        startedCount = 0;
        Arrays.fill(touched, false);
        for (int i = 0; i < buffered; i++) {
            take(buffer[i]);
        }
        buffered = 0;
        for (int i = 0; i < open.size(); i++) {
            mark(open.pair(i));
        }
        Arrays.sort(started, 0, startedCount);
        for (int i = 0; i < startedCount; i++) {
            if (i == 0 || started[i] != started[i - 1]) {
                begun.add(timeMicros, started[i]);
            }
        }
    }

    private void take(long event) {
        long pair = event & ~END;
        mark(pair);
        if (event < 0) {
            open.end(pair);
            return;
        }
        open.begin(pair);
        if (!open.touchedBefore(pair)) {
            if (startedCount == started.length) {
                started = Arrays.copyOf(started, 2 * startedCount);
            }
            started[startedCount++] = pair;
        }
    }

    private void mark(long pair) {
        touched[(int) (pair >> 32)] = true;
        if ((int) pair < touched.length) {
            touched[(int) pair] = true;
        }
    }

    /** True if anything touched the robot in the last step. */
    boolean touched(int robot) {
        return touched[robot];
    }

    Touches begun() {
        return begun;
    }

    /** Sorted pairs of touching bodies, with the number of polygon contacts of each pair. */
    private static final class TouchingPairs {
        private long[] pairs = new long[64];
        private int[] counts = new int[64];
        private long[] before = new long[64]; // the pairs at the last call of `remember`
        private int size;
        private int sizeBefore;

        int size() {
            return size;
        }

        long pair(int i) {
            return pairs[i];
        }

        void remember() {
            if (before.length < size) {
                before = new long[pairs.length];
            }
            System.arraycopy(pairs, 0, before, 0, size);
            sizeBefore = size;
        }

        /** True if the bodies touched at the last call of {@link #remember}. */
        boolean touchedBefore(long pair) {
            return Arrays.binarySearch(before, 0, sizeBefore, pair) >= 0;
        }

        void begin(long pair) {
            int at = Arrays.binarySearch(pairs, 0, size, pair);
            if (at >= 0) {
                counts[at]++;
                return;
            }
            if (size == pairs.length) {
                pairs = Arrays.copyOf(pairs, 2 * size);
                counts = Arrays.copyOf(counts, 2 * size);
            }
            int to = -at - 1;
            System.arraycopy(pairs, to, pairs, to + 1, size - to);
            System.arraycopy(counts, to, counts, to + 1, size - to);
            pairs[to] = pair;
            counts[to] = 1;
            size++;
        }

        void end(long pair) {
            int at = Arrays.binarySearch(pairs, 0, size, pair);
            if (at >= 0 && --counts[at] == 0) {
                size--;
                System.arraycopy(pairs, at + 1, pairs, at, size - at);
                System.arraycopy(counts, at + 1, counts, at, size - at);
            }
        }
    }
}
