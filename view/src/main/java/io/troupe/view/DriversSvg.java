package io.troupe.view;

import io.troupe.drawing.Svg;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.State;
import io.troupe.view.RobotRecord.Sample;
import io.troupe.view.RunResult.StateChange;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.BiConsumer;
import org.jspecify.annotations.Nullable;

/** Draws which node drove each robot when, and with which service; the states above. */
final class DriversSvg {
    private static final double WIDTH_PX = 520; // readable on a phone
    private static final double LEFT_PX = 14;
    private static final double PLOT_PX = WIDTH_PX - 2 * LEFT_PX;
    private static final double FONT_PX = 15;
    private static final double TITLE_PX = 18;
    private static final double TITLE_LINE_PX = 24;
    private static final double LABEL_PX = 22;
    private static final double STATE_BAR_PX = 24;
    private static final double NODE_BAR_PX = 30;
    private static final double SERVICE_BAR_PX = 14;
    private static final double BAR_MARGIN_PX = 5;
    private static final double BETWEEN_PX = 16;
    private static final double LEGEND_LINE_PX = 24;
    private static final double AXIS_PX = 34;
    private static final double AXIS_FONT_PX = 13;
    private static final double FEWEST_PX_PER_TICK = 60;
    private static final int MOST_LETTERS = 24; // of a node's name, so that the words of a fault fit on the page
    private static final String STATE_OPACITY = "0.45";
    private static final String FAULT = "#d11a2a";

    /** Colours of nodes, used cyclically; lighter than those of services, so that a name is readable on them. */
    private static final List<String> NODE_COLOURS =
            List.of("#f6b26b", "#9fc5e8", "#c9d67a", "#e6a8d7", "#d0c3a6", "#b7b7b7");

    private final RunResult result;
    private final @Nullable DriverFault fault;
    private final List<DriverFault.Gap> gaps;
    private final Map<String, String> nodes = new LinkedHashMap<>();
    private final ServiceColours services;
    private final double endMicros;
    private final Svg body = Svg.fragment();
    private final Svg words = Svg.fragment(); // above everything else
    private double y;

    DriversSvg(RunResult result, @Nullable DriverFault fault) {
        this.result = result;
        this.fault = fault;
        this.gaps = fault == null ? List.of() : fault.gaps(result);
        this.services = ServiceColours.of(result.table());
        this.endMicros = Math.max(1, result.endMicros());
        result.robots().stream()
                .flatMap(robot -> robot.drivers().stream())
                .map(RobotRecord.Driver::node)
                .forEach(node -> {
                    if (node != null) {
                        nodes.putIfAbsent(node, "");
                    }
                });
        int number = 0;
        for (String node : nodes.keySet().stream().sorted().toList()) {
            nodes.put(node, NODE_COLOURS.get(number++ % NODE_COLOURS.size()));
        }
    }

    String draw() {
        String title = title();
        for (String line : Svg.wrap(title, PLOT_PX, TITLE_PX)) {
            y += TITLE_LINE_PX;
            body.text(LEFT_PX, y, "font-size=\"" + TITLE_PX + "\"", line);
        }
        y += BETWEEN_PX;
        double faultTop = y;
        if (fault != null) {
            y += LABEL_PX;
        }
        states();
        result.robots().forEach(this::lane);
        if (fault != null) {
            drawFault(fault, faultTop);
        }
        axis();
        legend();
        Svg page = Svg.page(WIDTH_PX, y + LEFT_PX, FONT_PX, title);
        return page.append(body).append(words).end();
    }

    private String title() {
        var title = new StringBuilder("Which node drove which robot");
        if (fault != null) {
            title.append("; ")
                    .append(fault.node())
                    .append(" was ")
                    .append(fault.what())
                    .append(" at ")
                    .append(seconds(fault.timeMicros()));
        }
        return title.toString();
    }

    private double x(double micros) {
        return LEFT_PX + micros / endMicros * PLOT_PX;
    }

    private static String seconds(double micros) {
        return String.format(Locale.ROOT, "%.1f s", micros / 1e6);
    }

    // ---- states

    private void states() {
        label("state");
        List<StateChange> states = result.states();
        for (int i = 0; i < states.size(); i++) {
            StateChange change = states.get(i);
            double from = x(change.timeMicros());
            double to = x(i + 1 < states.size() ? states.get(i + 1).timeMicros() : endMicros);
            bar(
                    from,
                    to,
                    STATE_BAR_PX,
                    Svg.colour(change.state().colour()),
                    STATE_OPACITY,
                    change.describe(result.table()).strip());
            words("" + change.state().number(), from, to, STATE_BAR_PX);
        }
        y += STATE_BAR_PX + BETWEEN_PX;
    }

