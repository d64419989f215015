package io.troupe.sim.physics;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.TreeMap;
import java.util.TreeSet;
import org.jbox2d.callbacks.ContactImpulse;
import org.jbox2d.callbacks.ContactListener;
import org.jbox2d.collision.Manifold;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.contacts.Contact;

/**
 * Who touches whom. Bodies are known by id: robots from 0, obstacles after them.
 *
 * <p>jbox2d reports fixtures, and inside its step, where its world must be left alone: the callbacks only write to a buffer, and
 * {@link #settle} afterwards turns it into pairs of bodies. A body of several polygons touches once, however many of them do.
 */
final class TouchLedger implements ContactListener {
    private static final long END = 1L << 63;

    private final TreeMap<Long, Integer> open = new TreeMap<>();
    private final List<Touch> begun = new ArrayList<>();
    private final boolean[] touched;
    private long[] buffer = new long[64];
    private int buffered;
    private boolean recent; // the last step changed something, so that `touched` may hold a touch that is over

    TouchLedger(int robotCount) {
        touched = new boolean[robotCount];
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

    /** Takes over what happened in the step that ended at this time. */
    void settle(long timeMicros) {
        if (buffered == 0 && !recent) {
            return;
        }
        recent = buffered > 0;
        var before = new TreeSet<>(open.keySet());
        var started = new TreeSet<Long>();
        Arrays.fill(touched, false);
        for (int i = 0; i < buffered; i++) {
            long pair = buffer[i] & ~END;
            mark(pair);
            if (buffer[i] < 0) {
                open.computeIfPresent(pair, (p, count) -> count == 1 ? null : count - 1);
            } else {
                open.merge(pair, 1, Integer::sum);
                started.add(pair);
            }
        }
        buffered = 0;
        open.keySet().forEach(this::mark);
        started.removeAll(before);
        for (long pair : started) {
            int second = (int) pair;
            boolean robot = second < touched.length;
            begun.add(new Touch(
                    timeMicros, (int) (pair >> 32), robot ? second : -1, robot ? -1 : second - touched.length));
        }
    }

    private void mark(long pair) {
        touched[(int) (pair >> 32)] = true;
        if ((int) pair < touched.length) {
            touched[(int) pair] = true;
        }
    }

    /** Whether anything touched the robot in the last step. */
    boolean touched(int robot) {
        return touched[robot];
    }

    /** The touches that began since the last call, ordered by (time, robot, other robot, obstacle). */
    List<Touch> drain() {
        List<Touch> drained = List.copyOf(begun);
        begun.clear();
        return drained;
    }
}
