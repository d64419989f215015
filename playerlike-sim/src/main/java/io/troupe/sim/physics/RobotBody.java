package io.troupe.sim.physics;

import io.troupe.sim.model.Pose;
import io.troupe.sim.numeric.Direction;
import org.jbox2d.collision.shapes.MassData;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyType;

/**
 * The body of one robot in jbox2d.
 *
 * <p>jbox2d computes in {@code float}, so its positions drift. This class keeps the pose of the centre of rotation in
 * {@code double}. While nothing touches the robot, each step aims the body exactly at the next point of the commanded
 * arc, and the pose is that point. While something touches it, the pose follows the body.
 */
final class RobotBody {
    private static final double FULL_TURN_RAD = 2 * StrictMath.PI;

    /** Largest move or turn (metres or radians) of a gliding step, far below jbox2d's limits. */
    private static final float MOST_GLIDE = 0.5f;

    private final Body body;
    private final FatBoxes fatBoxes;
    private final float physicsStepS; // in float, as jbox2d uses it
    private final double stepS;
    private final double centreX; // centre of mass, in the robot's frame
    private final double centreY;
    private final StallMeter stallMeter;
    private final MassData mass = new MassData();
    private final Vec2 velocity = new Vec2();
    private final Direction halfTurn = new Direction();
    private final Direction chordDirection = new Direction();
    private final Direction bodyDirection = new Direction();

    private double x;
    private double y;
    private double headingRad;
    private double turnRadps;
    private double halfTurnRad; // of one step
    private double chordM;
    private double aimX;
    private double aimY;
    private double aimHeadingRad;
    private boolean transformIsStale;
    private boolean placed; // teleported since the last step
    private boolean held; // in place, because it overlaps something

    RobotBody(Body body, FatBoxes fatBoxes, Pose pose, int stepMicros) {
        this.body = body;
        this.fatBoxes = fatBoxes;
        physicsStepS = stepMicros / 1e6f;
        stepS = stepMicros / 1e6;
        centreX = body.getLocalCenter().x;
        centreY = body.getLocalCenter().y;
        body.getMassData(mass);
        stallMeter = new StallMeter(stepMicros);
        x = pose.x();
        y = pose.y();
        headingRad = wrap(pose.headingRad());
    }

    void drive(double forwardMps, double turnRadps) {
        this.turnRadps = turnRadps;
        halfTurnRad = turnRadps * stepS / 2;
        halfTurn.set(halfTurnRad);
        chordM = forwardMps * stepS * (halfTurnRad == 0 ? 1 : halfTurn.sin() / halfTurnRad);
    }

    /** Makes the robot immovable until it is teleported. */
    void hold() {
        held = true;
        body.setType(BodyType.STATIC);
    }

    boolean isHeld() {
        return held;
    }

    private void release() {
        held = false;
        body.setType(BodyType.DYNAMIC);
        body.setMassData(mass); // the change of type has recomputed it
    }

    void teleport(Pose pose) {
        if (held) {
            release();
        }
        x = pose.x();
        y = pose.y();
        headingRad = wrap(pose.headingRad());
        body.setTransform(new Vec2((float) x, (float) y), (float) headingRad);
        transformIsStale = false;
        placed = true;
    }

    /**
     * Sets the velocity that takes the body to the end of this step's arc.
     *
     * @param mayGlide true if the known contacts of the bodies include all contacts that this step can bring
     */
    void aim(boolean mayGlide) {
        chordDirection.set(headingRad + halfTurnRad);
        aimX = x + chordM * chordDirection.cos();
        aimY = y + chordM * chordDirection.sin();
        aimHeadingRad = wrap(headingRad + 2 * halfTurnRad);

        if (held) {
            return;
        }
        bodyDirection.set(aimHeadingRad);
        double cos = bodyDirection.cos();
        double sin = bodyDirection.sin();
        double towardsX = aimX + cos * centreX - sin * centreY - body.m_sweep.c.x;
        double towardsY = aimY + sin * centreX + cos * centreY - body.m_sweep.c.y;
        velocity.set((float) (towardsX / stepS), (float) (towardsY / stepS));
        float angularVelocity = (float) (wrap(aimHeadingRad - body.m_sweep.a) / stepS);
        if (mayGlide
                && !placed
                && glides(velocity.x * physicsStepS, velocity.y * physicsStepS, angularVelocity * physicsStepS)) {
            return;
        }
        placed = false;
        if (transformIsStale) {
            body.synchronizeTransform();
            transformIsStale = false;
        }
        body.setAwake(true);
        body.setLinearVelocity(velocity);
        body.setAngularVelocity(angularVelocity);
    }

    /**
     * Moves a robot with nothing near it without jbox2d, if possible; the body sleeps during the step. It does the same
     * additions in the same precision as jbox2d, so the body ends in the same place.
     */
    private boolean glides(float moveX, float moveY, float turnRad) {
        float a = body.m_sweep.a + turnRad;
        if (body.m_contactList != null
                || Math.abs(a) > MathUtils.PI
                || Math.max(Math.max(Math.abs(moveX), Math.abs(moveY)), Math.abs(turnRad)) > MOST_GLIDE
                || !fatBoxes.hold(aimX, aimY, bodyDirection.cos(), bodyDirection.sin())) {
            return false;
        }
        if (body.isAwake()) {
            body.setAwake(false);
        }
        body.m_sweep.c.x += moveX;
        body.m_sweep.c.y += moveY;
        body.m_sweep.a = a;
        transformIsStale = true;
        return true;
    }

