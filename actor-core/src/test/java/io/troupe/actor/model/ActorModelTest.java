package io.troupe.actor.model;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assertions.assertTimeoutPreemptively;

import io.troupe.actor.model.Act.Kind;
import java.time.Duration;
import java.util.List;
import java.util.Random;
import java.util.TreeSet;
import java.util.function.Predicate;
import java.util.stream.LongStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/**
 * Runs random programs on the library and on a simple model of it: their visible events must be equal, in the same
 * order.
 *
 * <p>{@code -Dmodel.seed=17} runs the program of that seed, {@code -Dmodel.programs=100000} runs that many.
 */
class ActorModelTest {
    private static final int PROGRAMS = System.getProperty("thorough") == null ? 1_000 : 10_000;

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
        if (difference(program) != null) {
            var smallest = shrink(program, candidate -> difference(candidate) != null);
            String sizes =
                    "seed %d, %d acts, shrunken to %d:%n".formatted(number, Act.count(program), Act.count(smallest));
            throw new AssertionError(sizes + Act.print(smallest, "  ") + difference(smallest));
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
                        "promise  !TimeoutException",
                        "unheard TimeoutException",
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
        Predicate<Act> wanted = each -> each.kind() == Kind.SPAWN && each.target() == 2;
        assertThat(shrink(program, candidate -> candidate.stream().anyMatch(wanted)))
                .singleElement()
                .matches(wanted)
                .returns(List.of(), Act::script);
    }

    /** The first difference, or null if all events are equal. */
    private static @Nullable String difference(List<Act> program) {
        var expected = ModelRun.of(program).events();
        var shown = LibraryRun.of(program).events();
        if (expected.equals(shown)) {
            return null;
        }
        int same = firstDifference(expected, shown);
        var before = String.join("\n  ", expected.subList(Math.max(0, same - 12), same));
        return "after %d equal events, the last of which are%n  %s%nthe model expects%n  %s%nand the library shows%n  %s"
                .formatted(same, before, at(expected, same), at(shown, same));
    }

    private static int firstDifference(List<String> one, List<String> other) {
        int at = 0;
        while (at < one.size() && at < other.size() && one.get(at).equals(other.get(at))) {
            at++;
        }
        return at;
    }

    private static String at(List<String> events, int index) {
        return index < events.size() ? events.get(index) : "nothing more";
    }

    /** Reduces a failing program by removing parts while it still fails: first halves, finally single acts. */
    private static List<Act> shrink(List<Act> program, Predicate<List<Act>> fails) {
        var smallest = program;
        int part = Math.max(1, Act.count(program) / 2);
        while (true) {
            var smaller = withoutParts(smallest, part, fails);
            boolean progress = Act.count(smaller) < Act.count(smallest);
            smallest = smaller;
            if (part == 1 && !progress) {
                return smallest;
            }
            part = progress ? part : Math.max(1, part / 2);
        }
    }

    private static List<Act> withoutParts(List<Act> program, int part, Predicate<List<Act>> fails) {
        var smallest = program;
        int from = 0;
        while (from < Act.count(smallest)) {
            var candidate = Act.without(smallest, from, from + part);
            if (fails.test(candidate)) {
                smallest = candidate;
            } else {
                from += part;
            }
        }
        return smallest;
    }
}
