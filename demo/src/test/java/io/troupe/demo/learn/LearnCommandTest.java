package io.troupe.demo.learn;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.demo.CommandLineBench;
import io.troupe.demo.ParsedSvg;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.sim.model.Point;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.parallel.Execution;
import org.junit.jupiter.api.parallel.ExecutionMode;

@Execution(ExecutionMode.CONCURRENT)
class LearnCommandTest extends CommandLineBench {
    @Test
    void learn_withoutACommand_namesItsCommands() {
        assertThat(printed("learn")).contains("troupe learn", "tune", "corners", "serve");
    }

    @Test
    void corners_printsMeansOfItsTable_andIsTheSameTwice() throws Exception {
        String first = printed("learn corners --arenas 6 --seconds 20 --seed 3 --out DIR/one");
        String second = printed("learn corners --arenas 6 --seconds 20 --seed 3 --out DIR/two");

        assertThat(first).contains("12 trials of 200 steps in ", " steps a second", "wrote ");
        assertThat(table(second)).isEqualTo(table(first));
        assertThat(written("two/corners.csv")).isEqualTo(written("one/corners.csv"));
        assertThat(written("two/corners.svg")).isEqualTo(written("one/corners.svg"));
        List<String> lines = written("one/corners.csv").lines().toList();
        assertThat(lines).hasSize(13);
        double heldS = lines.stream()
                .filter(line -> line.contains(",forward,"))
                .mapToDouble(line -> Double.parseDouble(line.substring(line.lastIndexOf(',') + 1)))
                .average()
                .orElseThrow();
        assertThat(first).containsPattern(String.format("held back, s a minute +%.2f ", heldS * 3));
        var svg = ParsedSvg.parse(written("one/corners.svg"));
        assertThat(svg.elements("polyline")).as("two curves and two paths").hasSize(4);
    }

    private static String table(String output) {
        return output.substring(0, output.indexOf(" trials of "));
    }

    @Test
    void tune_findsNumbersAtLeastAsGood_andDrawsEachCandidate() throws Exception {
        String output = printed("learn tune --candidates 8 --arenas 3 --checks 2 --seconds 10 --out DIR");

        assertThat(output).contains("28 trials of 100 steps in ", "score in other arenas");
        List<Double> scores = written("tuning.csv")
                .lines()
                .skip(1)
                .map(LearnCommandTest::score)
                .toList();
        double best = scores.stream().max(Double::compare).orElseThrow();
        assertThat(scores).hasSize(8);
        assertThat(output)
                .containsPattern(
                        String.format("score in the arenas of the search +%.2f +%.2f", scores.getFirst(), best));
        var svg = ParsedSvg.parse(written("tuning.svg"));
        svg.assertWordsAreOnThePage();
        assertThat(svg.texts()).contains("the paper's numbers", "the best so far", "points");
        double highestDot = svg.elements("circle", "r", "2").stream()
                .mapToDouble(dot -> ParsedSvg.number(dot, "cy"))
                .min()
                .orElseThrow();
        assertThat(svg.elements("text"))
                .filteredOn(text -> text.getTextContent().equals("the paper's numbers"))
                .allSatisfy(label -> assertThat(ParsedSvg.number(label, "y"))
                        .as("above the dots")
                        .isLessThan(highestDot - 2));
    }

    private static double score(String line) {
        return Double.parseDouble(line.substring(0, line.indexOf(',')));
    }

    @Test
    void candidates_areAroundThePapersNumbers_andTheFirstIsThePaper() {
        var settings = new RandomSearch.Settings(50, 1, 1, 2, 9);
        RandomSearch.Result result;
        try (var runner = new TrialRunner(settings.trials(), settings.steps())) {
            result = RandomSearch.run(settings, runner);
        }
        assertThat(result.candidates()).hasSize(50);
        assertThat(result.candidates().getFirst().gains()).isEqualTo(RandomSearch.PAPER);
        assertThat(result.candidates()).allSatisfy(candidate -> {
            assertThat(candidate.gains().maxWallM()).isBetween(0.2, 0.8);
            assertThat(candidate.gains().atCorner().forwardMps()).isBetween(-0.2, 0.2);
            assertThat(candidate.gains().atCorner().turnRadps()).isBetween(-1.2, -0.3);
            assertThat(candidate.score()).isLessThanOrEqualTo(result.best().score());
        });
    }

    /** In open space the follower drives straight ahead at 0.2 m/s. */
    @Test
    void trial_measuresTheWay_andEndsWhereItsPathEnds() {
        var law = new WallFollower(CornerStyle.FORWARD);
        long seed = new Random(4)
                .longs(0, 1000)
                .filter(each -> FollowerTrial.run(each, 10, law).alongM() == 0)
                .findFirst()
                .orElseThrow();
        var way = new FollowerTrial.Way(new ArrayList<>(), new ArrayList<>());
        FollowerTrial.Result result = FollowerTrial.run(seed, 10, law, way);
        assertThat(result.seconds()).isCloseTo(1, within(1e-9));
        assertThat(result.drivenM()).as("seed %d", seed).isCloseTo(0.2, within(1e-6));
        assertThat(result.touches()).isZero();
        assertThat(result.score()).isZero();
        Point from = way.path().getFirst();
        Point to = way.path().getLast();
        assertThat(way.path()).hasSize(11);
        assertThat(StrictMath.hypot(to.x() - from.x(), to.y() - from.y())).isCloseTo(0.2, within(1e-6));
    }

    @Test
    void score_isMetresAlongWallsInAMinute_ofWhichEachTouchTakesOne() {
        assertThat(new FollowerTrial.Result(120, 30, 20, 4, 1).score()).isEqualTo(8);
    }

    @Test
    void wrongNumbers_areRefused() {
        assertRefused("learn tune --candidates 1", "--candidates is 1, expected a number from 2 to 100000");
        assertRefused("learn corners --arenas 0", "--arenas is 0, expected a number from 1 to 100000");
        assertRefused("learn serve --worlds 0", "--worlds is 0, expected a number from 1 to 10000");
        assertRefused("learn serve --side 1", "a random arena is 1.0 m by 1.0 m, expected from 2 m to 900 m");
        assertRefused("learn dance", "there is no command 'dance'");
    }
}
