package io.troupe.bench.worlds;

import static java.util.Objects.requireNonNull;

import io.troupe.tools.SampleStatistics;
import java.util.Comparator;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Stream;

/**
 * Draws how many times faster than real time the contenders are, by the number of robots, as SVG. Both axes are
 * logarithmic.
 */
record WorldsDrawing(Map<Integer, Map<WorldKind, SampleStatistics>> factors) {
    private static final double LINE_HEIGHT = 13;
    private static final int LEFT = 60;
    private static final int TOP = 74;
    private static final int DECADE_WIDTH = 120;
    private static final int DECADE_HEIGHT = 62;
    private static final int LABEL_WIDTH = 236;
    private static final int FOOT = 70;

    static WorldsDrawing of(WorldsResults results) {
        Map<Integer, Map<WorldKind, SampleStatistics>> factors = new TreeMap<>();
        results.turns().forEach((robots, kinds) -> {
            Map<WorldKind, SampleStatistics> its = new EnumMap<>(WorldKind.class);
            kinds.keySet().forEach(kind -> its.put(kind, results.factor(robots, kind)));
            factors.put(robots, its);
        });
        return new WorldsDrawing(factors);
    }

    String svg() {
        int robotDecades = decadesOfRobots();
        int width = LEFT + robotDecades * DECADE_WIDTH + LABEL_WIDTH;
        int height = TOP + (topDecade() - bottomDecade()) * DECADE_HEIGHT + FOOT;
        var body = new StringBuilder();
        for (int decade = bottomDecade(); decade <= topDecade(); decade++) {
            body.append(horizontal(decade, robotDecades));
        }
        for (int decade = 0; decade <= robotDecades; decade++) {
            double x = x(Math.pow(10, decade));
            body.append(WorldsReport.format(
                    "<line x1='%.1f' x2='%.1f' y1='%d' y2='%.1f' class='g'/><text x='%.1f' y='%.1f' text-anchor='middle'>%,.0f</text>%n",
                    x, x, TOP, y(bottomDecade()), x, y(bottomDecade()) + 16, Math.pow(10, decade)));
        }
        for (WorldKind kind : WorldKind.values()) {
            body.append(curve(kind));
        }
        body.append(labels());
        String title = title();
        return WorldsReport.format(
                        "<svg xmlns='http://www.w3.org/2000/svg' width='%1$d' height='%2$d' viewBox='0 0 %1$d %2$d' role='img'"
                                + " aria-label='%3$s' font-family='sans-serif' font-size='11'>%n<title>%3$s</title>%n"
                                + "<style>.h{font-size:16px}.g{stroke:#ddd}.r{stroke:#333;stroke-dasharray:5 3}"
                                + ".c{fill:none;stroke-width:2}.m{stroke:#d9822b}.b{stroke:#0072b2}.o{stroke:#cc79a7}.d{stroke-dasharray:4 3}.q{stroke:#333}</style>%n"
                                + "<rect width='100%%' height='100%%' fill='white'/>%n<text x='10' y='26' class='h'>%3$s</text>%n",
                        width, height, title)
                + "<text x='10' y='46'>16 sonars and 80 camera columns at 10 Hz, physics at 100 Hz; medians, upright bars: quartiles;"
                + " both axes logarithmic</text>\n<text x='10' y='64'>simulated seconds per second</text>\n"
                + body
                + WorldsReport.format(
                        "<text x='%.1f' y='%d' text-anchor='middle'>number of robots</text>%n"
                                + "<text x='10' y='%d'>sparse: without the rays that can meet nothing coloured, as Troupe does</text>%n</svg>%n",
                        (LEFT + x(Math.pow(10, robotDecades))) / 2, height - 32, height - 10);
    }

    /** The result: the largest measured number of robots that still runs in real time. */
    private String title() {
        int most = factors.keySet().stream()
                .filter(robots -> factors.get(robots).containsKey(WorldKind.TROUPE))
                .filter(robots -> factors.get(robots).get(WorldKind.TROUPE).median() >= 1)
                .max(Integer::compare)
                .orElse(0);
        if (most == 0) {
            return "No measured number of robots runs in real time on one thread";
        }
        return WorldsReport.format(
                "Troupe simulates %,d %s %s times as fast as real time on one thread",
                most,
                most == 1 ? "robot" : "robots",
                label(factors.get(most).get(WorldKind.TROUPE).median()));
    }

    private static String label(double factor) {
        return WorldsReport.format(factor < 100 ? "%.1f" : "%,.0f", factor);
    }

