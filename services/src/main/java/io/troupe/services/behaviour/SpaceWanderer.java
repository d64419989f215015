package io.troupe.services.behaviour;

import java.util.Optional;

/**
 * Drives where there is room, faster and straighter the more of it there is.
 *
 * <p><b>Role.</b> A pure function of a reading.
 *
 * <p><b>Source.</b> Paper, section 3.2; the sonar groups, thresholds and limits are those of the example program it
 * adapted.
 */
public final class SpaceWanderer {
    private static final double NEAR_M = 0.5;
    private static final double MAX_FORWARD_MPS = 0.5;
    private static final double TURN_RADPS = 0.5;
    private static final double WHEEL_DIAMETER = 24;

    private SpaceWanderer() {}

    /** The law; it remembers nothing. */
    public static Behaviour behaviour() {
        return senses -> Optional.of(steer(senses.sonar()));
    }

    /** One cycle. */
    public static Velocity steer(SonarRing sonar) {
        double left = (sonar.rangeM(1) + sonar.rangeM(2)) / 2 / 10;
        double right = (sonar.rangeM(5) + sonar.rangeM(6)) / 2 / 10;
        if (isFree(sonar, 1) || isFree(sonar, 4)) {
            double turn = (left - right) * (180 / StrictMath.PI) / WHEEL_DIAMETER;
            return new Velocity(StrictMath.min((left + right) / 2, MAX_FORWARD_MPS), turn);
        }
        return new Velocity(0, sonar.rangeM(0) < sonar.rangeM(7) ? -TURN_RADPS : TURN_RADPS);
    }

    /** Whether three neighbouring sonars see nothing near. */
    private static boolean isFree(SonarRing sonar, int first) {
        return sonar.rangeM(first) > NEAR_M && sonar.rangeM(first + 1) > NEAR_M && sonar.rangeM(first + 2) > NEAR_M;
    }
}
