package io.troupe.view;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A fault of a node that drives robots.
 *
 * {@snippet :
 * var fault = new DriverFault(30_000_000, "host-a", "killed");
 * Files.writeString(folder.resolve("drivers.svg"), Pictures.drivers(result, fault));
 * }
 *
 * @param timeMicros on the robots' clock
 * @param what happened to it, for example "killed"
 */
public record DriverFault(long timeMicros, String node, String what) {
    /**
     * The time in which a robot was without a driver.
     *
     * @param robot index, from 0
     * @param endMicros when another driver began, or the run ended
     * @param next the node of that driver; null if there was none
     */
    public record Gap(int robot, long endMicros, @Nullable String next) {}

    /** The gaps of all robots that the node drove at that time. */
    public List<Gap> gaps(RunResult result) {
        List<Gap> gaps = new ArrayList<>();
        for (RobotRecord robot : result.robots()) {
            String driver = null;
            Gap gap = null;
            for (RobotRecord.Driver each : robot.drivers()) {
                boolean before = each.node() == null // a loss in the same tick follows from the fault
                        ? each.fromMicros() < timeMicros
                        : each.fromMicros() <= timeMicros;
                if (before) {
                    driver = each.node();
                } else if (gap == null && each.node() != null && node.equals(driver)) {
                    gap = new Gap(robot.index(), each.fromMicros(), each.node());
                }
            }
            if (gap == null && node.equals(driver)) {
                gap = new Gap(robot.index(), result.endMicros(), null);
            }
            if (gap != null) {
                gaps.add(gap);
            }
        }
        return gaps;
    }
}
