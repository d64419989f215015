package io.troupe.bench.worlds;

/** One way to simulate a {@link TiledScene}. A new world has read its devices once. */
interface BenchWorld {
    /**
     * Simulates {@code intervals} intervals: in each, commands from the latest readings, the physics steps, and all
     * devices.
     */
    void advance(int intervals);

    /** The latest readings; always the same object. */
    Readings readings();

    /**
     * The latest readings of all robots: {@link TiledScene#SONARS} ranges in metres, and the number of columns in each
     * half of the image that see a coloured object.
     */
    final class Readings {
        private final double[] sonarM;
        final int[] colouredLeft;
        final int[] colouredRight;

        Readings(int robotCount) {
            sonarM = new double[robotCount * TiledScene.SONARS];
            colouredLeft = new int[robotCount];
            colouredRight = new int[robotCount];
        }

        double sonarM(int robot, int sonar) {
            return sonarM[robot * TiledScene.SONARS + sonar];
        }

        void setSonarM(int robot, int sonar, double rangeM) {
            sonarM[robot * TiledScene.SONARS + sonar] = rangeM;
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
