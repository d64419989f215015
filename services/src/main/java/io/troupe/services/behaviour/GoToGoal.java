package io.troupe.services.behaviour;

import java.util.List;
import java.util.Optional;

/**
 * Drives to a list of points in turn, by odometry: turns towards the next point, and slows down before it.
 *
 * <p><b>Role.</b> A pure function of a pose and the index of the next goal. It does not avoid obstacles: put
 * {@link Avoid} above it. At the last goal it returns no velocity.
 *
 * <p><b>Source.</b> The usual proportional law for a differential drive: forward speed in proportion to the distance,
 * turn rate in proportion to the angle.
 *
 * @param goals visited in turn, at least one
 * @param speedMps maximum forward speed
 * @param withinM distance at which a goal counts as reached
 * @param again whether to start over after the last goal
 */
public record GoToGoal(List<Goal> goals, double speedMps, double withinM, boolean again) {
    public static final double SPEED_MPS = 0.3;
    public static final double WITHIN_M = 0.1;
    /** Forward speed per metre of distance to the goal. */
    private static final double FORWARD_PER_S = 1;
    /** Turn rate per radian of angle to the goal. */
    private static final double TURN_PER_S = 1.5;

    private static final double MAX_TURN_RADPS = 0.8;

    /** A point in the frame of the robot's odometry. */
    public record Goal(double xM, double yM) {}

    /**
     * The result of one cycle: the velocity, or none, and the next goal.
     *
     * @param goal index into the goals
     */
    public record Step(Optional<Velocity> velocity, int goal) {}

    public GoToGoal {
        goals = List.copyOf(goals);
        if (goals.isEmpty()) {
            throw new IllegalArgumentException("a way of 0 goals, expected 1 or more");
        }
        for (var goal : goals) {
            if (!Double.isFinite(goal.xM) || !Double.isFinite(goal.yM)) {
                throw new IllegalArgumentException(
                        "the goal (" + goal.xM + ", " + goal.yM + "), expected finite metres");
            }
        }
        Preconditions.requirePositive("the speed", speedMps, "m/s");
        Preconditions.requirePositive("the distance at which a goal is reached", withinM, "m");
    }

    /** Creates a behaviour that keeps the index of the next goal, starting with the first. */
    public Behaviour behaviour() {
        int[] next = {0};
        return senses -> {
            Step step = step(next[0], senses.pose());
            next[0] = step.goal();
            return step.velocity();
        };
    }

    /** Computes one control cycle. */
    public Step step(int goal, RobotPose pose) {
        int next = goal;
        for (int passed = 0; passed < goals.size(); passed++) {
            if (distanceM(goals.get(next), pose) > withinM) {
                return new Step(Optional.of(steer(goals.get(next), pose)), next);
            }
            if (next + 1 == goals.size() && !again) {
                break;
            }
            next = (next + 1) % goals.size();
        }
        return new Step(Optional.empty(), next);
    }

    private Velocity steer(Goal goal, RobotPose pose) {
        double bearingRad = StrictMath.atan2(goal.yM - pose.yM(), goal.xM - pose.xM());
        double leftRad = StrictMath.IEEEremainder(bearingRad - pose.headingRad(), 2 * StrictMath.PI);
        double forwardMps = StrictMath.min(speedMps, FORWARD_PER_S * distanceM(goal, pose));
        return new Velocity(
                forwardMps * StrictMath.max(0, StrictMath.cos(leftRad)),
                StrictMath.max(-MAX_TURN_RADPS, StrictMath.min(MAX_TURN_RADPS, TURN_PER_S * leftRad)));
    }

    private static double distanceM(Goal goal, RobotPose pose) {
        return StrictMath.hypot(goal.xM - pose.xM(), goal.yM - pose.yM());
    }
}
