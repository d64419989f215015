package io.troupe.sim.physics;

import io.troupe.sim.model.Pose;
import io.troupe.sim.numeric.Angles;
import io.troupe.sim.numeric.Direction;
import org.jbox2d.collision.shapes.MassData;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;
import org.jbox2d.dynamics.BodyType;
import org.jbox2d.dynamics.Filter;
import org.jbox2d.dynamics.Fixture;

/**
 * The body of one robot in jbox2d.
 *
 * <p>jbox2d computes in {@code float}, so its positions drift. This class keeps the pose of the centre of rotation in
 * {@code double}. While nothing touches the robot, each step aims the body exactly at the next point of the commanded
 * arc, and the pose is that point. While something touches it, the pose follows the body.
 *
 * <p><b>Gliding.</b> A robot that nothing can touch makes its steps without jbox2d, several at a time: the same
 * additions in the same precision, so that the body ends in the same place.
 */
final class RobotBody {
    /** Largest move or turn (metres or radians) of a gliding step, far below jbox2d's limits. */
    private static final float MOST_GLIDE = 0.5f;

    /** Larger than the rounding errors of a step's travel. */
    private static final double ROUNDING = 1e-6;

    private final Body body;
    private final FatBoxes fatBoxes;
    private final Directions directions;
    private final float physicsStepS; // in float, as jbox2d uses it
    private final double stepS;
    private final double centreX; // centre of mass, in the robot's frame
    private final double centreY;
    private final boolean central; // the centre of mass is the centre of rotation
    private final StallMeter stallMeter;
    private final MassData mass = new MassData();

    private double x;
    private double y;
    private double headingRad;
    private double turnRadps;
    private double halfTurnRad; // of one step
    private double chordM;
    private double sideChordM; // to the left; 0 unless the drive is omnidirectional
    private double travelM; // no point of the robot moves farther in a step, unless it is pushed
    private double aimX;
    private double aimY;
    private double aimHeadingRad;
    private boolean placed; // teleported since the last step
    private boolean held; // in place, because it overlaps something, or because it is away
    private boolean away;
    private int maskBits; // of what it collides with, while it is not away

    // While the robot glides, the place of the body's centre and its angle are here, and those of jbox2d are old.
    private boolean bodyIsBehind;
    private float bodyX;
    private float bodyY;
    private float bodyAngle;
    private double slackM = -1; // of the fat boxes, at least; negative = unknown

    // where the glide began
    private double startX;
    private double startY;
    private double startHeadingRad;
    private float startBodyX;
    private float startBodyY;
    private float startBodyAngle;
    private int startRecord;
    private boolean startedBehind;

    /** Working memory of all robots of a thread. */
    static final class Directions {
        private final Direction halfTurn = new Direction();
        private final Direction chord = new Direction();
        private final Direction body = new Direction();
        private final Vec2 velocity = new Vec2();
    }

    RobotBody(Body body, FatBoxes fatBoxes, Directions directions, Pose pose, int stepMicros) {
        this.body = body;
        this.fatBoxes = fatBoxes;
        this.directions = directions;
        physicsStepS = stepMicros / 1e6f;
        stepS = stepMicros / 1e6;
        centreX = body.getLocalCenter().x;
        centreY = body.getLocalCenter().y;
        central = centreX == 0 && centreY == 0;
        body.getMassData(mass);
        stallMeter = new StallMeter(stepMicros);
        x = pose.x();
        y = pose.y();
        headingRad = Angles.wrap(pose.headingRad());
    }

    void drive(double forwardMps, double sidewaysMps, double turnRadps) {
        this.turnRadps = turnRadps;
        halfTurnRad = turnRadps * stepS / 2;
        directions.halfTurn.set(halfTurnRad);
        chordM = forwardMps * stepS * (halfTurnRad == 0 ? 1 : directions.halfTurn.sin() / halfTurnRad);
        sideChordM = sidewaysMps == 0
                ? 0
                : sidewaysMps * stepS * (halfTurnRad == 0 ? 1 : directions.halfTurn.sin() / halfTurnRad);
        double arcsM = Math.abs(forwardMps) + Math.abs(sidewaysMps) + Math.abs(turnRadps) * fatBoxes.radiusM();
        travelM = arcsM * stepS * (1 + ROUNDING) + ROUNDING / 1000;
    }

