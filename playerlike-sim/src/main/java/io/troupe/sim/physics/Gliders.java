package io.troupe.sim.physics;

import io.troupe.sim.numeric.Direction;
import java.util.List;
import org.jbox2d.collision.shapes.PolygonShape;
import org.jbox2d.dynamics.Fixture;
import org.jbox2d.dynamics.contacts.Contact;
import org.jbox2d.dynamics.contacts.ContactEdge;

/**
 * Decides which robots jbox2d has to move in a step, and lets the others glide.
 *
 * <p><b>Rule.</b> A robot glides if none of its contacts touches, none can touch before the advance is over, and none
 * of its contacts is with a robot that jbox2d moves. It glides as long as it stays in its fat boxes: until then, jbox2d
 * would find no new contact from its side. A contact that another robot finds is checked in the next step, and ends the
 * glide if the two may touch: the robot then goes back to where it was in that step.
 *
 * <p><b>Order.</b> {@link #begin}, then {@link #select} for each step.
 */
final class Gliders {
    /**
     * jbox2d's polygons touch at this gap. The rest is larger than the errors of single precision; those of the sine
     * table are added by radius.
     */
    private static final double TOUCHING_M = Physics.SKIN_M + 2e-3;

    private final List<RobotBody> robots;
    private final int robotCount;
    private final BodyCells cells;
    private final int[] startedAt; // step in which the robot began to glide
    private final int[] glidesUntil; // first step of the advance that jbox2d has to make
    private final boolean[] near; // may touch something in this advance
    private final int[] awake;
    private int awakeCount;
    private final int[] toWake;
    private int toWakeCount;
    private int steps;
    private final Gap gap = new Gap();
    private final Place mine = new Place();
    private final Place theirs = new Place();

    Gliders(List<RobotBody> robots, int robotCount, BodyCells cells) {
        this.robots = robots;
        this.robotCount = robotCount;
        this.cells = cells;
        startedAt = new int[robotCount];
        glidesUntil = new int[robotCount];
        near = new boolean[robotCount];
        awake = new int[robotCount];
        toWake = new int[robotCount];
    }

    /** Number of robots that jbox2d moves in this step. */
    int awakeCount() {
        return awakeCount;
    }

    /** Index of a robot that jbox2d moves in this step; they are in ascending order. */
    int awake(int i) {
        return awake[i];
    }

    /** Begins an advance. */
    void begin(int stepsOfAdvance) {
        steps = stepsOfAdvance;
        for (int i = 0; i < robotCount; i++) {
            glidesUntil[i] = 0;
            near[i] = false;
        }
    }

    /** Selects the robots that jbox2d moves in a step; the others have made it already. */
    void select(int step, boolean mayGlide) {
        collect(step);
        if (!mayGlide || awakeCount == 0) {
            return;
        }
        for (int i = 0; i < awakeCount; i++) {
            letGlide(awake[i], step);
        }
        collect(step);
        if (awakeCount > 0 && wakeNeighbours(step)) {
            collect(step);
        }
    }

    private void collect(int step) {
        awakeCount = 0;
        for (int i = 0; i < robotCount; i++) {
            if (glidesUntil[i] <= step) {
                awake[awakeCount++] = i;
            }
        }
    }

    private void letGlide(int robot, int step) {
        if (near[robot]) {
            return;
        }
        RobotBody body = robots.get(robot);
        if (body.body().m_contactList != null && !staysClear(robot, body, step)) {
            near[robot] = true;
            return;
        }
        startedAt[robot] = step;
        glidesUntil[robot] = step + body.glide(steps - step);
    }

    /** True if the robot touches nothing in the rest of the advance that it has a contact with. */
    private boolean staysClear(int robot, RobotBody body, int step) {
        if (body.isHeld()) {
            return false;
        }
        int left = steps - step;
        mine.set(body.x(), body.y(), body.headingRad());
        for (ContactEdge edge = body.body().m_contactList; edge != null; edge = edge.next) {
            Contact contact = edge.contact;
            if (contact.isTouching() || !overlap(contact)) { // jbox2d drops contacts whose boxes are apart
                return false;
            }
            double reachM = body.travelM() * left + FatBoxes.SINE_MARGIN * body.radiusM();
            int id = (Integer) edge.other.getUserData();
            if (id < robotCount) {
                RobotBody other = robots.get(id);
                boolean glides = glidesUntil[id] > step;
                if (near[id] && !other.isHeld()) {
                    return false;
                }
                if (glides) {
                    theirs.set(other.startX(), other.startY(), other.startHeadingRad());
                } else {
                    theirs.set(other.x(), other.y(), other.headingRad());
                }
                int theirSteps = other.isHeld() ? 0 : glides ? steps - startedAt[id] : left;
                reachM += other.travelM() * theirSteps + FatBoxes.SINE_MARGIN * other.radiusM();
            } else {
                theirs.set(edge.other.getPosition().x, edge.other.getPosition().y, 0);
            }
            boolean mineIsA = contact.getFixtureA().getBody() == body.body();
            Fixture ours = mineIsA ? contact.getFixtureA() : contact.getFixtureB();
            Fixture others = mineIsA ? contact.getFixtureB() : contact.getFixtureA();
            if (!gap.exceeds(
                    TOUCHING_M + reachM,
                    (PolygonShape) ours.getShape(),
                    mine,
                    (PolygonShape) others.getShape(),
                    theirs)) {
                return false;
            }
        }
        sleepOn(body, step);
        return true;
    }

