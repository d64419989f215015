package io.troupe.demo;

import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.Comparator;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;

/** The summary of a run with many robots: sum, mean, minimum and maximum of each figure. */
final class CrowdSummary {
    private final List<RobotRecord> robots;
    private final String columns;
    private final StringBuilder text = new StringBuilder();

    private CrowdSummary(List<RobotRecord> robots, SubsumptionTable table) {
        this.robots = robots;
        this.columns = RunResult.titleFormat(table) + "%12s%12s%24s%24s";
    }

    static String of(List<RobotRecord> robots, SubsumptionTable table) {
        var summary = new CrowdSummary(robots, table);
        summary.line(robots.size() + " robots", "all", "mean", "least", "most");
        summary.row("distance driven, m", 1, RobotRecord::distanceM);
        summary.extremes("closest approach to a wall, m", 3, "", RobotRecord::closestM);
        summary.row("contacts with walls and boxes", 0, RobotRecord::wallContacts);
        summary.row("  while following a wall", 0, RobotRecord::followingContacts);
        summary.row("contacts with a robot", 0, RobotRecord::robotContacts);
        for (Service service : table.services()) {
            summary.row(RunResult.loopsTitle(service), 0, robot -> robot.loops().getOrDefault(service.name(), 0L));
        }
        summary.row(RunResult.SERVICES_TITLE, 0, RobotRecord::chargeFaults);
        summary.row(RunResult.NO_CYCLE_TITLE, 0, RobotRecord::ticksWithoutCycle);
        summary.extremes(
                RunResult.STAY_TITLE + ", s",
                1,
                "",
                robot -> robot.longestStay().micros() / 1e6);
        return summary.text.toString();
    }

    private void row(String title, int decimals, ToDoubleFunction<RobotRecord> figure) {
        double sum = robots.stream().mapToDouble(figure).sum();
        extremes(title, decimals, number(sum, decimals), figure);
    }

    private void extremes(String title, int decimals, String all, ToDoubleFunction<RobotRecord> figure) {
        double mean = robots.stream().mapToDouble(figure).average().orElse(0);
        var least = robots.stream().min(Comparator.comparingDouble(figure)).orElseThrow();
        var most = robots.stream().max(Comparator.comparingDouble(figure)).orElseThrow();
        boolean same = figure.applyAsDouble(least) == figure.applyAsDouble(most);
        line(
                title,
                all,
                number(mean, Math.max(1, decimals)),
                number(figure.applyAsDouble(least), decimals) + (same ? "" : whose(least)),
                number(figure.applyAsDouble(most), decimals) + (same ? "" : whose(most)));
    }

    private static String whose(RobotRecord robot) {
        return " (robot " + (robot.index() + 1) + ")";
    }

    private static String number(double value, int decimals) {
        return String.format(Locale.ROOT, "%,." + decimals + "f", value);
    }

    private void line(Object... values) {
        text.append(String.format(Locale.ROOT, columns, values)).append(System.lineSeparator());
    }
}
