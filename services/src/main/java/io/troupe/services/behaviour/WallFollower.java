package io.troupe.services.behaviour;

import java.util.Optional;

/**
 * Drives to a wall, turns until it is on the left, and follows it.
 *
 * <p><b>Role.</b> A pure function of a memory and a reading; the caller keeps the memory from one cycle to the next.
 *
 * <p><b>Source.</b> Paper, section 3.1, Tables 1 and 2, read as in ADR 0005: metres instead of centimetres, and "drive
 * on while nothing is near".
 */
public final class WallFollower {
    /** Nearer than this in front, or farther on the left, makes it turn. */
    public static final double MAX_WALL_M = 0.4;
    /** Nearer than this on the left makes it turn away. */
    public static final double MIN_WALL_M = 0.3;

    private static final Velocity AHEAD = new Velocity(0.2, 0);
    private static final Velocity TURN_FAST = new Velocity(0, -0.45);
    private static final Velocity TURN_SLOWLY = new Velocity(0, -0.15);
    private static final Velocity AWAY_FROM_WALL = new Velocity(0.1, -0.15);
    private static final Velocity TOWARDS_WALL = new Velocity(0.1, 0.15);

    /**
     * Which way the robot moves while a wall ahead makes it turn right; the one number in which the paper and its model
     * differ.
     */
    public enum CornerStyle {
        /** Table 2 of the paper: it drives on at 0.1 m/s. */
        FORWARD(0.1),
        /** The Player client's example program, from which the paper's service comes: it backs off at 0.1 m/s. */
        BACKWARD(-0.1);

        private final Velocity turn;

        CornerStyle(double forwardMps) {
            this.turn = new Velocity(forwardMps, -0.6);
        }
    }

    /** Where it stands: the paper's {@code temp} variable, and the last left reading. */
    public sealed interface Memory {
        /** Nothing is near yet. */
        record Approaching() implements Memory {}

        /** Turning right until the left sonar reads more than before. */
        record Aligning(double previousLeftM) implements Memory {}

        /** The wall is on the left, for good. */
        record Following() implements Memory {}
    }

    /** What to do now, and what to remember for the next cycle. */
    public record Step(Velocity velocity, Memory memory) {}

    /** The memory to begin with. */
    public static final Memory START = new Memory.Approaching();

    private final CornerStyle cornerStyle;

    public WallFollower(CornerStyle cornerStyle) {
        this.cornerStyle = cornerStyle;
    }

    /** The law with a memory of its own. */
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

    /** One cycle. */
    public Step step(Memory memory, SonarRing sonar) {
        return switch (memory) {
            case Memory.Approaching approaching -> approach(sonar);
            case Memory.Aligning(double previousLeftM) -> align(previousLeftM, sonar);
            case Memory.Following following -> new Step(follow(sonar), memory);
        };
    }

    private static Step approach(SonarRing sonar) {
        if (sonar.leftM() > MAX_WALL_M && sonar.frontM() > MAX_WALL_M) {
            return new Step(AHEAD, START);
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
        if (sonar.frontM() < MAX_WALL_M) {
            return cornerStyle.turn;
        }
        if (sonar.leftM() < MIN_WALL_M) {
            return AWAY_FROM_WALL;
        }
        return sonar.leftM() > MAX_WALL_M ? TOWARDS_WALL : AHEAD;
    }
}
