package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/** The results as a Markdown table and as a drawing. */
record CompareReport(CompareOptions options, Map<Workload, Map<String, List<Double>>> nanos) {
    private static final int LABEL_WIDTH = 130;
    private static final int DECADE_WIDTH = 130;
    private static final int BAR_HEIGHT = 16;
    private static final int PANEL_GAP = 44;
    private static final double LEAST_RATIO = 0.1;

    /** Nanoseconds and the ratio to the limit of the same round, each as median (lower quartile..upper quartile). */
    String table() {
        var text = new StringBuilder();
        text.append(format(
                "Java %s, %d processors, %d rounds, seed %d%n%n",
                Runtime.version(), Runtime.getRuntime().availableProcessors(), options.rounds(), options.seed()));
        text.append(
                "| workload | contender | ns per operation | ratio to the limit, same round |\n|---|---|---|---|\n");
        nanos.forEach((workload, results) -> results.forEach((name, values) -> text.append(format(
                "| %s | %s | %s | %s |%n",
                workload.label(), name, cell(Quartiles.of(values)), cell(Quartiles.of(ratios(results, name)))))));
        return text.toString();
    }

    private static List<Double> ratios(Map<String, List<Double>> results, String name) {
        var limit = results.get(Contenders.LIMIT.label());
        var mine = results.get(name);
        List<Double> ratios = new ArrayList<>();
        for (int i = 0; i < mine.size(); i++) {
            ratios.add(mine.get(i) / limit.get(i));
        }
        return ratios;
    }

    private static String cell(Quartiles of) {
        return number(of.median()) + " (" + number(of.lower()) + ".." + number(of.upper()) + ")";
    }

    private static String number(double value) {
        return format(value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%,.0f", value);
    }

    private static String format(String format, Object... values) {
        return String.format(Locale.ROOT, format, values);
    }

    /** A panel of bars for each workload, on a logarithmic scale; the thin line is from the lower to the upper quartile. */
    String drawing() {
        var panels = new StringBuilder();
        int top = 10;
        for (var panel : nanos.entrySet()) {
            panels.append(format(
                    "<text x='10' y='%d' class='t'>%s</text>%n",
                    top + 12, panel.getKey().label()));
            top += 20;
            for (String name : panel.getValue().keySet()) {
                panels.append(bar(name, Quartiles.of(ratios(panel.getValue(), name)), top));
                top += BAR_HEIGHT;
            }
            top += PANEL_GAP - 20;
        }
        int width = LABEL_WIDTH + 5 * DECADE_WIDTH + 80;
        return format(
                        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' font-family='sans-serif'"
                                + " font-size='11'>%n<style>.t{font-weight:bold}.b{fill:#8fb3d9}.m{fill:#d9822b}.q{stroke:#333}</style>%n"
                                + "<rect width='100%%' height='100%%' fill='white'/>%n",
                        width, top + 20)
                + panels
                + format(
                        "<text x='10' y='%d'>time per operation as a multiple of the limit's, logarithmic; line: quartiles</text>%n</svg>%n",
                        top + 10);
    }

    private static String bar(String name, Quartiles ratio, int top) {
        boolean ours = name.equals(Contenders.TROUPE.label());
        int middle = top + BAR_HEIGHT / 2;
        return format(
                "<text x='10' y='%d'>%s</text><rect x='%d' y='%d' width='%.1f' height='%d' class='%s'/>"
                        + "<line x1='%.1f' x2='%.1f' y1='%d' y2='%d' class='q'/><text x='%.1f' y='%d'>%s</text>%n",
                middle + 4,
                name,
                LABEL_WIDTH,
                top + 2,
                place(ratio.median()) - LABEL_WIDTH,
                BAR_HEIGHT - 4,
                ours ? "m" : "b",
                place(ratio.lower()),
                place(ratio.upper()),
                middle,
                middle,
                Math.max(place(ratio.median()), place(ratio.upper())) + 6,
                middle + 4,
                number(ratio.median()));
    }

    private static double place(double ratio) {
        return LABEL_WIDTH + DECADE_WIDTH * Math.max(0, Math.log10(ratio / LEAST_RATIO));
    }
}