    /** Makes the robot immovable until it is teleported. */
    void hold() {
        held = true;
        body.setType(BodyType.STATIC);
    }

    /** Takes the robot out of the world until it is teleported: it stands still and collides with nothing. */
    void leave() {
        if (!away) {
            away = true;
            maskBits = body.getFixtureList().getFilterData().maskBits;
            collideWith(0);
            hold();
        }
    }

    private void collideWith(int mask) {
        for (Fixture fixture = body.getFixtureList(); fixture != null; fixture = fixture.getNext()) {
            Filter filter = new Filter();
            filter.set(fixture.getFilterData());
            filter.maskBits = mask;
            fixture.setFilterData(filter);
        }
    }

    boolean isAway() {
        return away;
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
        if (away) {
            away = false;
            collideWith(maskBits);
        }
        x = pose.x();
        y = pose.y();
        headingRad = Angles.wrap(pose.headingRad());
        body.setTransform(new Vec2((float) x, (float) y), (float) headingRad);
        bodyIsBehind = false;
        placed = true;
        slackM = -1;
    }

    /** The end of the next step's arc. */
    private void aim() {
        if (chordM == 0 && sideChordM == 0 && x != 0 && y != 0) { // zero might change its sign
            aimX = x;
            aimY = y;
        } else {
            Direction chord = directions.chord;
            chord.set(headingRad + halfTurnRad);
            aimX = x + chordM * chord.cos();
            aimY = y + chordM * chord.sin();
            if (sideChordM != 0) {
                aimX -= sideChordM * chord.sin();
                aimY += sideChordM * chord.cos();
            }
        }
        aimHeadingRad = Angles.wrap(headingRad + 2 * halfTurnRad);
    }

    /** The velocity that takes the centre of the body from a place to where it is at the end of the arc. */
    private void aimBody(float fromX, float fromY) {
        double towardsX;
        double towardsY;
        if (central && aimX != 0 && aimY != 0) { // zero might change its sign
            towardsX = aimX - fromX;
            towardsY = aimY - fromY;
        } else {
            Direction direction = directions.body;
            direction.set(aimHeadingRad);
            double cos = direction.cos();
            double sin = direction.sin();
            towardsX = aimX + cos * centreX - sin * centreY - fromX;
            towardsY = aimY + sin * centreX + cos * centreY - fromY;
        }
        directions.velocity.set((float) (towardsX / stepS), (float) (towardsY / stepS));
    }

    private float angularVelocity(float fromAngle) {
        return (float) (Angles.wrap(aimHeadingRad - fromAngle) / stepS);
    }

    /** Gives the body the velocity for a step of jbox2d. */
    void push() {
        if (held) {
            aim();
            return;
        }
        if (bodyIsBehind) {
            bodyIsBehind = false;
            body.m_sweep.c.x = bodyX;
            body.m_sweep.c.y = bodyY;
            body.m_sweep.a = bodyAngle;
            body.synchronizeTransform();
        }
        placed = false;
        slackM = -1;
        aim();
        aimBody(body.m_sweep.c.x, body.m_sweep.c.y);
        body.setAwake(true);
        body.setLinearVelocity(directions.velocity);
        body.setAngularVelocity(angularVelocity(body.m_sweep.a));
    }

