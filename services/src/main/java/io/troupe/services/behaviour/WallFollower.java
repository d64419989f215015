package io.troupe.services.behaviour;

import java.util.Optional;

/**
 * Drives to a wall, turns until the wall is on the left, and follows it.
 *
 * <p><b>Role.</b> A pure function of a memory and the sonar readings; the caller keeps the memory from one cycle to the
 * next.
 *
 * <p><b>Source.</b> Paper, section 3.1, Tables 1 and 2, with the corrections of ADR 0005: metres instead of
 * centimetres, and "drive on while nothing is near".
 */
public final class WallFollower {
    /** The robot turns if the range in front is below this, or the range on the left above it. */
    public static final double MAX_WALL_M = 0.4;
    /** The robot steers away from the wall if the range on the left is below this. */
    public static final double MIN_WALL_M = 0.3;

    private static final Velocity TURN_FAST = new Velocity(0, -0.45);
    private static final Velocity TURN_SLOWLY = new Velocity(0, -0.15);

    /**
     * The direction of travel while the robot turns right at a wall ahead. It is the only number in which the paper and
     * its model program differ.
     */
    public enum CornerStyle {
        /** Table 2 of the paper: forward at 0.1 m/s. */
        FORWARD(0.1),
        /** The Player client's example program, the model of the paper's service: backward at 0.1 m/s. */
        BACKWARD(-0.1);

        private final Velocity turn;

        CornerStyle(double forwardMps) {
            this.turn = new Velocity(forwardMps, -0.6);
        }
    }

    /**
     * The numbers of the law, once the wall is on the left: two limits, and a velocity for each row of Table 2.
     *
     * @param maxWallM the robot turns if the range in front is below this, or the range on the left above it
     * @param minWallM the robot steers away from the wall if the range on the left is below this
     * @param ahead the velocity between these limits, and until the robot is near a wall
     */
    public record Gains(
            double maxWallM,
            double minWallM,
            Velocity ahead,
            Velocity atCorner,
            Velocity awayFromWall,
            Velocity towardsWall) {
        /** The numbers of the paper. */
        public static Gains ofThePaper(CornerStyle cornerStyle) {
            return new Gains(
                    MAX_WALL_M,
                    MIN_WALL_M,
                    new Velocity(0.2, 0),
                    cornerStyle.turn,
                    new Velocity(0.1, -0.15),
                    new Velocity(0.1, 0.15));
        }
    }

    /** The current phase (the paper's {@code temp} variable), and the last left reading. */
    public sealed interface Memory {
        /** No wall has been near yet. */
        record Approaching() implements Memory {}

        /** Turning right until the left sonar reads more than in the cycle before. */
        record Aligning(double previousLeftM) implements Memory {}

        /** The wall is on the left; this phase never ends. */
        record Following() implements Memory {}
    }

    /** The result of one cycle: the velocity, and the memory for the next cycle. */
    public record Step(Velocity velocity, Memory memory) {}

    /** The initial memory. */
    public static final Memory START = new Memory.Approaching();

    private final Gains gains;

    public WallFollower(CornerStyle cornerStyle) {
        this(Gains.ofThePaper(cornerStyle));
    }

    /** A follower with other numbers than the paper's. */
    public WallFollower(Gains gains) {
        this.gains = gains;
    }

    /** Creates a behaviour that keeps the memory. */
    public static Behaviour behaviour(CornerStyle cornerStyle) {
        return new Remembering(new WallFollower(cornerStyle));
    }

    private static final class Remembering implements Behaviour {
        private final WallFollower law;
        private Memory memory = START;

        Remembering(WallFollower law) {
            this.law = law;
        }

        @Override
        public Optional<Velocity> step(Senses senses) {
            Step step = law.step(memory, senses.sonar());
            memory = step.memory();
            return Optional.of(step.velocity());
        }
    }

    /** Computes one control cycle. */
    public Step step(Memory memory, SonarRing sonar) {
        return switch (memory) {
            case Memory.Approaching approaching -> approach(sonar);
            case Memory.Aligning(double previousLeftM) -> align(previousLeftM, sonar);
            case Memory.Following following -> new Step(follow(sonar), memory);
        };
    }

    private Step approach(SonarRing sonar) {
        if (sonar.leftM() > gains.maxWallM && sonar.frontM() > gains.maxWallM) {
            return new Step(gains.ahead, START);
        }
        return align(sonar.rangeM(0), sonar);
    }

    private static Step align(double previousLeftM, SonarRing sonar) {
        double leftM = sonar.rangeM(0);
        if (leftM > previousLeftM) {
            return new Step(Velocity.STOP, new Memory.Following());
        }
        return new Step(sonar.frontM() <= sonar.leftM() ? TURN_FAST : TURN_SLOWLY, new Memory.Aligning(leftM));
    }

    private Velocity follow(SonarRing sonar) {
        if (sonar.frontM() < gains.maxWallM) {
            return gains.atCorner;
        }
        if (sonar.leftM() < gains.minWallM) {
            return gains.awayFromWall;
        }
        return sonar.leftM() > gains.maxWallM ? gains.towardsWall : gains.ahead;
    }
}
