package io.troupe.bench.bus;

import io.troupe.drawing.Svg;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;

/**
 * Draws how long requests take, as SVG: a curve for each contender and payload, from the fastest percent to the slowest
 * thousandth.
 *
 * @param micros the times at {@link BusTurn#SHARES}, by workload and contender
 */
record BusDrawing(Map<BusWorkload, Map<BusContender, List<Double>>> micros) {
    private static final double FONT = 11;
    private static final double LEFT = 64;
    private static final double TOP = 76;
    private static final double WIDTH = 520;
    private static final double HEIGHT = 260;
    private static final double RIGHT = 60;
    private static final double FOOT = 56;
    private static final double LINE_HEIGHT = 14;
    private static final double MEDIAN = 0.5;
    private static final double MORE = 1.01;
    private static final String OURS = "#d9822b";
    private static final String ACTOR = "#009e73";
    private static final String OTHER = "#0072b2";

    static BusDrawing of(BusResults results) {
        Map<BusWorkload, Map<BusContender, List<Double>>> micros = new EnumMap<>(BusWorkload.class);
        for (BusWorkload workload : results.measured(BusWorkload.Part.ASK)) {
            Map<BusContender, List<Double>> its = new EnumMap<>(BusContender.class);
            for (BusContender contender : workload.part().contenders()) {
                its.put(
                        contender,
                        BusTurn.SHARES.stream()
                                .map(share -> results.of(workload, contender, turn -> turn.micros(share))
                                        .median())
                                .toList());
            }
            micros.put(workload, its);
        }
        return new BusDrawing(micros);
    }

    String svg() {
        var svg = Svg.page(LEFT + WIDTH + RIGHT, TOP + HEIGHT + FOOT, FONT, title());
        svg.text(10, 26, "font-size=\"16\"", title());
        svg.text(
                10,
                46,
                "",
                "requests one at a time, two connections in one process, server on the same machine; medians over"
                        + " the rounds");
        svg.text(10, 64, "", "microseconds until the reply, logarithmic");
        for (double tick : ticks()) {
            svg.add(
                    "<line x1=\"%s\" x2=\"%s\" y1=\"%s\" y2=\"%s\" stroke=\"#ddd\"/>\n",
                    LEFT, LEFT + WIDTH, y(tick), y(tick));
            svg.text(LEFT - 6, y(tick) + 4, "text-anchor=\"end\"", BusReport.format("%,.0f", tick));
        }
        for (double share : BusTurn.SHARES) {
            svg.add(
                    "<line x1=\"%s\" x2=\"%s\" y1=\"%s\" y2=\"%s\" stroke=\"#eee\"/>\n",
                    x(share), x(share), TOP, TOP + HEIGHT);
            svg.text(x(share), TOP + HEIGHT + 16, "text-anchor=\"middle\"", BusReport.percentile(share));
        }
        svg.text(
                LEFT + WIDTH / 2,
                TOP + HEIGHT + 40,
                "text-anchor=\"middle\"",
                "share of the requests that took at most that long (logistic scale)");
        micros.forEach((workload, contenders) -> contenders.forEach((contender, times) -> {
            svg.add(
                    "<polyline points=\"%s\" fill=\"none\" stroke-width=\"2\" stroke=\"%s\" stroke-dasharray=\"%s\"/>\n",
                    points(times), colour(contender), dashes(workload));
        }));
        legend(svg);
        return svg.end();
    }

    private String title() {
        var small = micros.getOrDefault(BusWorkload.ASK_64, Map.of());
        var ours = small.get(BusContender.TROUPE);
        var raw = small.get(BusContender.RAW);
        if (ours == null || raw == null) {
            return "How long requests take";
        }
        int middle = BusTurn.SHARES.indexOf(MEDIAN);
        return BusReport.format(
                "Half of the requests over our bus take at most %s us, by NATS itself %s us",
                Math.round(ours.get(middle)), Math.round(raw.get(middle)));
    }

    private void legend(Svg svg) {
        double y = TOP + 10;
        for (var workload : micros.entrySet()) {
            for (BusContender contender : workload.getValue().keySet()) {
                svg.add(
                        "<line x1=\"%s\" x2=\"%s\" y1=\"%s\" y2=\"%s\" stroke-width=\"2\" stroke=\"%s\""
                                + " stroke-dasharray=\"%s\"/>\n",
                        LEFT + 10, LEFT + 40, y - 4, y - 4, colour(contender), dashes(workload.getKey()));
                svg.textOnLines(
                        LEFT + 46,
                        y,
                        "",
                        contender.label() + ", " + workload.getKey().label());
                y += LINE_HEIGHT;
            }
        }
    }

    private static String colour(BusContender contender) {
        return switch (contender) {
            case TROUPE -> OURS;
            case ACTOR -> ACTOR;
            default -> OTHER;
        };
    }

    private static String dashes(BusWorkload workload) {
        return workload == BusWorkload.ASK_64 ? "none" : "5 3";
    }

    private String points(List<Double> times) {
        var points = new StringBuilder();
        for (int i = 0; i < times.size(); i++) {
            points.append(BusReport.format("%.1f,%.1f ", x(BusTurn.SHARES.get(i)), y(times.get(i))));
        }
        return points.toString().strip();
    }

    /** The odds on a logarithmic scale, so that both ends of the distribution show. */
    private static double x(double share) {
        double first = odds(BusTurn.SHARES.getFirst());
        return LEFT + WIDTH * (odds(share) - first) / (odds(BusTurn.SHARES.getLast()) - first);
    }

    private static double odds(double share) {
        return StrictMath.log10(share / (1 - share));
    }

    private double y(double time) {
        List<Double> ticks = ticks();
        double least = StrictMath.log10(ticks.getFirst());
        return TOP + HEIGHT * (1 - (StrictMath.log10(time) - least) / (StrictMath.log10(ticks.getLast()) - least));
    }

    /** 1, 2 and 5 times powers of ten, around all times. */
    private List<Double> ticks() {
        List<Double> all = micros.values().stream()
                .flatMap(contenders -> contenders.values().stream())
                .flatMap(List::stream)
                .sorted()
                .toList();
        List<Double> ticks = new ArrayList<>();
        if (!all.isEmpty()) {
            for (double tick = below(all.getFirst()); ticks.isEmpty() || ticks.getLast() < all.getLast(); ) {
                ticks.add(tick);
                tick = Svg.roundStep(tick * MORE);
            }
        }
        return ticks;
    }

    private static double below(double time) {
        return 1 / Svg.roundStep(1 / time);
    }
}
