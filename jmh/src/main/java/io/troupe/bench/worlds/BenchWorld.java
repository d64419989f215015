package io.troupe.bench.worlds;

/** One way to simulate a {@link BuildScene}. A new world has read its devices once. */
interface BenchWorld {
    /**
     * Simulates {@code intervals} intervals: in each, commands from the latest readings, the physics steps, and all
     * devices.
     */
    void advance(int intervals);

    /** The latest readings; always the same object. */
    Readings readings();

    /**
     * The latest readings of all robots: the ranges of their rays in metres, and the number of columns in each half of
     * the image that see a coloured object.
     */
    final class Readings {
        final int rays; // of each robot
        private final double[] rangesM;
        final int[] colouredLeft;
        final int[] colouredRight;

        /** @param rays of each robot: {@link TiledScene#SONARS} all around, or those of a laser of half a turn */
        Readings(int robotCount, int rays) {
            this.rays = rays;
            rangesM = new double[robotCount * rays];
            colouredLeft = new int[robotCount];
            colouredRight = new int[robotCount];
        }

        double rangeM(int robot, int ray) {
            return rangesM[robot * rays + ray];
        }

        void setRangeM(int robot, int ray, double rangeM) {
            rangesM[robot * rays + ray] = rangeM;
        }

        /**
         * The range in the direction of a sonar; behind a robot with a laser it is that of a sonar that meets nothing.
         */
        double sonarM(int robot, int sonar) {
            if (rays == TiledScene.SONARS) {
                return rangeM(robot, sonar);
            }
            int fromRight = (sonar + TiledScene.SONARS / 4) % TiledScene.SONARS;
            return fromRight > TiledScene.SONARS / 2
                    ? TiledScene.SONAR_RANGE_M
                    : rangeM(robot, fromRight * (rays - 1) / (TiledScene.SONARS / 2));
        }

        /** Adds one run of image columns with one colour. */
        void addRun(int robot, int first, int last) {
            int middle = TiledScene.COLUMNS / 2;
            colouredLeft[robot] += Math.max(0, Math.min(last + 1, middle) - first);
            colouredRight[robot] += Math.max(0, last + 1 - Math.max(first, middle));
        }

        void clearRuns(int robot) {
            colouredLeft[robot] = 0;
            colouredRight[robot] = 0;
        }
    }
}
