package io.troupe.demo;

import java.util.Locale;

/** How large the files of a run become, about; a warning before a long run names them. */
record RunSizes(double logBytes, double pictureBytes) {
    private static final double LARGE_BYTES = 50e6;
    /** Measured in the paper's arena. */
    private static final double BYTES_PER_POSE = 160;

    private static final double BYTES_PER_POINT = 12;

    static RunSizes of(int robots, long intervalMillis, double seconds) {
        double poses = robots * seconds * 1000 / intervalMillis;
        double logged = robots < Ledger.MANY_ROBOTS ? poses : robots * seconds;
        return new RunSizes(logged * BYTES_PER_POSE, poses * BYTES_PER_POINT);
    }

    boolean areLarge() {
        return logBytes > LARGE_BYTES || pictureBytes > LARGE_BYTES;
    }

    String describe() {
        return String.format(
                Locale.ROOT,
                "%.0f MB in run.jsonl and at most %.0f MB in trajectory.svg",
                logBytes / 1e6,
                pictureBytes / 1e6);
    }
}
