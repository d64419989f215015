package io.troupe.demo.learn;

import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OptionRange;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower.Gains;
import java.io.IOException;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code troupe learn tune}: tunes the wall follower by random search. */
@Command(
        name = "tune",
        description =
                "Tunes the numbers of the wall follower by random search over random arenas, which are the same for each"
                        + " candidate. Writes tuning.csv and tuning.svg.",
        footer = {
            "  troupe learn tune",
            "",
            "A candidate's score: metres along walls in a minute, of which each touch takes one; the mean of all arenas."
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class TuneCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(names = "--candidates", paramLabel = "N", description = "sets of numbers, the paper's among them")
    private int candidates = 300;

    @Option(names = "--checks", paramLabel = "N", description = "other arenas, for the best and the paper's numbers")
    private int checks = 200;

    @Mixin
    private final TrialOptions trials = new TrialOptions(16, 10_000, 60);

    @Override
    public Integer call() throws IOException {
        OptionRange.check(spec, "--candidates", candidates, 2, 100_000);
        OptionRange.check(spec, "--checks", checks, 1, 10_000);
        trials.check();
        PrintWriter terminal = spec.commandLine().getOut();
        var settings = new RandomSearch.Settings(candidates, trials.arenas(), checks, trials.steps(), trials.seed());
        try (var runner = new TrialRunner(settings.trials(), settings.steps())) {
            RandomSearch.Result result = RandomSearch.run(settings, runner);
            terminal.print(table(result));
            terminal.println(runner.summary());
            terminal.flush(); // before writing files, which may fail
            OutputFiles.write(trials.file("tuning.csv"), csv(result));
            OutputFiles.write(trials.file("tuning.svg"), TuningFigure.draw(result, settings));
            terminal.println("wrote " + trials.file("tuning.csv") + " and tuning.svg");
            terminal.flush();
            return 0;
        } catch (InterruptedCommand interrupted) {
            terminal.println("interrupted; no files were written");
            terminal.flush();
            return Interruption.STATUS;
        }
    }

    private static String table(RandomSearch.Result result) {
        var text = new StringBuilder(row("", "paper", "best"));
        Gains paper = RandomSearch.PAPER;
        Gains best = result.best().gains();
        text.append(row("turn if the wall is farther than, m", number(paper.maxWallM()), number(best.maxWallM())));
        text.append(row("steer away if it is nearer than, m", number(paper.minWallM()), number(best.minWallM())));
        text.append(row("ahead, m/s and rad/s", words(paper.ahead()), words(best.ahead())));
        text.append(row("at a corner", words(paper.atCorner()), words(best.atCorner())));
        text.append(row("away from the wall", words(paper.awayFromWall()), words(best.awayFromWall())));
        text.append(row("towards the wall", words(paper.towardsWall()), words(best.towardsWall())));
        text.append(row(
                "score in the arenas of the search",
                number(result.candidates().getFirst().score()),
                number(result.best().score())));
        text.append(row(
                "score in other arenas",
                number(RandomSearch.score(result.paperChecks())),
                number(RandomSearch.score(result.bestChecks()))));
        text.append(row(
                "touches a minute there",
                number(touchesPerMinute(result.paperChecks())),
                number(touchesPerMinute(result.bestChecks()))));
        return text.toString();
    }

    static double touchesPerMinute(List<FollowerTrial.Result> trials) {
        return trials.stream()
                .mapToDouble(trial -> trial.touches() * 60 / trial.seconds())
                .average()
                .orElse(0);
    }

    private static String row(String what, String paper, String best) {
        return String.format(Locale.ROOT, "%-36s %16s %16s%n", what, paper, best);
    }

    private static String number(double value) {
        return String.format(Locale.ROOT, "%.2f", value);
    }

    private static String words(Velocity velocity) {
        return number(velocity.forwardMps()) + ", " + number(velocity.turnRadps());
    }

    private static String csv(RandomSearch.Result result) {
        var text =
                new StringBuilder("score,max_wall_m,min_wall_m,ahead_mps,corner_mps,corner_radps,away_mps,away_radps,"
                        + "towards_mps,towards_radps\n");
        for (RandomSearch.Candidate each : result.candidates()) {
            Gains gains = each.gains();
            text.append(each.score()).append(',').append(gains.maxWallM());
            text.append(',')
                    .append(gains.minWallM())
                    .append(',')
                    .append(gains.ahead().forwardMps());
            for (Velocity velocity : List.of(gains.atCorner(), gains.awayFromWall(), gains.towardsWall())) {
                text.append(',').append(velocity.forwardMps()).append(',').append(velocity.turnRadps());
            }
            text.append('\n');
        }
        return text.toString();
    }
}
