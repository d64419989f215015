package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.function.UnaryOperator;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** A quota for the actors of a space: one that gets very many calls does not keep the others waiting. */
class ActorQuotaTest {
    private static final int QUOTA = 16;

    private final List<String> log = new ArrayList<>();
    private final List<Throwable> errors = new ArrayList<>();
    private final ActorSpace space = space(QUOTA);

    private ActorSpace space(int quota) {
        return space(settings -> settings.withActorQuota(quota));
    }

    private ActorSpace space(UnaryOperator<SpaceSettings> change) {
        return ActorSpace.create(change.apply(SpaceSettings.named("fair")
                .withoutThread()
                .withOnError((where, error) -> errors.add(error))
                .withOnDeadLetter(letter -> log.add("dead " + letter.arguments()))));
    }

    interface Noter {
        void note(int number);

        Promise<Integer> ask(int number);
    }

    private final class PlainNoter implements Noter {
        private final String name;

        PlainNoter(String name) {
            this.name = name;
        }

        @Override
        public void note(int number) {
            log.add(name + number);
            if (number < 0) {
                throw new IllegalArgumentException("negative");
            }
        }

        @Override
        public Promise<Integer> ask(int number) {
            note(number);
            return Promise.of(number);
        }
    }

    private Noter actor(String name, ActorSettings settings) {
        return space.spawn(Noter.class, () -> new PlainNoter(name), settings);
    }

    private Noter actor(String name) {
        return actor(name, ActorSettings.named(name));
    }

    private List<String> notesOf(String name) {
        return log.stream().filter(line -> line.startsWith(name)).toList();
    }

    private static List<String> notes(String name, int count) {
        return IntStream.range(0, count).mapToObj(number -> name + number).toList();
    }

    @Test
    void callsFromOutside_ofOneActor_letThoseOfOthersFirst_afterItsQuota() {
        var hot = actor("hot");
        var idle = actor("idle");
        IntStream.range(0, 500).forEach(hot::note);
        idle.note(0);
        space.runQueued();
        assertThat(log.indexOf("idle0")).isEqualTo(QUOTA);
        assertThat(notesOf("hot")).isEqualTo(notes("hot", 500));
    }

    @Test
    void callsFromInside_ofOneActor_letThoseOfOthersFirst_afterItsQuota() {
        var hot = actor("hot");
        var idle = actor("idle");
        space.execute(() -> {
            IntStream.range(0, 500).forEach(hot::note);
            idle.ask(0).then(number -> idle.note(1));
        });
        space.runQueued();
        assertThat(log.indexOf("idle0")).isEqualTo(QUOTA);
        assertThat(log.indexOf("idle1")).isBetween(QUOTA + 1, 3 * QUOTA + 1);
        assertThat(notesOf("hot")).isEqualTo(notes("hot", 500));
    }

    @Test
    void twoBusyActors_takeTurns() {
        var first = actor("a");
        var second = actor("b");
        IntStream.range(0, 64).forEach(first::note);
        IntStream.range(0, 64).forEach(second::note);
        space.runQueued();
        assertThat(log.subList(0, 4 * QUOTA))
                .filteredOn(line -> line.startsWith("b"))
                .hasSize(2 * QUOTA);
        assertThat(notesOf("a")).isEqualTo(notes("a", 64));
        assertThat(notesOf("b")).isEqualTo(notes("b", 64));
    }

    @Test
    void withoutQuota_callsRunInTheOrderOfArrival() {
        var plain = space(settings -> settings.withActorQuota(3).withoutActorQuota());
        Noter hot = plain.spawn(Noter.class, () -> new PlainNoter("hot"));
        Noter idle = plain.spawn(Noter.class, () -> new PlainNoter("idle"));
        IntStream.range(0, 500).forEach(hot::note);
        idle.note(0);
        plain.runQueued();
        assertThat(log.indexOf("idle0")).isEqualTo(500);
    }

    @Test
    void stop_comesBehindTheCallsThatWait() {
        var hot = actor("hot");
        IntStream.range(0, 100).forEach(hot::note);
        space.stop(hot);
        hot.note(100);
        space.runQueued();
        assertThat(log)
                .isEqualTo(IntStream.rangeClosed(0, 100)
                        .mapToObj(number -> number < 100 ? "hot" + number : "dead [100]")
                        .toList());
    }

    @Test
    void restart_keepsTheOrderOfTheCallsThatWait() {
        var hot = actor(
                "hot", ActorSettings.named("hot").withSupervision(Supervision.restart(10, Duration.ofMinutes(1))));
        IntStream.range(0, 100).forEach(number -> hot.note(number == 20 || number == 40 ? -number : number));
        space.runQueued();
        assertThat(log)
                .isEqualTo(IntStream.range(0, 100)
                        .mapToObj(number -> "hot" + (number == 20 || number == 40 ? -number : number))
                        .toList());
        assertThat(errors).hasSize(2);
    }

    @Test
    void close_rejectsTheCallsThatWait() {
        var hot = actor("hot");
        var closer = actor("closer");
        List<Promise<Integer>> asked = new ArrayList<>();
        space.execute(() -> {
            IntStream.range(0, 100).forEach(number -> asked.add(hot.ask(number)));
            closer.note(0);
            asked.getLast().exceptionally(error -> 0);
            space.execute(space::close);
        });
        space.runQueued();
        assertThat(asked).allMatch(Promise::isDone);
        assertThat(asked.stream().filter(Promise::isRejected)).hasSize(100 - QUOTA);
    }

    @Test
    void boundedMailbox_dropsTheOldestAndKeepsTheOrder() {
        var hot = actor("hot", ActorSettings.named("hot").withMailbox(40, Overflow.DROP_OLDEST));
        IntStream.range(0, 100).forEach(hot::note);
        space.runQueued();
        assertThat(notesOf("hot")).isEqualTo(notes("hot", 100).subList(60, 100));
    }

    @Test
    void quotaBelowOne_isRejected() {
        assertThatThrownBy(() -> SpaceSettings.named("x").withActorQuota(0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("actorQuota is 0, expected 1 or more, or withoutActorQuota()");
    }

    /** Random calls from outside and inside, in several rounds: nothing is lost, and every sender's order is kept. */
    @ParameterizedTest(name = "seed {0}")
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void randomCalls_areAllHandled_inTheirSendersOrder(long seed) {
        var random = new Random(seed);
        var fair = space(1 + random.nextInt(5));
        Map<String, Noter> actors = new HashMap<>();
        for (String name : List.of("a", "b", "c")) {
            actors.put(name, fair.spawn(Noter.class, () -> new PlainNoter(name)));
        }
        Map<String, List<String>> expected =
                new HashMap<>(Map.of("a", new ArrayList<>(), "b", new ArrayList<>(), "c", new ArrayList<>()));
        int[] next = new int[1];
        for (int round = 0; round < 20; round++) {
            boolean inside = random.nextBoolean();
            Runnable calls = () -> {
                for (int call = random.nextInt(60); call > 0; call--) {
                    String name = "abc".substring(random.nextInt(3)).substring(0, 1);
                    int number = next[0]++;
                    expected.get(name).add(name + number);
                    if (random.nextBoolean()) {
                        actors.get(name).note(number);
                    } else {
                        actors.get(name).ask(number);
                    }
                }
            };
            if (inside) {
                fair.execute(calls);
            } else {
                calls.run();
            }
            fair.runQueued();
        }
        expected.forEach((name, notes) -> assertThat(notesOf(name)).isEqualTo(notes));
    }
}
