package io.troupe.bench.worlds;

import io.troupe.bench.worlds.BenchWorld.Readings;

/**
 * The control law of all robots: drive on, towards the freer side and away from colours; with an obstacle ahead, turn
 * to one side until the way is free.
 */
final class Wander {
    private static final double FREE_M = 0.6;
    private static final double CRUISE_MPS = 0.4;
    private static final double SPIN_RADPS = 1.2;
    private static final double SHY_RADPS = 0.2;
    private static final double MOST_RADPS = 0.5;
    private static final double RADPS_PER_M = 0.05;

    final double[] forwardMps;
    final double[] turnRadps;
    private final int[] side; // 1 = turning left, -1 = right, 0 = driving

    Wander(int robotCount) {
        forwardMps = new double[robotCount];
        turnRadps = new double[robotCount];
        side = new int[robotCount];
    }

    void decide(int robot, Readings readings) {
        double left = readings.sonarM(robot, 1) + readings.sonarM(robot, 2) + readings.sonarM(robot, 3);
        double right = readings.sonarM(robot, 15) + readings.sonarM(robot, 14) + readings.sonarM(robot, 13);
        double ahead = Math.min(
                Math.min(readings.sonarM(robot, 0), Math.min(readings.sonarM(robot, 1), readings.sonarM(robot, 15))),
                Math.min(readings.sonarM(robot, 2), readings.sonarM(robot, 14)));
        if (ahead < FREE_M) {
            if (side[robot] == 0) {
                side[robot] = left >= right ? 1 : -1;
            }
            forwardMps[robot] = 0;
            turnRadps[robot] = side[robot] * SPIN_RADPS;
        } else {
            side[robot] = 0;
            int shy = Integer.signum(readings.colouredRight[robot] - readings.colouredLeft[robot]);
            forwardMps[robot] = CRUISE_MPS;
            turnRadps[robot] = Math.clamp(RADPS_PER_M * (left - right), -MOST_RADPS, MOST_RADPS) + shy * SHY_RADPS;
        }
    }
}
