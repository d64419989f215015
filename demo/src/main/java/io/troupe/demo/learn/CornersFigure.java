package io.troupe.demo.learn;

import io.troupe.drawing.Svg;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.function.Function;

/** How many arenas had how many touches, on the left; the paths in one of them, on the right. */
final class CornersFigure {
    private static final String FORWARD = "#b3261e";
    private static final String BACKWARD = "#2460a7";

    /** Both trials in the arena of a seed. */
    record Pair(long seed, FollowerTrial.Result forward, FollowerTrial.Result backward) {}

    private CornersFigure() {}

    static String draw(List<Pair> pairs, int steps) {
        double seconds = pairs.getFirst().forward().seconds();
        String title = String.format(
                Locale.ROOT,
                "Turning at a corner in %,d arenas: forward is held back %.1f s a minute, backward %.1f s",
                pairs.size(),
                meanHeldS(pairs, Pair::forward) * 60 / seconds,
                meanHeldS(pairs, Pair::backward) * 60 / seconds);
        Svg svg = Svg.page(900, 460, 12, title);
        svg.text(20, 28, "font-size=\"17\" fill=\"" + Panel.INK + "\"", title);
        svg.text(
                20,
                48,
                "fill=\"" + Panel.GREY + "\"",
                "the wall follower, with a wall ahead: forward at 0.1 m/s (the paper) or backward (its model); "
                        + Svg.number(seconds, 0) + " s in each arena");
        distribution(svg, pairs, seconds);
        paths(svg, pairs, steps);
        return svg.end();
    }

    private static double meanHeldS(List<Pair> pairs, Function<Pair, FollowerTrial.Result> side) {
        return pairs.stream()
                .map(side)
                .mapToDouble(FollowerTrial.Result::heldS)
                .average()
                .orElse(0);
    }

    /** Both curves; arenas in which nothing was ever held back begin them above zero. */
    private static void distribution(Svg svg, List<Pair> pairs, double seconds) {
        Panel chart = Panel.chart(
                svg,
                60,
                92,
                380,
                310,
                new Point(0, 0),
                new Point(seconds, 100),
                "held back by something, s of " + Svg.number(seconds, 0),
                "arenas with at most so much, %");
        double label = curve(chart, pairs, Pair::forward, seconds, FORWARD);
        chart.label(new Point(seconds / 2, label - 6), "start", FORWARD, "forward");
        label = curve(chart, pairs, Pair::backward, seconds, BACKWARD);
        chart.label(new Point(seconds / 2, label - 6), "end", BACKWARD, "backward");
    }

    /** Returns the share at half of the time. */
    private static double curve(
            Panel chart, List<Pair> pairs, Function<Pair, FollowerTrial.Result> side, double seconds, String colour) {
        double[] sorted = pairs.stream()
                .map(side)
                .mapToDouble(FollowerTrial.Result::heldS)
                .sorted()
                .toArray();
        List<Point> line = new ArrayList<>();
        double atHalf = 0;
        for (int i = 0; i < sorted.length; i++) {
            if (i + 1 == sorted.length || sorted[i + 1] > sorted[i]) {
                double share = 100.0 * (i + 1) / sorted.length;
                line.add(
                        new Point(sorted[i], line.isEmpty() ? 0 : line.getLast().y()));
                line.add(new Point(sorted[i], share));
                atHalf = sorted[i] <= seconds / 2 ? share : atHalf;
            }
        }
        line.add(new Point(seconds, 100));
        chart.line(line, colour, 2);
        return atHalf;
    }

    /** Draws the first arena whose difference is at least that of three quarters of the arenas. */
    private static void paths(Svg svg, List<Pair> pairs, int steps) {
        List<Double> differences = pairs.stream()
                .map(pair -> pair.forward().heldS() - pair.backward().heldS())
                .toList();
        double upper = differences.stream().sorted().toList().get((pairs.size() - 1) * 3 / 4);
        Pair shown = pairs.get(differences.indexOf(upper));
        Panel map = Panel.map(svg, 500, 80, 350, FollowerTrial.arena(shown.seed()));
        path(map, shown.seed(), steps, CornerStyle.FORWARD, FORWARD);
        path(map, shown.seed(), steps, CornerStyle.BACKWARD, BACKWARD);
        svg.text(
                675,
                447,
                "text-anchor=\"middle\"",
                String.format(
                        Locale.ROOT,
                        "the arena of seed %d: held back %.0f s and %.0f s; rings: touches",
                        shown.seed(),
                        shown.forward().heldS(),
                        shown.backward().heldS()));
    }

    private static void path(Panel map, long seed, int steps, CornerStyle style, String colour) {
        var way = new FollowerTrial.Way(new ArrayList<>(), new ArrayList<>());
        FollowerTrial.run(seed, steps, new WallFollower(style), way);
        map.line(way.path(), colour, 1.5);
        way.touches().forEach(place -> map.ring(place, colour));
        map.dot(way.path().getFirst(), Panel.INK, 3);
    }
}
