package io.troupe.bench;

import java.util.List;
import java.util.Map;

/** The ratios as a drawing (SVG). The workloads that rank nobody come last, say so, and have no colours. */
record CompareDrawing(Results results) {
    private static final int LABEL_WIDTH = 130;
    private static final int DECADE_WIDTH = 130;
    private static final int BAR_HEIGHT = 16;
    private static final int TITLE_HEIGHT = 20;
    private static final int PANEL_GAP = 24;
    private static final double LEAST_RATIO = 0.1;

    /** A panel of bars for each workload, on a logarithmic scale; the thin line is from the lower to the upper quartile. */
    String svg() {
        var panels = new StringBuilder();
        int top = 10;
        for (Workload workload : rankedFirst()) {
            String title = workload.label() + (workload.isRanked() ? "" : " (" + CompareReport.NOT_RANKED + ")");
            panels.append(CompareReport.format("<text x='10' y='%d' class='t'>%s</text>%n", top + 12, title));
            top += TITLE_HEIGHT;
            for (String name : results.turns().getOrDefault(workload, Map.of()).keySet()) {
                panels.append(bar(workload, name, top));
                top += BAR_HEIGHT;
            }
            top += PANEL_GAP;
        }
        int width = LABEL_WIDTH + 5 * DECADE_WIDTH + 80;
        return CompareReport.format(
                        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' font-family='sans-serif'"
                                + " font-size='11'>%n<style>.t{font-weight:bold}.b{fill:#8fb3d9}.m{fill:#d9822b}.u{fill:#ccc}.q{stroke:#333}</style>%n"
                                + "<rect width='100%%' height='100%%' fill='white'/>%n",
                        width, top + 20)
                + panels
                + CompareReport.format(
                        "<text x='10' y='%d'>time per operation as a multiple of the limit's, logarithmic; line: quartiles</text>%n</svg>%n",
                        top + 10);
    }

    private List<Workload> rankedFirst() {
        return results.turns().keySet().stream()
                .sorted((first, second) -> Boolean.compare(second.isRanked(), first.isRanked()))
                .toList();
    }

    private String bar(Workload workload, String name, int top) {
        Quartiles ratio = results.ratio(workload, name);
        boolean ours = name.equals(Contenders.TROUPE.label());
        int middle = top + BAR_HEIGHT / 2;
        return CompareReport.format(
                "<text x='10' y='%d'>%s</text><rect x='%d' y='%d' width='%.1f' height='%d' class='%s'/>"
                        + "<line x1='%.1f' x2='%.1f' y1='%d' y2='%d' class='q'/><text x='%.1f' y='%d'>%s</text>%n",
                middle + 4,
                name,
                LABEL_WIDTH,
                top + 2,
                place(ratio.median()) - LABEL_WIDTH,
                BAR_HEIGHT - 4,
                !workload.isRanked() ? "u" : ours ? "m" : "b",
                place(ratio.lower()),
                place(ratio.upper()),
                middle,
                middle,
                Math.max(place(ratio.median()), place(ratio.upper())) + 6,
                middle + 4,
                CompareReport.number(ratio.median()));
    }

    private static double place(double ratio) {
        return LABEL_WIDTH + DECADE_WIDTH * Math.max(0, Math.log10(ratio / LEAST_RATIO));
    }
}
