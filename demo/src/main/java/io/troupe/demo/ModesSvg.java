package io.troupe.demo;

import io.troupe.demo.RunRecorder.StateChange;
import io.troupe.demo.svg.SvgElements;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.List;
import java.util.Locale;

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
    private final StringBuilder svg = new StringBuilder();

    ModesSvg(ModeComparison comparison, String title) {
        this.comparison = comparison;
        this.table = comparison.result(Mode.PROMISE).table();
        this.title = title;
        this.endSeconds = comparison.result(Mode.PROMISE).endMicros() / 1e6;
    }

    String draw() {
        List<Mode> modes = comparison.modes();
        List<State> states = table.states();
        double axis = TOP_PX + modes.size() * ROW_PX;
        svg.append(SvgElements.begin(1000, axis + 50 + states.size() * LEGEND_LINE_PX, 14, title));
        svg.append(SvgElements.text(LEFT_PX, 26, "font-size=\"16\"", title));
        for (int row = 0; row < modes.size(); row++) {
            row(modes.get(row), TOP_PX + row * ROW_PX);
        }
        axis(axis);
        for (int i = 0; i < states.size(); i++) {
            legend(states.get(i), axis + 50 + i * LEGEND_LINE_PX);
        }
        append("</svg>%n");
        return svg.toString();
    }

    private void row(Mode mode, double top) {
        var result = comparison.result(mode);
        append("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>%n", LEFT_PX - 10, top + BAR_PX / 2 + 5, mode);
        for (int i = 0; i < result.states().size(); i++) {
            long end =
                    i + 1 < result.states().size() ? result.states().get(i + 1).timeMicros() : result.endMicros();
            bar(result.states().get(i), end, top);
        }
        append(
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" font-size=\"12\" fill=\"#555555\">%d changes, %d messages with colours</text>%n",
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
        append(
                "<g><title>%s</title><rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#333333\" stroke-width=\"0.6\"/>",
                SvgElements.escape(change.describe(table).strip()),
                from,
                top,
                to - from,
                BAR_PX,
                SvgElements.colour(change.state().colour()));
        if (to - from >= NUMBER_PX) {
            append(
                    "<text x=\"%.2f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>",
                    (from + to) / 2, top + BAR_PX / 2 + 5, change.state().number());
        }
        append("</g>%n");
    }

    private void difference(double seconds, double top) {
        append(
                "<line x1=\"%1$.2f\" x2=\"%1$.2f\" y1=\"%2$.1f\" y2=\"%3$.1f\" stroke=\"black\" stroke-width=\"2\" stroke-dasharray=\"4 3\"/>%n",
                x(seconds), top - 6, top + BAR_PX + 18);
        append(
                "<text x=\"%.2f\" y=\"%.1f\" font-size=\"12\">first unlike promise mode, %.1f s</text>%n",
                x(seconds) + 5, top + BAR_PX + 15, seconds);
    }

    private void axis(double y) {
        append(
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%3$.1f\" y2=\"%3$.1f\" stroke=\"black\"/>%n",
                LEFT_PX, LEFT_PX + PLOT_PX, y);
        double step = step(endSeconds);
        for (int i = 0; i * step <= endSeconds * (1 + 1e-9); i++) {
            append(
                    "<line x1=\"%1$.2f\" x2=\"%1$.2f\" y1=\"%2$.1f\" y2=\"%3$.1f\" stroke=\"black\"/><text x=\"%1$.2f\" y=\"%4$.1f\" text-anchor=\"middle\" font-size=\"12\">%5$s s</text>%n",
                    x(i * step),
                    y,
                    y + 5,
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
        append(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"26\" height=\"14\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#333333\" stroke-width=\"0.6\"/><text x=\"%.1f\" y=\"%.1f\">state %d (%s): %s</text>%n",
                LEFT_PX,
                y - 12,
                SvgElements.colour(state.colour()),
                LEFT_PX + 34,
                y,
                state.number(),
                table.colourName(state.colour()),
                SvgElements.escape(services.toString()));
    }

    private double x(double seconds) {
        return LEFT_PX + seconds / endSeconds * PLOT_PX;
    }

    private void append(String format, Object... values) {
        svg.append(String.format(Locale.ROOT, format, values));
    }
}