    /** Reads the pose of the body after a step of jbox2d. */
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
            headingRad = Angles.wrap(body.m_sweep.a);
            Direction direction = directions.body;
            direction.set(headingRad);
            double cos = direction.cos();
            double sin = direction.sin();
            x = body.m_sweep.c.x - (cos * centreX - sin * centreY);
            y = body.m_sweep.c.y - (sin * centreX + cos * centreY);
        } else {
            x = aimX;
            y = aimY;
            headingRad = aimHeadingRad;
        }
        stallMeter.record(aimX - fromX, aimY - fromY, x - fromX, y - fromY, turnRadps, headingRad - fromHeadingRad);
    }

    /** Makes up to this number of steps without jbox2d. Returns how many: it ends before a step that needs jbox2d. */
    int glide(int steps) {
        if (placed || held) {
            return 0;
        }
        if (body.isAwake()) {
            body.setAwake(false);
        }
        startedBehind = bodyIsBehind;
        if (!bodyIsBehind) {
            bodyX = body.m_sweep.c.x;
            bodyY = body.m_sweep.c.y;
            bodyAngle = body.m_sweep.a;
        }
        startX = x;
        startY = y;
        startHeadingRad = headingRad;
        startBodyX = bodyX;
        startBodyY = bodyY;
        startBodyAngle = bodyAngle;
        startRecord = stallMeter.next();
        int made = 0;
        while (made < steps && glideStep()) {
            made++;
        }
        bodyIsBehind = startedBehind || made > 0;
        return made;
    }

    private boolean glideStep() {
        aim();
        aimBody(bodyX, bodyY);
        float moveX = directions.velocity.x * physicsStepS;
        float moveY = directions.velocity.y * physicsStepS;
        float turnRad = angularVelocity(bodyAngle) * physicsStepS;
        float angle = bodyAngle + turnRad;
        if (Math.abs(angle) > MathUtils.PI
                || Math.max(Math.max(Math.abs(moveX), Math.abs(moveY)), Math.abs(turnRad)) > MOST_GLIDE
                || !staysInFatBoxes()) {
            return false;
        }
        bodyX += moveX;
        bodyY += moveY;
        bodyAngle = angle;
        double movedX = aimX - x;
        double movedY = aimY - y;
        stallMeter.record(movedX, movedY, movedX, movedY, turnRadps, aimHeadingRad - headingRad);
        x = aimX;
        y = aimY;
        headingRad = aimHeadingRad;
        return true;
    }

    /** Compares with the boxes only if the robot may have travelled as far as they allowed the last time. */
    private boolean staysInFatBoxes() {
        slackM -= travelM;
        if (slackM > 0) {
            return true;
        }
        Direction direction = directions.body;
        direction.set(aimHeadingRad);
        slackM = fatBoxes.slackM(aimX, aimY, direction.cos(), direction.sin());
        return slackM >= 0;
    }

    /** Goes back to the beginning of the glide, and makes only this number of its steps. */
    void glideOnly(int steps) {
        x = startX;
        y = startY;
        headingRad = startHeadingRad;
        bodyX = startBodyX;
        bodyY = startBodyY;
        bodyAngle = startBodyAngle;
        slackM = -1;
        bodyIsBehind = startedBehind;
        stallMeter.setNext(startRecord);
        int made = glide(steps);
        if (made < steps) {
            throw new IllegalStateException("a glide of " + steps + " steps took " + made + " when repeated");
        }
    }

    /** Where the last glide began. */
    double startX() {
        return startX;
    }

    double startY() {
        return startY;
    }

    double startHeadingRad() {
        return startHeadingRad;
    }

    /** No point of the robot moves farther in a step, unless it is pushed. */
    double travelM() {
        return travelM;
    }

    /** Distance of the farthest vertex from the centre of rotation. */
    double radiusM() {
        return fatBoxes.radiusM();
    }

    Body body() {
        return body;
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
        return bodyIsBehind ? bodyAngle : body.m_sweep.a;
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

        /** Place of the next record. */
        int next() {
            return next;
        }

        void setNext(int record) {
            next = record;
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
                actualSumRad += Angles.wrap(steps[i + ACTUAL_RAD]) * Math.signum(turnRadps);
            }
            return lessThanHalf(actualSumM, commandedSumM) || lessThanHalf(actualSumRad, commandedSumRad);
        }

        private static boolean lessThanHalf(double actual, double commanded) {
            return commanded > NEGLIGIBLE && actual < commanded / 2;
        }
    }
}