    private void label(String words) {
        y += LABEL_PX;
        body.text(LEFT_PX, y - 6, "font-weight=\"bold\"", words);
    }

    private void bar(double from, double to, double height, String colour, String opacity, String title) {
        body.add(
                "<rect x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"%s\"><title>%s</title></rect>\n",
                from, y, to - from, height, colour, opacity, title);
    }

    /** Words at the beginning of a bar, if there is room for them. */
    private void words(String text, double from, double to, double height) {
        if (Svg.width(text, FONT_PX) + BAR_MARGIN_PX <= to - from) {
            words.text(from + BAR_MARGIN_PX, y + height / 2 + 5, "", text);
        }
    }

    // ---- robots

    private void lane(RobotRecord robot) {
        label("robot " + (robot.index() + 1));
        frame(NODE_BAR_PX + SERVICE_BAR_PX);
        eachDriver(robot, (driver, end) -> {
            String node = driver.node();
            if (node != null) {
                double from = x(driver.fromMicros());
                double to = x(end);
                String title = node + " from " + seconds(driver.fromMicros()) + " to " + seconds(end);
                bar(from, to, NODE_BAR_PX, nodes.getOrDefault(node, "#cccccc"), "1", title);
                words(shown(node), from, to, NODE_BAR_PX);
            }
        });
        double top = y;
        y += NODE_BAR_PX;
        eachService(
                robot,
                (service, span) -> bar(
                        x(span.from),
                        x(span.to),
                        SERVICE_BAR_PX,
                        services.colour(service),
                        "1",
                        service + " from " + seconds(span.from) + " to " + seconds(span.to)));
        y = top;
        gaps.stream().filter(gap -> gap.robot() == robot.index()).forEach(this::gap);
        y += NODE_BAR_PX + SERVICE_BAR_PX + BETWEEN_PX;
        if (gaps.stream().anyMatch(gap -> gap.robot() == robot.index())) {
            y += LABEL_PX - BETWEEN_PX / 2;
        }
    }

    /** Nothing drives a robot where only the frame is. */
    private void frame(double height) {
        body.add(
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#f4f4f4\" stroke=\"#999999\" stroke-width=\"0.6\"/>\n",
                LEFT_PX, y, PLOT_PX, height);
    }

    private void eachDriver(RobotRecord robot, BiConsumer<RobotRecord.Driver, Double> drawn) {
        List<RobotRecord.Driver> drivers = robot.drivers();
        for (int i = 0; i < drivers.size(); i++) {
            RobotRecord.Driver driver = drivers.get(i);
            double end = i + 1 < drivers.size() ? drivers.get(i + 1).fromMicros() : endMicros;
            DriverFault known = fault;
            if (known != null
                    && known.node().equals(driver.node())
                    && driver.fromMicros() <= known.timeMicros()
                    && known.timeMicros() < end) {
                end = known.timeMicros(); // the record has the end when it was noticed
            }
            drawn.accept(driver, end);
        }
    }

    private record Span(double from, double to) {}

    private void eachService(RobotRecord robot, BiConsumer<String, Span> drawn) {
        List<Sample> path = robot.path();
        int first = 0;
        for (int i = 1; i <= path.size(); i++) {
            String service = path.get(first).service();
            if (i == path.size() || !path.get(i).service().equals(service)) {
                if (result.table().service(service).isPresent()) {
                    double to = i == path.size() ? endMicros : path.get(i).timeMicros();
                    cutAtTheFault(robot, path.get(first).timeMicros(), to).forEach(span -> drawn.accept(service, span));
                }
                first = i;
            }
        }
    }

    /** Between the fault and the next driver no service drives, although the last one has not reported its end. */
    private List<Span> cutAtTheFault(RobotRecord robot, double from, double to) {
        List<Span> spans = new ArrayList<>();
        DriverFault known = fault;
        var gap = gaps.stream().filter(each -> each.robot() == robot.index()).findFirst();
        if (known == null || gap.isEmpty()) {
            return List.of(new Span(from, to));
        }
        if (from < known.timeMicros()) {
            spans.add(new Span(from, Math.min(to, known.timeMicros())));
        }
        if (to > gap.get().endMicros()) {
            spans.add(new Span(Math.max(from, gap.get().endMicros()), to));
        }
        return spans;
    }

    // ---- the fault

