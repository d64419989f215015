package io.troupe.services.behaviour;

import java.util.Optional;

/**
 * Drives towards free space; the more free space, the faster and straighter.
 *
 * <p><b>Role.</b> A pure function of the sonar readings.
 *
 * <p><b>Source.</b> Paper, section 3.2. Sonar groups, thresholds and speed limits are those of the example program that
 * the paper adapted.
 */
public final class SpaceWanderer {
    private static final double NEAR_M = 0.5;
    private static final double MAX_FORWARD_MPS = 0.5;
    private static final double TURN_RADPS = 0.5;
    private static final double WHEEL_DIAMETER = 24;

    private SpaceWanderer() {}

    /** Creates a behaviour; it has no memory. */
    public static Behaviour behaviour() {
        return senses -> Optional.of(steer(senses.sonar()));
    }

    /** Computes one control cycle. */
    public static Velocity steer(SonarRing sonar) {
        double left = (sonar.rangeM(1) + sonar.rangeM(2)) / 2 / 10;
        double right = (sonar.rangeM(5) + sonar.rangeM(6)) / 2 / 10;
        if (isFree(sonar, 1) || isFree(sonar, 4)) {
            double turn = (left - right) * (180 / StrictMath.PI) / WHEEL_DIAMETER;
            return new Velocity(StrictMath.min((left + right) / 2, MAX_FORWARD_MPS), turn);
        }
        return new Velocity(0, sonar.rangeM(0) < sonar.rangeM(7) ? -TURN_RADPS : TURN_RADPS);
    }

    /** Whether three neighbouring sonars see nothing within {@link #NEAR_M}. */
    private static boolean isFree(SonarRing sonar, int first) {
        return sonar.rangeM(first) > NEAR_M && sonar.rangeM(first + 1) > NEAR_M && sonar.rangeM(first + 2) > NEAR_M;
    }
}
