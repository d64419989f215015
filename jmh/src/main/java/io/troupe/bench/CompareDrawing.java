package io.troupe.bench;

import io.troupe.tools.SampleStatistics;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * Draws times and ratios as SVG. The workloads without a ranking come last, are marked as such, and have no colours.
 */
record CompareDrawing(Map<Workload, Map<String, Bar>> bars) {
    /**
     * The times of one contender in one workload, in nanoseconds and as a multiple of the limit's in the same round.
     */
    record Bar(SampleStatistics nanos, SampleStatistics ratio) {}

    private static final Set<String> NO_LIBRARIES = Set.of(Contenders.LIMIT.label(), Contenders.FLOOR.label());
    private static final int COLUMNS = 2;
    private static final int MARGIN = 16;
    private static final int LABEL_WIDTH = 108;
    private static final int DECADE_WIDTH = 44;
    private static final int DECADES = 5;
    private static final int VALUE_WIDTH = 164;
    private static final int COLUMN_WIDTH = LABEL_WIDTH + DECADES * DECADE_WIDTH + VALUE_WIDTH;
    private static final int HEAD_HEIGHT = 86;
    private static final int BAR_HEIGHT = 18;
    private static final int TITLE_HEIGHT = 20;
    private static final int PANEL_GAP = 22;
    private static final double LEAST_RATIO = 0.1;

    static CompareDrawing of(Results results) {
        Map<Workload, Map<String, Bar>> bars = new LinkedHashMap<>();
        results.turns().forEach((workload, contenders) -> {
            Map<String, Bar> its = new LinkedHashMap<>();
            contenders
                    .keySet()
                    .forEach(name ->
                            its.put(name, new Bar(results.nanos(workload, name), results.ratio(workload, name))));
            bars.put(workload, its);
        });
        return new CompareDrawing(bars);
    }

    /**
     * The drawing: a panel of bars for each workload, on a logarithmic scale. The thin line is from the lower to the
     * upper quartile.
     */
    String svg() {
        var panels = new StringBuilder();
        List<Workload> workloads = rankedFirst();
        int top = HEAD_HEIGHT;
        for (int first = 0; first < workloads.size(); first += COLUMNS) {
            int most = 0;
            for (int column = 0; column < COLUMNS && first + column < workloads.size(); column++) {
                Workload workload = workloads.get(first + column);
                panels.append(panel(workload, MARGIN + column * (COLUMN_WIDTH + MARGIN), top));
                most = Math.max(most, bars.get(workload).size());
            }
            top += TITLE_HEIGHT + most * BAR_HEIGHT + PANEL_GAP;
        }
        int width = MARGIN + COLUMNS * (COLUMN_WIDTH + MARGIN);
        String title = title();
        return CompareReport.format(
                        "<svg xmlns='http://www.w3.org/2000/svg' width='%1$d' height='%2$d' viewBox='0 0 %1$d %2$d' role='img'"
                                + " aria-label='%3$s' font-family='sans-serif' font-size='13'>%n<title>%3$s</title>%n"
                                + "<style>.t{font-weight:bold}.h{font-size:16px}.b{fill:#8fb3d9}.m{fill:#d9822b}.u{fill:#ccc}.q{stroke:#333}.l{stroke:#999}</style>%n"
                                + "<rect width='100%%' height='100%%' fill='white'/>%n<text x='%4$d' y='26' class='h'>%3$s</text>%n",
                        width, top, title, MARGIN)
                + CompareReport.format(
                        "<text x='%1$d' y='48'>shorter is better; bar and ×: time per operation as a multiple of the limit's in the same round"
                                + " (logarithmic);</text>%n"
                                + "<text x='%1$d' y='66'>ns: time per operation; thin line: quartiles; upright line: the limit</text>%n",
                        MARGIN)
                + panels
                + CompareReport.format("</svg>%n");
    }

    /** The result: in how many workloads our actors take the least time of all libraries. */
    private String title() {
        List<Workload> ranked =
                bars.keySet().stream().filter(Workload::isRanked).toList();
        long first = ranked.stream().filter(this::isOursFastest).count();
        return "In this run Troupe has the lowest median time per operation in " + first + " of " + ranked.size()
                + " workloads, limit and floor apart";
    }

    private boolean isOursFastest(Workload workload) {
        Map<String, Bar> contenders = bars.get(workload);
        Bar ours = contenders.get(Contenders.TROUPE.label());
        return ours != null
                && contenders.entrySet().stream()
                        .filter(each -> !NO_LIBRARIES.contains(each.getKey()))
                        .allMatch(each ->
                                ours.ratio.median() <= each.getValue().ratio.median());
    }

    private List<Workload> rankedFirst() {
        return bars.keySet().stream()
                .sorted((first, second) -> Boolean.compare(second.isRanked(), first.isRanked()))
                .toList();
    }

    private String panel(Workload workload, int left, int top) {
        String title = workload.label() + (workload.isRanked() ? "" : " (" + CompareReport.NOT_RANKED + ")");
        var panel = new StringBuilder(
                CompareReport.format("<text x='%d' y='%d' class='t'>%s</text>%n", left, top + 12, title));
        int below = top + TITLE_HEIGHT;
        int count = bars.get(workload).size();
        for (var bar : bars.get(workload).entrySet()) {
            panel.append(bar(workload.isRanked(), bar.getKey(), bar.getValue(), left, below));
            below += BAR_HEIGHT;
        }
        return panel
                + CompareReport.format(
                        "<line x1='%1$.1f' x2='%1$.1f' y1='%2$d' y2='%3$d' class='l'/>%n",
                        left + place(1), below - count * BAR_HEIGHT, below);
    }

    private static String bar(boolean ranked, String name, Bar bar, int left, int top) {
        boolean ours = name.equals(Contenders.TROUPE.label());
        int middle = top + BAR_HEIGHT / 2;
        SampleStatistics ratio = bar.ratio;
        return CompareReport.format(
                "<text x='%d' y='%d'>%s</text><rect x='%d' y='%d' width='%.1f' height='%d' class='%s'/>"
                        + "<line x1='%.1f' x2='%.1f' y1='%d' y2='%d' class='q'/><text x='%.1f' y='%d'>%s ns, %s×</text>%n",
                left,
                middle + 4,
                name,
                left + LABEL_WIDTH,
                top + 2,
                place(ratio.median()) - LABEL_WIDTH,
                BAR_HEIGHT - 4,
                !ranked ? "u" : ours ? "m" : "b",
                left + place(ratio.lowerQuartile()),
                left + place(ratio.upperQuartile()),
                middle,
                middle,
                left + Math.max(place(ratio.median()), place(ratio.upperQuartile())) + 6,
                middle + 4,
                CompareReport.number(bar.nanos.median()),
                CompareReport.number(ratio.median()));
    }

    private static double place(double ratio) {
        return LABEL_WIDTH + DECADE_WIDTH * Math.max(0, Math.log10(ratio / LEAST_RATIO));
    }
}
