package io.troupe.view;

import io.troupe.common.svg.Svg;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.view.RunResult.StateChange;
import java.util.List;

/** Draws the states over time, one row per mode. */
final class ModesSvg {
    private static final double LEFT_PX = 110;
    private static final double PLOT_PX = 860;
    private static final double TOP_PX = 56;
    private static final double ROW_PX = 64;
    private static final double BAR_PX = 34;
    private static final double LEGEND_LINE_PX = 22;
    /** Narrower bars have no number. */
    private static final double NUMBER_PX = 14;

    private final ModeComparison comparison;
    private final SubsumptionTable table;
    private final String title;
    private final double endSeconds;
    private final double axisY;
    private final Svg svg;

    ModesSvg(ModeComparison comparison, String title) {
        this.comparison = comparison;
        this.table = comparison.result(Mode.PROMISE).table();
        this.title = title;
        this.endSeconds = comparison.result(Mode.PROMISE).endMicros() / 1e6;
        this.axisY = TOP_PX + comparison.modes().size() * ROW_PX;
        this.svg = Svg.page(1000, axisY + 50 + table.states().size() * LEGEND_LINE_PX, 14, title);
    }

    String draw() {
        List<Mode> modes = comparison.modes();
        List<State> states = table.states();
        svg.text(LEFT_PX, 26, "font-size=\"16\"", title);
        for (int row = 0; row < modes.size(); row++) {
            row(modes.get(row), TOP_PX + row * ROW_PX);
        }
        axis(axisY);
        for (int i = 0; i < states.size(); i++) {
            legend(states.get(i), axisY + 50 + i * LEGEND_LINE_PX);
        }
        return svg.end();
    }

    private void row(Mode mode, double top) {
        var result = comparison.result(mode);
        svg.add(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
                LEFT_PX - 10, top + BAR_PX / 2 + 5, mode);
        for (int i = 0; i < result.states().size(); i++) {
            long end =
                    i + 1 < result.states().size() ? result.states().get(i + 1).timeMicros() : result.endMicros();
            bar(result.states().get(i), end, top);
        }
        svg.add(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" font-size=\"12\" fill=\"#555555\">%d changes, %d messages with colours</text>\n",
                LEFT_PX + PLOT_PX,
                top + BAR_PX + 15,
                result.states().size() - 1,
                result.messages().sent());
        comparison
                .firstDifference(mode)
                .ifPresent(index -> difference(comparison.firstDifferenceMicros(mode, index) / 1e6, top));
    }

    private void bar(StateChange change, long endMicros, double top) {
        double from = x(change.timeMicros() / 1e6);
        double to = x(endMicros / 1e6);
        svg.add(
                "<g><title>%s</title><rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#333333\" stroke-width=\"0.6\"/>",
                change.describe(table).strip(),
                from,
                top,
                to - from,
                BAR_PX,
                Svg.colour(change.state().colour()));
        if (to - from >= NUMBER_PX) {
            svg.add(
                    "<text x=\"%.2f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>",
                    (from + to) / 2, top + BAR_PX / 2 + 5, change.state().number());
        }
        svg.add("</g>\n");
    }

    private void difference(double seconds, double top) {
        svg.add(
                "<line x1=\"%.2f\" x2=\"%.2f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"black\" stroke-width=\"2\" stroke-dasharray=\"4 3\"/>\n",
                x(seconds), x(seconds), top - 6, top + BAR_PX + 18);
        svg.add(
                "<text x=\"%.2f\" y=\"%.1f\" font-size=\"12\">first unlike promise mode, %.1f s</text>\n",
                x(seconds) + 5, top + BAR_PX + 15, seconds);
    }

    private void axis(double y) {
        svg.add(
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"black\"/>\n",
                LEFT_PX, LEFT_PX + PLOT_PX, y, y);
        double step = step(endSeconds);
        for (int i = 0; i * step <= endSeconds * (1 + 1e-9); i++) {
            double x = x(i * step);
            svg.add(
                    "<line x1=\"%.2f\" x2=\"%.2f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"black\"/><text x=\"%.2f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"12\">%s s</text>\n",
                    x,
                    x,
                    y,
                    y + 5,
                    x,
                    y + 19,
                    Json.seconds(StrictMath.round(i * step * 1e6)).replaceFirst("\\.0$", ""));
        }
    }

    /** The tick distance: 1, 2 or 5 times a power of ten, for 5 to 12 ticks. */
    private static double step(double seconds) {
        double power = StrictMath.pow(10, StrictMath.floor(StrictMath.log10(seconds / 5)));
        double rest = seconds / 5 / power;
        return power * (rest >= 5 ? 5 : rest >= 2 ? 2 : 1);
    }

    private void legend(State state, double y) {
        var services = new StringBuilder();
        for (int robot = 0; robot < state.services().size(); robot++) {
            services.append(robot == 0 ? "" : ", ")
                    .append("robot ")
                    .append(robot + 1)
                    .append(' ');
            services.append(state.services().get(robot));
        }
        svg.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"26\" height=\"14\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#333333\" stroke-width=\"0.6\"/><text x=\"%.1f\" y=\"%.1f\">state %d (%s): %s</text>\n",
                LEFT_PX,
                y - 12,
                Svg.colour(state.colour()),
                LEFT_PX + 34,
                y,
                state.number(),
                table.colourName(state.colour()),
                services);
    }

    private double x(double seconds) {
        return LEFT_PX + seconds / endSeconds * PLOT_PX;
    }
}
