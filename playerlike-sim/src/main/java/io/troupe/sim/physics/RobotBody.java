package io.troupe.sim.physics;

import io.troupe.sim.scenario.Pose;
import org.jbox2d.common.MathUtils;
import org.jbox2d.common.Vec2;
import org.jbox2d.dynamics.Body;

/**
 * One robot in jbox2d.
 *
 * <p>jbox2d counts in {@code float}, so its positions drift. This class keeps the pose of the centre of rotation in {@code double}:
 * while nothing touches the robot, each step aims the body exactly at the next point of the commanded arc and the pose is that
 * point; while something does, the pose is where the body went.
 */
final class RobotBody {
    private static final double FULL_TURN_RAD = 2 * StrictMath.PI;

    private final Body body;
    private final double stepS;
    private final double centreX; // of mass, in the robot's frame
    private final double centreY;
    private final StallMeter stallMeter;
    private final Vec2 velocity = new Vec2();

    private double x;
    private double y;
    private double headingRad;
    private double forwardMps;
    private double turnRadps;
    private double aimX;
    private double aimY;
    private double aimHeadingRad;

    RobotBody(Body body, Pose pose, int stepMicros) {
        this.body = body;
        stepS = stepMicros / 1e6;
        centreX = body.getLocalCenter().x;
        centreY = body.getLocalCenter().y;
        stallMeter = new StallMeter(stepMicros);
        x = pose.x();
        y = pose.y();
        headingRad = wrap(pose.headingRad());
    }

    void drive(double forwardMps, double turnRadps) {
        this.forwardMps = forwardMps;
        this.turnRadps = turnRadps;
    }

    void teleport(Pose pose) {
        x = pose.x();
        y = pose.y();
        headingRad = wrap(pose.headingRad());
        body.setTransform(new Vec2((float) x, (float) y), (float) headingRad);
    }

    /** Gives the body the velocity that takes it to the end of this step's arc. */
    void aim() {
        double halfTurnRad = turnRadps * stepS / 2;
        double chordM = forwardMps * stepS * (halfTurnRad == 0 ? 1 : StrictMath.sin(halfTurnRad) / halfTurnRad);
        aimX = x + chordM * StrictMath.cos(headingRad + halfTurnRad);
        aimY = y + chordM * StrictMath.sin(headingRad + halfTurnRad);
        aimHeadingRad = wrap(headingRad + 2 * halfTurnRad);

        double cos = StrictMath.cos(aimHeadingRad);
        double sin = StrictMath.sin(aimHeadingRad);
        double towardsX = aimX + cos * centreX - sin * centreY - body.m_sweep.c.x;
        double towardsY = aimY + sin * centreX + cos * centreY - body.m_sweep.c.y;
        velocity.set((float) (towardsX / stepS), (float) (towardsY / stepS));
        body.setLinearVelocity(velocity);
        body.setAngularVelocity((float) (wrap(aimHeadingRad - body.m_sweep.a) / stepS));
    }

    /** Takes over where the step has left the body. */
    void settle(boolean touched) {
        wrapBodyAngle();
        double fromX = x;
        double fromY = y;
        double fromHeadingRad = headingRad;
        if (touched) {
            headingRad = wrap(body.m_sweep.a);
            double cos = StrictMath.cos(headingRad);
            double sin = StrictMath.sin(headingRad);
            x = body.m_sweep.c.x - (cos * centreX - sin * centreY);
            y = body.m_sweep.c.y - (sin * centreX + cos * centreY);
        } else {
            x = aimX;
            y = aimY;
            headingRad = aimHeadingRad;
        }
        double toldM = StrictMath.hypot(aimX - fromX, aimY - fromY);
        double wentM = toldM == 0 ? 0 : ((x - fromX) * (aimX - fromX) + (y - fromY) * (aimY - fromY)) / toldM;
        double wentRad = wrap(headingRad - fromHeadingRad) * Math.signum(turnRadps);
        stallMeter.record(toldM, wentM, Math.abs(turnRadps) * stepS, wentRad);
    }

    /** jbox2d never wraps angles, and a large float is a coarse one. */
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

    Pose pose() {
        return new Pose(x, y, headingRad);
    }

    double bodyHeadingRad() {
        return body.m_sweep.a;
    }

    private static double wrap(double angleRad) {
        return StrictMath.IEEEremainder(angleRad, FULL_TURN_RAD);
    }
}
