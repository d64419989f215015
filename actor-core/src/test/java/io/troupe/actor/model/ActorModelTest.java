package io.troupe.actor.model;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assertions.assertTimeoutPreemptively;

import io.troupe.actor.model.Act.Kind;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Random;
import org.junit.jupiter.api.Test;

/**
 * Random programs on the library and on a simple model of it: what can be seen of them must be the same, in the same order.
 *
 * <p>{@code -Dmodel.seed=17} runs the program of that seed, {@code -Dmodel.programs=100000} so many, and {@code -Dmodel.expect=full} compares
 * more: see {@link Expectation}.
 */
class ActorModelTest {
    private static final int PROGRAMS = 10_000;

    private final Expectation expectation =
            Expectation.valueOf(System.getProperty("model.expect", "agreed").toUpperCase(Locale.ROOT));

    private volatile long seed;

    @Test
    void randomPrograms_showWhatTheModelSays() {
        Long given = Long.getLong("model.seed");
        long first = given != null ? given : new Random().nextInt(Integer.MAX_VALUE);
        int programs = given != null ? 1 : Integer.getInteger("model.programs", PROGRAMS);
        var patience = Duration.ofSeconds(120 + programs / 100);
        assertTimeoutPreemptively(
                patience,
                () -> {
                    for (seed = first; seed < first + programs; seed++) {
                        check(seed);
                    }
                },
                () -> "the program of seed " + seed + " does not end");
    }

    private void check(long number) {
        var program = Programs.random(number);
        if (expectation.difference(program) != null) {
            var smallest = Shrinker.shrink(program, candidate -> expectation.difference(candidate) != null);
            throw new AssertionError("seed %d, %d acts, shrunken to %d:%n%s%s"
                    .formatted(
                            number,
                            Act.count(program),
                            Act.count(smallest),
                            Act.print(smallest, "  "),
                            expectation.difference(smallest)));
        }
    }

    @Test
    void most_ofWhatProgramsShow_isCompared() {
        long compared = 0;
        long all = 0;
        for (long seed = 0; seed < 300; seed++) {
            int[] coverage = expectation.coverage(Programs.random(seed));
            compared += coverage[0];
            all += coverage[1];
        }
        assertThat(compared).as("events compared, of " + all).isGreaterThan(all / 2);
    }

    @Test
    void shrinker_keepsOnlyWhatFails() {
        var program = Programs.random(1);
        var smallest = Shrinker.shrink(program, candidate -> print(candidate).contains("TELL"));
        assertThat(Act.count(program)).isGreaterThan(20);
        assertThat(smallest).hasSize(1);
        assertThat(smallest.getFirst().kind()).isEqualTo(Kind.TELL);
        assertThat(smallest.getFirst().script()).isEmpty();
    }

    private static String print(List<Act> program) {
        return Act.print(program, "");
    }
}
