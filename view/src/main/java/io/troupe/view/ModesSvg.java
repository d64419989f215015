package io.troupe.view;

import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.view.RunResult.StateChange;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** Draws the states over time, one row per mode. */
final class ModesSvg {
    private static final double LEFT_PX = 110;
    private static final double PLOT_PX = 860;
    private static final double WIDTH_PX = 1000;
    private static final double MARGIN_PX = 16;
    private static final double TITLE_PX = 15;
    private static final double TITLE_LINE_PX = 22;
    private static final double ROW_PX = 64;
    private static final double BAR_PX = 34;
    private static final double LEGEND_LINE_PX = 22;
    private static final double FONT_PX = 14;
    /** Narrower bars have no number. */
    private static final double NUMBER_PX = 14;

    private final ModeComparison comparison;
    private final SubsumptionTable table;
    private final List<String> title;
    private final double topPx;
    private final double endSeconds;
    private final double axisY;
    private final Svg legend = Svg.fragment();
    private final Svg svg;

    ModesSvg(ModeComparison comparison, String title) {
        this.comparison = comparison;
        this.table = comparison.result(Mode.PROMISE).table();
        this.title = Svg.wrap(title, WIDTH_PX - 2 * MARGIN_PX, TITLE_PX);
        this.topPx = 34 + this.title.size() * TITLE_LINE_PX;
        this.endSeconds = comparison.result(Mode.PROMISE).endMicros() / 1e6;
        this.axisY = topPx + comparison.modes().size() * ROW_PX;
        double legendY = axisY + 50;
        for (State state : table.states()) {
            legendY = legend(state, legendY);
        }
        this.svg = Svg.page(WIDTH_PX, legendY, FONT_PX, title);
    }

    String draw() {
        List<Mode> modes = comparison.modes();
        for (int line = 0; line < title.size(); line++) {
            svg.text(MARGIN_PX, 4 + (line + 1) * TITLE_LINE_PX, "font-size=\"" + TITLE_PX + "\"", title.get(line));
        }
        for (int row = 0; row < modes.size(); row++) {
            row(modes.get(row), topPx + row * ROW_PX);
        }
        axis(axisY);
        return svg.append(legend).end();
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

    /** Returns where the next entry begins. */
    private double legend(State state, double y) {
        legend.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"26\" height=\"14\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#333333\" stroke-width=\"0.6\"/>",
                LEFT_PX, y - 12, Svg.colour(state.colour()));
        String words = IntStream.range(0, state.services().size())
                .mapToObj(
                        robot -> "robot " + (robot + 1) + " " + state.services().get(robot))
                .collect(Collectors.joining(
                        ", ", "state " + state.number() + " (" + table.colourName(state.colour()) + "): ", ""));
        double bottom = y;
        for (String line : Svg.wrap(words, WIDTH_PX - MARGIN_PX - LEFT_PX - 34, FONT_PX)) {
            legend.text(LEFT_PX + 34, bottom, "", line);
            bottom += LEGEND_LINE_PX;
        }
        return bottom;
    }

    private double x(double seconds) {
        return LEFT_PX + seconds / endSeconds * PLOT_PX;
    }
}
