package io.troupe.bench.worlds;

import io.troupe.bench.Quartiles;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Stream;

/** How many times faster than real time, by the number of robots, as a drawing (SVG); both axes are logarithmic. */
record WorldsDrawing(WorldsResults results) {
    private static final double LINE_HEIGHT = 13;
    private static final int LEFT = 60;
    private static final int TOP = 34;
    private static final int DECADE_WIDTH = 120;
    private static final int DECADE_HEIGHT = 62;
    private static final int LABEL_WIDTH = 90;
    private static final int FOOT = 52;

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
        return WorldsReport.format(
                        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' font-family='sans-serif' font-size='11'>%n"
                                + "<style>.t{font-weight:bold}.g{stroke:#ddd}.r{stroke:#333;stroke-dasharray:5 3}"
                                + ".c{fill:none;stroke-width:2}.m{stroke:#d9822b}.b{stroke:#8fb3d9}.o{stroke:#5c7a99}.d{stroke-dasharray:4 3}.q{stroke:#333}</style>%n"
                                + "<rect width='100%%' height='100%%' fill='white'/>%n"
                                + "<text x='10' y='18' class='t'>simulated seconds per second, by the number of robots</text>%n",
                        width, height)
                + body
                + WorldsReport.format(
                        "<text x='10' y='%d'>16 sonars and 80 camera columns at 10 Hz, physics at 100 Hz; both axes logarithmic; bars: quartiles</text>%n</svg>%n",
                        height - 10);
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

    /** The medians, joined; the name stands at the end. */
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
            Quartiles factor = results.factor(robots, kind);
            x = x(robots);
            y = y(Math.log10(factor.median()));
            points.append(WorldsReport.format("%.1f,%.1f ", x, y));
            marks.append(WorldsReport.format(
                    "<circle cx='%.1f' cy='%.1f' r='2.5' class='%s' fill='white'/><line x1='%.1f' x2='%.1f' y1='%.1f' y2='%.1f' class='q'/>%n",
                    x, y, style.substring(0, 1), x, x, y(Math.log10(factor.lower())), y(Math.log10(factor.upper()))));
        }
        if (points.isEmpty()) {
            return "";
        }
        return WorldsReport.format(
                        "<polyline points='%s' class='c %s'/>%n",
                        points.toString().strip(), style)
                + marks;
    }

    /** Where a curve ends. */
    private double end(WorldKind kind) {
        return y(Math.log10(results.factor(robotsOf(kind).getLast(), kind).median()));
    }

    /** At the ends of the curves, moved down where they would stand on each other. */
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
            labels.append(WorldsReport.format("<text x='%.1f' y='%.1f'>%s</text>%n", x + 8, y + 4, kind.label()));
        }
        return labels.toString();
    }

    private List<Integer> robotsOf(WorldKind kind) {
        return results.turns().keySet().stream()
                .filter(robots -> results.turns().get(robots).containsKey(kind))
                .sorted()
                .toList();
    }

    private List<Double> factors() {
        return results.turns().keySet().stream()
                .flatMap(robots -> results.turns().get(robots).keySet().stream()
                        .map(kind -> results.factor(robots, kind).median()))
                .toList();
    }

    private int decadesOfRobots() {
        int most = results.turns().keySet().stream().max(Integer::compare).orElse(1);
        return Math.max(1, (int) Math.ceil(Math.log10(most)));
    }

    private int topDecade() {
        double most = factors().stream().max(Double::compare).orElse(1.0);
        return Math.max(1, (int) Math.ceil(Math.log10(most)));
    }

    private int bottomDecade() {
        double least = factors().stream().min(Double::compare).orElse(1.0);
        return Math.min(0, (int) Math.floor(Math.log10(least)));
    }

    private static double x(double robots) {
        return LEFT + DECADE_WIDTH * Math.log10(robots);
    }

    private double y(double decade) {
        return TOP + DECADE_HEIGHT * (topDecade() - decade);
    }
}