    /** jbox2d wakes both bodies of a new contact. */
    private void sleepOn(RobotBody body, int step) {
        for (ContactEdge edge = body.body().m_contactList; edge != null; edge = edge.next) {
            int id = (Integer) edge.other.getUserData();
            if (id < robotCount && glidesUntil[id] > step && edge.other.isAwake()) {
                edge.other.setAwake(false);
            }
        }
    }

    private boolean overlap(Contact contact) {
        return cells.overlap((Integer) contact.getFixtureA().getUserData(), (Integer)
                contact.getFixtureB().getUserData());
    }

    /** Ends the glides of all robots that have a contact with one that jbox2d moves, and so on. */
    private boolean wakeNeighbours(int step) {
        boolean woken = false;
        toWakeCount = 0;
        for (int i = 0; i < awakeCount; i++) {
            toWake[toWakeCount++] = awake[i];
        }
        while (toWakeCount > 0) {
            int robot = toWake[--toWakeCount];
            RobotBody body = robots.get(robot);
            if (body.isHeld()) {
                continue;
            }
            for (ContactEdge edge = body.body().m_contactList; edge != null; edge = edge.next) {
                int id = (Integer) edge.other.getUserData();
                if (id < robotCount && glidesUntil[id] > step) {
                    robots.get(id).glideOnly(step - startedAt[id]);
                    glidesUntil[id] = step;
                    near[id] |= near[robot];
                    toWake[toWakeCount++] = id;
                    woken = true;
                }
            }
        }
        return woken;
    }

    /** A place of a body and its direction. */
    private static final class Place {
        private final Direction direction = new Direction();
        private double x;
        private double y;

        void set(double newX, double newY, double headingRad) {
            x = newX;
            y = newY;
            direction.set(headingRad);
        }
    }

    /** Compares the gap between two convex polygons with a distance. */
    private static final class Gap {
        private final double[] x = new double[16];
        private final double[] y = new double[16];

        /** True if the gap is certainly larger. */
        boolean exceeds(double distanceM, PolygonShape a, Place atA, PolygonShape b, Place atB) {
            return hasEdgeBetween(distanceM, b, atB, a, atA) || hasEdgeBetween(distanceM, a, atA, b, atB);
        }

        /** True if all of the other polygon is farther than this from the line through one edge, on its outer side. */
        private boolean hasEdgeBetween(
                double distanceM, PolygonShape shape, Place at, PolygonShape other, Place atOther) {
            double cos = at.direction.cos();
            double sin = at.direction.sin();
            double otherCos = atOther.direction.cos();
            double otherSin = atOther.direction.sin();
            int count = other.getVertexCount();
            for (int i = 0; i < count; i++) { // into the frame of the shape
                double vertexX = other.getVertex(i).x;
                double vertexY = other.getVertex(i).y;
                double dx = atOther.x + otherCos * vertexX - otherSin * vertexY - at.x;
                double dy = atOther.y + otherSin * vertexX + otherCos * vertexY - at.y;
                x[i] = cos * dx + sin * dy;
                y[i] = cos * dy - sin * dx;
            }
            for (int edge = 0; edge < shape.getVertexCount(); edge++) {
                double normalX = shape.getNormals()[edge].x;
                double normalY = shape.getNormals()[edge].y;
                double along = normalX * shape.getVertex(edge).x + normalY * shape.getVertex(edge).y + distanceM;
                int beyond = 0;
                while (beyond < count && normalX * x[beyond] + normalY * y[beyond] > along) {
                    beyond++;
                }
                if (beyond == count) {
                    return true;
                }
            }
            return false;
        }
    }
}
