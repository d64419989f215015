package io.troupe.actor.model;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assertions.assertTimeoutPreemptively;

import io.troupe.actor.model.Act.Kind;
import java.time.Duration;
import java.util.Random;
import java.util.TreeSet;
import java.util.stream.LongStream;
import org.junit.jupiter.api.Test;

/**
 * Runs random programs on the library and on a simple model of it: their visible events must be equal, in the same
 * order.
 *
 * <p>{@code -Dmodel.seed=17} runs the program of that seed, {@code -Dmodel.programs=100000} runs that many.
 */
class ActorModelTest {
    private static final int PROGRAMS = 10_000;

    private volatile long seed;

    @Test
    void randomPrograms_behaveLikeTheModel() {
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
        if (Difference.of(program) != null) {
            var smallest = Shrinker.shrink(program, candidate -> Difference.of(candidate) != null);
            throw new AssertionError("seed %d, %d acts, shrunken to %d:%n%s%s"
                    .formatted(
                            number,
                            Act.count(program),
                            Act.count(smallest),
                            Act.print(smallest, "  "),
                            Difference.of(smallest)));
        }
    }

    @Test
    void randomPrograms_comeToEveryKindOfEvent() {
        var kinds = new TreeSet<String>();
        for (long seed = 0; seed < 1_000; seed++) {
            LibraryRun.of(Programs.random(seed)).events().stream()
                    .map(event -> event.replaceAll("[0-9#]+", ""))
                    .forEach(kinds::add);
        }
        assertThat(kinds)
                .contains(
                        "dead letter  to A: full",
                        "dead letter  to A: stopped",
                        "dead letter  to A: closed",
                        "dead letter a task to space: closed",
                        "own handler: failed A Boom",
                        "stream  of nobody hears !MailboxFullException",
                        "stream  of A hears !ActorStoppedException",
                        "stream  of A ends CancellationException",
                        "listener  of A hears !CancellationException",
                        "promise  !IllegalStateException",
                        "promise  pending",
                        "too late: ",
                        "unheard Boom",
                        "unheard ActorStoppedException");
    }

    @Test
    void shrinker_keepsOnlyWhatFails() {
        var program = LongStream.range(0, 100)
                .mapToObj(Programs::random)
                .filter(each -> Act.count(each) > 50)
                .findFirst()
                .orElseThrow();
        var smallest = Shrinker.shrink(
                program,
                candidate -> candidate.stream().anyMatch(each -> each.kind() == Kind.SPAWN && each.target() == 2));
        assertThat(smallest).hasSize(1);
        assertThat(smallest.getFirst().kind()).isEqualTo(Kind.SPAWN);
        assertThat(smallest.getFirst().target()).isEqualTo(2);
        assertThat(smallest.getFirst().script()).isEmpty();
    }
}