    /** Reads the pose of the body after the step. */
    void settle(boolean touched) {
        if (held) {
            stallMeter.record(aimX - x, aimY - y, 0, 0, turnRadps, 0);
            return;
        }
        wrapBodyAngle();
        double fromX = x;
        double fromY = y;
        double fromHeadingRad = headingRad;
        if (touched) {
            headingRad = wrap(body.m_sweep.a);
            bodyDirection.set(headingRad);
            double cos = bodyDirection.cos();
            double sin = bodyDirection.sin();
            x = body.m_sweep.c.x - (cos * centreX - sin * centreY);
            y = body.m_sweep.c.y - (sin * centreX + cos * centreY);
        } else {
            x = aimX;
            y = aimY;
            headingRad = aimHeadingRad;
        }
        stallMeter.record(aimX - fromX, aimY - fromY, x - fromX, y - fromY, turnRadps, headingRad - fromHeadingRad);
    }

    /** Wraps the body's angle: jbox2d never does, and a large float is coarse. */
    private void wrapBodyAngle() {
        float a = body.m_sweep.a;
        if (Math.abs(a) > MathUtils.PI) {
            float turn = Math.copySign(MathUtils.TWOPI, a);
            body.m_sweep.a -= turn;
            body.m_sweep.a0 -= turn;
        }
    }

    boolean heldBack() {
        return stallMeter.heldBack();
    }

    double x() {
        return x;
    }

    double y() {
        return y;
    }

    double headingRad() {
        return headingRad;
    }

    double bodyHeadingRad() {
        return body.m_sweep.a;
    }

    /** Wraps an angle to -pi to pi. */
    static double wrap(double angleRad) {
        // within these bounds the remainder is the angle itself
        return Math.abs(angleRad) < StrictMath.PI ? angleRad : StrictMath.IEEEremainder(angleRad, FULL_TURN_RAD);
    }

    /**
     * Compares the commanded with the actual motion of a robot over the last 0.2 s.
     *
     * <p><b>Cost.</b> Recording, at every step, only stores numbers; the arithmetic is done when the result is read.
     */
    private static final class StallMeter {
        private static final int WINDOW_MICROS = 200_000;
        /** Smaller sums in a window (metres or radians) are rounding, not travel. */
        private static final double NEGLIGIBLE = 1e-4;

        private static final int COMMANDED_X = 0;
        private static final int COMMANDED_Y = 1;
        private static final int ACTUAL_X = 2;
        private static final int ACTUAL_Y = 3;
        private static final int COMMANDED_TURN_RADPS = 4;
        private static final int ACTUAL_RAD = 5;
        private static final int FIELDS = 6;

        private final double stepS;
        private final double[] steps; // a ring buffer of records
        private int next;

        StallMeter(int stepMicros) {
            stepS = stepMicros / 1e6;
            steps = new double[FIELDS * Math.max(1, WINDOW_MICROS / stepMicros)];
        }

        /**
         * Records the commanded and the actual motion of one step, in metres; turns left positive, {@code actualRad}
         * unwrapped.
         */
        void record(
                double commandedX,
                double commandedY,
                double actualX,
                double actualY,
                double commandedTurnRadps,
                double actualRad) {
            steps[next + COMMANDED_X] = commandedX;
            steps[next + COMMANDED_Y] = commandedY;
            steps[next + ACTUAL_X] = actualX;
            steps[next + ACTUAL_Y] = actualY;
            steps[next + COMMANDED_TURN_RADPS] = commandedTurnRadps;
            steps[next + ACTUAL_RAD] = actualRad;
            next += FIELDS;
            if (next == steps.length) {
                next = 0;
            }
        }

        /** True if less than half of the commanded motion was achieved, in driving or in turning. */
        boolean heldBack() {
            double commandedSumM = 0;
            double actualSumM = 0;
            double commandedSumRad = 0;
            double actualSumRad = 0;
            for (int i = 0; i < steps.length; i += FIELDS) {
                double commandedX = steps[i + COMMANDED_X];
                double commandedY = steps[i + COMMANDED_Y];
                double commandedM = StrictMath.hypot(commandedX, commandedY);
                commandedSumM += commandedM;
                actualSumM += commandedM == 0
                        ? 0
                        : (steps[i + ACTUAL_X] * commandedX + steps[i + ACTUAL_Y] * commandedY) / commandedM;
                double turnRadps = steps[i + COMMANDED_TURN_RADPS];
                commandedSumRad += Math.abs(turnRadps) * stepS;
                actualSumRad += RobotBody.wrap(steps[i + ACTUAL_RAD]) * Math.signum(turnRadps);
            }
            return lessThanHalf(actualSumM, commandedSumM) || lessThanHalf(actualSumRad, commandedSumRad);
        }

        private static boolean lessThanHalf(double actual, double commanded) {
            return commanded > NEGLIGIBLE && actual < commanded / 2;
        }
    }
}
