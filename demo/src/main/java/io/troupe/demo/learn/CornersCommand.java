package io.troupe.demo.learn;

import io.troupe.demo.learn.CornersFigure.Pair;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import java.io.IOException;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.function.Function;
import java.util.function.ToDoubleFunction;
import java.util.stream.IntStream;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

/** {@code troupe learn corners}: compares both readings of the paper's tables at a corner. */
@Command(
        name = "corners",
        description = "Compares the wall follower that drives forward while it turns at a corner (the paper), with the"
                + " one that drives backward (its model); each random arena is driven through by both. Writes corners.csv and"
                + " corners.svg.",
        footer = "  troupe learn corners",
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
final class CornersCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Mixin
    private final TrialOptions options = new TrialOptions(1_000, 100_000, 120);

    @Override
    public Integer call() throws IOException {
        options.check();
        int arenas = options.arenas();
        long seed = options.seed();
        PrintWriter terminal = spec.commandLine().getOut();
        int steps = options.steps();
        try (var runner = new TrialRunner(2 * arenas, steps)) {
            List<FollowerTrial.Result> trials = runner.run(
                    "comparing",
                    2 * arenas,
                    index -> FollowerTrial.run(
                            seed + index / 2, steps, new WallFollower(CornerStyle.values()[index % 2])));
            List<Pair> pairs = IntStream.range(0, arenas)
                    .mapToObj(i -> new Pair(seed + i, trials.get(2 * i), trials.get(2 * i + 1)))
                    .toList();
            terminal.print(table(pairs));
            terminal.println(runner.summary());
            terminal.flush(); // before writing files, which may fail
            OutputFiles.write(options.file("corners.csv"), csv(pairs));
            OutputFiles.write(options.file("corners.svg"), CornersFigure.draw(pairs, steps));
            terminal.println("wrote " + options.file("corners.csv") + " and corners.svg");
            terminal.flush();
            return 0;
        } catch (InterruptedCommand interrupted) {
            terminal.println("interrupted; no files were written");
            terminal.flush();
            return Interruption.STATUS;
        }
    }

    private static String table(List<Pair> pairs) {
        var text = new StringBuilder(String.format("%-28s %10s %10s%n", "mean of the arenas", "forward", "backward"));
        text.append(row("touches a minute", pairs, trial -> trial.touches() * 60 / trial.seconds()));
        text.append(row("held back, s a minute", pairs, trial -> trial.heldS() * 60 / trial.seconds()));
        text.append(row("driven, m a minute", pairs, trial -> trial.drivenM() * 60 / trial.seconds()));
        text.append(row("along walls, m a minute", pairs, trial -> trial.alongM() * 60 / trial.seconds()));
        text.append(row("arenas without a touch, %", pairs, trial -> trial.touches() == 0 ? 100 : 0));
        long forward = pairs.stream()
                .filter(pair -> pair.forward().touches() < pair.backward().touches())
                .count();
        long backward = pairs.stream()
                .filter(pair -> pair.forward().touches() > pair.backward().touches())
                .count();
        return text.append(String.format(
                        Locale.ROOT,
                        "fewer touches: forward in %,d arenas, backward in %,d, as many in %,d%n",
                        forward,
                        backward,
                        pairs.size() - forward - backward))
                .toString();
    }

    private static String row(String what, List<Pair> pairs, ToDoubleFunction<FollowerTrial.Result> number) {
        return String.format(
                Locale.ROOT,
                "%-28s %10.2f %10.2f%n",
                what,
                mean(pairs, Pair::forward, number),
                mean(pairs, Pair::backward, number));
    }

    private static double mean(
            List<Pair> pairs,
            Function<Pair, FollowerTrial.Result> side,
            ToDoubleFunction<FollowerTrial.Result> number) {
        return pairs.stream().map(side).mapToDouble(number).average().orElse(0);
    }

    private static String csv(List<Pair> pairs) {
        var text = new StringBuilder("seed,corner,seconds,driven_m,along_m,touches,held_s\n");
        for (Pair pair : pairs) {
            text.append(line(pair.seed(), "forward", pair.forward()));
            text.append(line(pair.seed(), "backward", pair.backward()));
        }
        return text.toString();
    }

    private static String line(long seed, String corner, FollowerTrial.Result trial) {
        return String.format(
                Locale.ROOT,
                "%d,%s,%.1f,%.4f,%.4f,%d,%.1f%n",
                seed,
                corner,
                trial.seconds(),
                trial.drivenM(),
                trial.alongM(),
                trial.touches(),
                trial.heldS());
    }
}