    private void gap(DriverFault.Gap gap) {
        double from = x(fault == null ? 0 : fault.timeMicros());
        double to = x(gap.endMicros());
        double height = NODE_BAR_PX + SERVICE_BAR_PX;
        body.add(
                "<rect class=\"gap\" x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"white\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                from, y, to - from, height, FAULT);
        String length = seconds(gap.endMicros() - (fault == null ? 0 : fault.timeMicros()));
        String next = gap.next();
        String text = next == null ? "no driver any more" : "no driver for " + length + ", then " + shown(next);
        withName(words, next == null ? "" : next, () -> centred((from + to) / 2, y + height + 17, text));
    }

    /** A name without its middle if it is long; the tooltip has the whole one. */
    private static String shown(String node) {
        int half = (MOST_LETTERS - 1) / 2;
        return node.length() <= MOST_LETTERS
                ? node
                : node.substring(0, half) + "\u2026" + node.substring(node.length() - half);
    }

    /** Draws what has the whole name of a node as its tooltip, if the name is shortened. */
    private static void withName(Svg onto, String node, Runnable drawing) {
        boolean isShortened = !shown(node).equals(node);
        if (isShortened) {
            onto.add("<g><title>%s</title>\n", node);
        }
        drawing.run();
        if (isShortened) {
            onto.add("</g>\n");
        }
    }

    /** Words in the middle, on white, since the line of the fault may run behind them. */
    private void centred(double middle, double baseline, String text) {
        double half = Svg.width(text, FONT_PX) / 2;
        double x = Math.max(LEFT_PX + half, Math.min(LEFT_PX + PLOT_PX - half, middle));
        words.add(
                "<rect class=\"blank\" x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\" fill=\"white\"/>\n",
                x - half, baseline - FONT_PX, 2 * half, FONT_PX + 4);
        words.text(x, baseline, "text-anchor=\"middle\" fill=\"" + FAULT + "\"", text);
    }

    private void drawFault(DriverFault known, double top) {
        double x = x(known.timeMicros());
        body.add(
                "<line x1=\"%.2f\" x2=\"%.2f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"5 4\"/>\n",
                x, x, top + LABEL_PX - 4, y - BETWEEN_PX / 2, FAULT);
        String text = shown(known.node()) + " " + known.what();
        withName(words, known.node(), () -> centred(x, top + LABEL_PX - 8, text));
    }

    // ---- axis and legend

    private void axis() {
        body.add(
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"black\"/>\n",
                LEFT_PX, LEFT_PX + PLOT_PX, y, y);
        double step = Svg.roundStep(endMicros / 1e6 * FEWEST_PX_PER_TICK / PLOT_PX);
        for (int i = 0; i * step <= endMicros / 1e6 * (1 + 1e-9); i++) {
            double x = x(i * step * 1e6);
            String anchor = i == 0 ? "start" : x > LEFT_PX + PLOT_PX - FEWEST_PX_PER_TICK / 2 ? "end" : "middle";
            body.add(
                    "<line x1=\"%.2f\" x2=\"%.2f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"black\"/><text x=\"%.2f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%s\">%s s</text>\n",
                    x, x, y, y + 5, x, y + 19, anchor, AXIS_FONT_PX, Svg.number(i * step, 1));
        }
        y += AXIS_PX;
    }

    private void legend() {
        y += LEGEND_LINE_PX / 2;
        double x = LEFT_PX;
        for (String node : nodes.keySet().stream().sorted().toList()) {
            x = entry(x, nodes.getOrDefault(node, ""), "1", "node " + shown(node), node);
        }
        x = newLine(x);
        for (Service service : result.table().services()) {
            x = entry(x, services.colour(service.name()), "1", "service " + service, "");
        }
        x = newLine(x);
        for (State state : result.table().states()) {
            String colour = result.table().colourName(state.colour());
            x = entry(
                    x, Svg.colour(state.colour()), STATE_OPACITY, "state " + state.number() + " (" + colour + ")", "");
        }
    }

    private double newLine(double x) {
        y += x > LEFT_PX ? LEGEND_LINE_PX : 0;
        return LEFT_PX;
    }

    /** Returns where the next entry begins. */
    private double entry(double x, String colour, String opacity, String text, String node) {
        double width = 34 + Svg.width(text, FONT_PX) + 6;
        double from = x > LEFT_PX && x + width > LEFT_PX + PLOT_PX ? newLine(x) : x;
        withName(
                body,
                node,
                () -> body.add(
                        "<rect x=\"%.1f\" y=\"%.1f\" width=\"26\" height=\"14\" fill=\"%s\" fill-opacity=\"%s\" stroke=\"#333333\" stroke-width=\"0.6\"/><text x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                        from, y - 12, colour, opacity, from + 34, y, text));
        return from + width;
    }
}
