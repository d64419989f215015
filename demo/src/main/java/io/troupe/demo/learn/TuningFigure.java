package io.troupe.demo.learn;

import io.troupe.drawing.Svg;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.Gains;
import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** The search on the left, and the paths of the paper's numbers and of the best ones in one arena on the right. */
final class TuningFigure {
    private static final String BEST = "#1b7a3d";
    private static final String PAPER = "#b3261e";

    private TuningFigure() {}

    static String draw(RandomSearch.Result result, RandomSearch.Settings settings) {
        double paper = RandomSearch.score(result.paperChecks());
        double best = RandomSearch.score(result.bestChecks());
        String title = String.format(
                Locale.ROOT, "Random search: %.1f instead of %.1f points in arenas that it has not seen", best, paper);
        Svg svg = Svg.page(900, 460, 12, title);
        svg.text(20, 28, "font-size=\"17\" fill=\"" + Panel.INK + "\"", title);
        svg.text(
                20,
                48,
                "fill=\"" + Panel.GREY + "\"",
                "points: metres along walls in a minute, less one for a touch; mean of " + settings.arenas()
                        + " arenas in the search, of " + settings.checks() + " others in the title");
        search(svg, result.candidates());
        paths(svg, result, settings);
        return svg.end();
    }

    private static void search(Svg svg, List<RandomSearch.Candidate> candidates) {
        double paper = candidates.getFirst().score();
        double most = candidates.stream()
                .mapToDouble(RandomSearch.Candidate::score)
                .max()
                .orElse(paper);
        double least = Math.min(paper, 0) - (most - Math.min(paper, 0)) / 10;
        int count = candidates.size();
        Panel chart = Panel.chart(
                svg,
                60,
                92,
                380,
                310,
                new Point(0, least),
                new Point(count, most + (most - least) / 12),
                "candidates, in the order in which they were drawn",
                "points");
        List<Point> bestSoFar = new ArrayList<>();
        double highest = Double.NEGATIVE_INFINITY;
        for (int i = 0; i < count; i++) {
            double score = candidates.get(i).score();
            if (score >= least) {
                chart.dot(new Point(i, score), Panel.GREY, 2);
            }
            if (score > highest) {
                bestSoFar.add(new Point(i, Math.max(highest, least)));
                bestSoFar.add(new Point(i, score));
                highest = score;
            }
        }
        bestSoFar.add(new Point(count, highest));
        chart.line(bestSoFar.subList(1, bestSoFar.size()), BEST, 2);
        chart.dashes(List.of(new Point(0, paper), new Point(count, paper)), PAPER);
        chart.keyOfDashes(PAPER, "the paper's numbers");
        chart.label(new Point(count, highest + (most - least) / 50), "end", BEST, "the best so far");
    }

    private static void paths(Svg svg, RandomSearch.Result result, RandomSearch.Settings settings) {
        long seed = settings.checkSeed(typical(result));
        Panel map = Panel.map(svg, 500, 80, 350, FollowerTrial.arena(seed));
        path(map, seed, settings, RandomSearch.PAPER, PAPER);
        path(map, seed, settings, result.best().gains(), BEST);
        svg.text(
                675,
                447,
                "text-anchor=\"middle\"",
                settings.steps() / 10 + " s in an arena of 8 m, from one start; rings: touches");
    }

    /** The first arena in which the best numbers gain at least as much as in half of the arenas. */
    private static int typical(RandomSearch.Result result) {
        List<Double> gains = new ArrayList<>();
        for (int i = 0; i < result.paperChecks().size(); i++) {
            gains.add(result.bestChecks().get(i).score()
                    - result.paperChecks().get(i).score());
        }
        double median = gains.stream().sorted().toList().get(gains.size() / 2);
        return gains.indexOf(median);
    }

    private static void path(Panel map, long seed, RandomSearch.Settings settings, Gains gains, String colour) {
        var way = new FollowerTrial.Way(new ArrayList<>(), new ArrayList<>());
        FollowerTrial.run(seed, settings.steps(), new WallFollower(gains), way);
        map.line(way.path(), colour, 1.5);
        way.touches().forEach(place -> map.ring(place, colour));
        map.dot(way.path().getFirst(), Panel.INK, 3);
    }
}