    /** The label of a curve. */
    private static String explained(WorldKind kind) {
        return switch (kind) {
            case TROUPE -> "troupe, one thread";
            case TROUPE_2 -> "troupe-2, devices read by two threads";
            default -> kind.label();
        };
    }

    private String horizontal(int decade, int robotDecades) {
        return WorldsReport.format(
                "<line x1='%d' x2='%d' y1='%.1f' y2='%.1f' class='%s'/><text x='%d' y='%.1f' text-anchor='end'>%s</text>%n",
                LEFT,
                LEFT + robotDecades * DECADE_WIDTH,
                y(decade),
                y(decade),
                decade == 0 ? "r" : "g",
                LEFT - 6,
                y(decade) + 4,
                decade == 0 ? "real time" : decade < 0 ? Double.toString(Math.pow(10, decade)) : label(decade));
    }

    private static String label(int decade) {
        return WorldsReport.format("%,.0f", Math.pow(10, decade));
    }

    /** The medians, joined by lines. */
    private String curve(WorldKind kind) {
        String style = switch (kind) {
            case TROUPE -> "m";
            case TROUPE_2 -> "m d";
            case JBOX2D -> "b";
            case DYN4J -> "o";
            case JBOX2D_SPARSE -> "b d";
            case DYN4J_SPARSE -> "o d";
        };
        var points = new StringBuilder();
        var marks = new StringBuilder();
        double x = 0;
        double y = 0;
        for (int robots : robotsOf(kind)) {
            SampleStatistics factor = quartiles(robots, kind);
            x = x(robots);
            y = y(Math.log10(factor.median()));
            points.append(WorldsReport.format("%.1f,%.1f ", x, y));
            marks.append(WorldsReport.format(
                    "<circle cx='%.1f' cy='%.1f' r='2.5' class='%s' fill='white'/><line x1='%.1f' x2='%.1f' y1='%.1f' y2='%.1f' class='q'/>%n",
                    x,
                    y,
                    style.substring(0, 1),
                    x,
                    x,
                    y(Math.log10(factor.lowerQuartile())),
                    y(Math.log10(factor.upperQuartile()))));
        }
        if (points.isEmpty()) {
            return "";
        }
        return WorldsReport.format(
                        "<polyline points='%s' class='c %s'/>%n",
                        points.toString().strip(), style)
                + marks;
    }

    /** The y coordinate of a curve's last point. */
    private double end(WorldKind kind) {
        return y(Math.log10(quartiles(robotsOf(kind).getLast(), kind).median()));
    }

    /** The labels, at the ends of the curves, moved down where they would overlap. */
    private String labels() {
        List<WorldKind> drawn = Stream.of(WorldKind.values())
                .filter(kind -> !robotsOf(kind).isEmpty())
                .sorted(Comparator.comparingDouble(this::end))
                .toList();
        var labels = new StringBuilder();
        double free = Double.NEGATIVE_INFINITY;
        for (WorldKind kind : drawn) {
            double y = Math.max(end(kind), free);
            free = y + LINE_HEIGHT;
            double x = x(robotsOf(kind).getLast());
            labels.append(WorldsReport.format("<text x='%.1f' y='%.1f'>%s</text>%n", x + 8, y + 4, explained(kind)));
        }
        return labels.toString();
    }

    private SampleStatistics quartiles(int robots, WorldKind kind) {
        return requireNonNull(factors.getOrDefault(robots, Map.of()).get(kind), kind::label);
    }

    private List<Integer> robotsOf(WorldKind kind) {
        return factors.keySet().stream()
                .filter(robots -> factors.get(robots).containsKey(kind))
                .sorted()
                .toList();
    }

    private List<Double> medians() {
        return factors.values().stream()
                .flatMap(kinds -> kinds.values().stream().map(SampleStatistics::median))
                .toList();
    }

    private int decadesOfRobots() {
        int most = factors.keySet().stream().max(Integer::compare).orElse(1);
        return Math.max(1, (int) Math.ceil(Math.log10(most)));
    }

    private int topDecade() {
        double most = medians().stream().max(Double::compare).orElse(1.0);
        return Math.max(1, (int) Math.ceil(Math.log10(most)));
    }

    private int bottomDecade() {
        double least = medians().stream().min(Double::compare).orElse(1.0);
        return Math.min(0, (int) Math.floor(Math.log10(least)));
    }

    private static double x(double robots) {
        return LEFT + DECADE_WIDTH * Math.log10(robots);
    }

    private double y(double decade) {
        return TOP + DECADE_HEIGHT * (topDecade() - decade);
    }
}
