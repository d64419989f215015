package io.troupe.services.behaviour;

import java.util.Optional;

/**
 * Obstacle avoidance: slows down and turns before an obstacle, and returns no velocity while nothing is near.
 *
 * <p><b>Role.</b> A pure function of a memory and the senses, meant as a layer above another behaviour. It keeps
 * turning to one side until the way is free, so that it gets out of corners. Then it drives straight on for a moment;
 * otherwise the layer below could turn back at once.
 *
 * <p><b>Order.</b> It never drives forward while one of sonars 1 to 6 (50 degrees to both sides) reads less than
 * {@code nearM}.
 *
 * @param nearM distance below which it turns in place
 * @param farM distance below which it slows down and turns
 * @param turnRadps turn rate
 * @param onwardSeconds how long it drives straight on once the way is free
 */
public record Avoid(double nearM, double farM, double turnRadps, double onwardSeconds) {
    /** Turns in place below 0.4 m and more slowly below 0.6 m, at 0.6 rad/s, then drives on for 2 s. */
    public static final Avoid DEFAULT = new Avoid(0.4, 0.6, 0.6, 2);

    private static final double FORWARD_MPS = 0.2;
    private static final int FIRST_SONAR = 1;
    private static final int LAST_SONAR = 6;
    private static final int FIRST_ON_THE_RIGHT = 4;

    /** The current phase. */
    public sealed interface Memory {
        /** Nothing is near. */
        record Idle() implements Memory {}

        /** An obstacle is near; the robot turns, always to the same side. */
        record Turning(boolean left) implements Memory {}

        /** The way is free again; the robot drives straight on until that time. */
        record Onward(double untilSeconds) implements Memory {}
    }

    /** The result of one cycle: the velocity, or none, and the memory for the next cycle. */
    public record Step(Optional<Velocity> velocity, Memory memory) {}

    /** The initial memory. */
    public static final Memory START = new Memory.Idle();

    public Avoid {
        Preconditions.requirePositive("the distance at which it turns in place", nearM, "m");
        Preconditions.requirePositive("the turn rate", turnRadps, "rad/s");
        if (!(farM > nearM) || farM > SonarRing.MAX_M) {
            throw new IllegalArgumentException("the distance at which it slows down is " + farM
                    + " m, expected more than the " + nearM + " m at which it turns in place, and at most "
                    + SonarRing.MAX_M + " m");
        }
        if (!(onwardSeconds >= 0) || Double.isInfinite(onwardSeconds)) {
            throw new IllegalArgumentException("it drives on for " + onwardSeconds + " s, expected 0 or more");
        }
    }

    /** Creates a behaviour that keeps the memory. */
    public Behaviour behaviour() {
        Memory[] memory = {START};
        return senses -> {
            Step step = step(memory[0], senses);
            memory[0] = step.memory();
            return step.velocity();
        };
    }

    /** Computes one control cycle. */
    public Step step(Memory memory, Senses senses) {
        double leftM = nearest(senses.sonar(), FIRST_SONAR, FIRST_ON_THE_RIGHT - 1);
        double rightM = nearest(senses.sonar(), FIRST_ON_THE_RIGHT, LAST_SONAR);
        double frontM = StrictMath.min(leftM, rightM);
        if (frontM < farM) {
            boolean left = memory instanceof Memory.Turning turning ? turning.left : rightM < leftM;
            double share = StrictMath.max(0, (frontM - nearM) / (farM - nearM));
            var velocity = new Velocity(FORWARD_MPS * share, left ? turnRadps : -turnRadps);
            return new Step(Optional.of(velocity), new Memory.Turning(left));
        }
        return switch (memory) {
            case Memory.Idle idle -> new Step(Optional.empty(), idle);
            case Memory.Turning turning -> onward(new Memory.Onward(senses.timeSeconds() + onwardSeconds), senses);
            case Memory.Onward onward -> onward(onward, senses);
        };
    }

    private static Step onward(Memory.Onward onward, Senses senses) {
        return senses.timeSeconds() < onward.untilSeconds
                ? new Step(Optional.of(new Velocity(FORWARD_MPS, 0)), onward)
                : new Step(Optional.empty(), START);
    }

    private static double nearest(SonarRing sonar, int first, int last) {
        double nearestM = SonarRing.MAX_M;
        for (int each = first; each <= last; each++) {
            nearestM = StrictMath.min(nearestM, sonar.rangeM(each));
        }
        return nearestM;
    }
}
