package io.troupe.demo.learn;

import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.behaviour.WallFollower.Gains;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.IntStream;

/**
 * Tunes the wall follower: draws numbers around the paper's at random, drives each through the same random arenas, and
 * compares the best with the paper's in other arenas.
 */
final class RandomSearch {
    /** The numbers of the first candidate, and the middle of all others. */
    static final Gains PAPER = Gains.ofThePaper(CornerStyle.FORWARD);

    /** Seeds of the arenas for the comparison begin here, far from those of the search. */
    private static final long FIRST_CHECK = 1_000_000;

    /**
     * The size of a search.
     *
     * @param candidates the paper's numbers and the random ones
     * @param arenas for each candidate
     * @param checks other arenas, for the paper's numbers and the best
     * @param steps of each trial
     */
    record Settings(int candidates, int arenas, int checks, int steps, long seed) {
        int trials() {
            return candidates * arenas + 2 * checks;
        }

        /** The seed of an arena for the comparison. */
        long checkSeed(int check) {
            return FIRST_CHECK + seed + check;
        }
    }

    /**
     * Numbers, and what they scored.
     *
     * @param score mean of all arenas
     */
    record Candidate(Gains gains, double score) {}

    /**
     * The outcome.
     *
     * @param candidates in the order in which they were drawn
     * @param paperChecks of the paper's numbers, by arena
     * @param bestChecks of the best candidate, in the same arenas
     */
    record Result(
            List<Candidate> candidates,
            Candidate best,
            List<FollowerTrial.Result> paperChecks,
            List<FollowerTrial.Result> bestChecks) {}

    private RandomSearch() {}

    static Result run(Settings settings, TrialRunner runner) {
        var random = new SplittableRandom(settings.seed());
        List<Gains> drawn = new ArrayList<>(List.of(PAPER));
        while (drawn.size() < settings.candidates()) {
            drawn.add(draw(random));
        }
        int arenas = settings.arenas();
        List<FollowerTrial.Result> trials = runner.run("searching", settings.candidates() * arenas, index -> {
            var law = new WallFollower(drawn.get(index / arenas));
            return FollowerTrial.run(settings.seed() + index % arenas, settings.steps(), law);
        });
        List<Candidate> candidates = IntStream.range(0, drawn.size())
                .mapToObj(i -> new Candidate(drawn.get(i), score(trials.subList(i * arenas, (i + 1) * arenas))))
                .toList();
        Candidate best = candidates.stream()
                .reduce((one, other) -> other.score() > one.score() ? other : one)
                .orElseThrow();
        return new Result(candidates, best, check(PAPER, settings, runner), check(best.gains(), settings, runner));
    }

    private static List<FollowerTrial.Result> check(Gains gains, Settings settings, TrialRunner runner) {
        var law = new WallFollower(gains);
        return runner.run(
                "comparing",
                settings.checks(),
                index -> FollowerTrial.run(settings.checkSeed(index), settings.steps(), law));
    }

    /** Mean of all arenas. */
    static double score(List<FollowerTrial.Result> trials) {
        return trials.stream()
                .mapToDouble(FollowerTrial.Result::score)
                .average()
                .orElse(0);
    }

    /** Each number between half and twice the paper's; at a corner, any speed up to 0.2 m/s in both directions. */
    private static Gains draw(SplittableRandom random) {
        return new Gains(
                around(PAPER.maxWallM(), random),
                around(PAPER.minWallM(), random),
                new Velocity(around(PAPER.ahead().forwardMps(), random), 0),
                new Velocity(
                        random.nextDouble(-0.2, 0.2), around(PAPER.atCorner().turnRadps(), random)),
                around(PAPER.awayFromWall(), random),
                around(PAPER.towardsWall(), random));
    }

    private static Velocity around(Velocity paper, SplittableRandom random) {
        return new Velocity(around(paper.forwardMps(), random), around(paper.turnRadps(), random));
    }

    private static double around(double paper, SplittableRandom random) {
        return paper * StrictMath.pow(2, random.nextDouble(-1, 1));
    }
}
