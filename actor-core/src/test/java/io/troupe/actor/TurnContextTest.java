package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSettings.Overflow;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.TimeoutException;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The context of a caller, in the turns that its calls and listeners cause. */
class TurnContextTest {
    private static final Duration LONG = Duration.ofSeconds(30);

    private static final ThreadLocal<@Nullable String> USER = new ThreadLocal<>();

    private final List<String> log = Collections.synchronizedList(new ArrayList<>());
    private final List<String> errors = Collections.synchronizedList(new ArrayList<>());

    private static final class User implements TurnContext<String> {
        @Override
        public @Nullable String capture() {
            String user = USER.get();
            if ("broken".equals(user)) {
                throw new IllegalStateException("no capture");
            }
            return user;
        }

        @Override
        public Runnable restore(String captured) {
            if (captured.equals("lost")) {
                throw new IllegalStateException("no restore");
            }
            USER.set(captured);
            return USER::remove;
        }

        @Override
        public String toString() {
            return "the user";
        }
    }

    private SpaceSettings settings() {
        return SpaceSettings.named("carrying")
                .withOnError((where, error) -> errors.add(where + ": " + error.getMessage()))
                .withContext(new User());
    }

    private final ActorSpace space = ActorSpace.create(settings());

    @AfterEach
    void close() {
        USER.remove();
        space.close();
    }

    interface Door {
        void open();

        Promise<String> ask();

        Promise<String> askNext(Door other);
    }

    private final class PlainDoor implements Door {
        @Override
        public void open() {
            log.add("open by " + USER.get());
        }

        @Override
        public Promise<String> ask() {
            return Promise.of("asked by " + USER.get());
        }

        @Override
        public Promise<String> askNext(Door other) {
            return other.ask().thenApply(answer -> answer + ", heard by " + USER.get());
        }
    }

    private Door door() {
        return space.spawn(Door.class, PlainDoor::new);
    }

    private static <T> T as(@Nullable String user, Asking<T> asking) throws Exception {
        USER.set(user);
        try {
            return asking.ask();
        } finally {
            USER.remove();
        }
    }

    private interface Asking<T> {
        T ask() throws TimeoutException, InterruptedException;
    }

    @Test
    void contextOfACaller_isThatOfTheTurn_andOfWhatItCausesThere_andEndsWithTheTurn() throws Exception {
        Door door = door();
        Door other = door();
        assertThat(as("ann", () -> door.askNext(other).get(LONG))).isEqualTo("asked by ann, heard by ann");
        assertThat(door.askNext(other).get(LONG)).isEqualTo("asked by null, heard by null");
    }

    @Test
    void everyCallAndListener_hasTheContextOfItsOwnCaller_inOrder() throws Exception {
        Door door = door();
        as("ann", () -> {
            door.open();
            return null;
        });
        as("bob", () -> {
            door.open();
            return null;
        });
        door.open();
        var answer = door.ask();
        var listeners = as(
                "cid",
                () -> List.of(
                        answer.then(value -> {
                            log.add("then " + USER.get());
                        }),
                        answer.thenApply(value -> USER.get()),
                        answer.handle((value, error) -> USER.get()),
                        answer.whenComplete((value, error) -> log.add("complete " + USER.get())),
                        answer.thenCompose(value -> Promise.of(USER.get())),
                        answer.<String>thenApply(value -> {
                                    throw new IllegalStateException("no");
                                })
                                .exceptionallyCompose(error -> Promise.of("rescued for " + USER.get()))));
        assertThat(Promise.all(listeners).get(LONG))
                .containsExactly("asked by null", "cid", "cid", "asked by null", "cid", "rescued for cid");
        assertThat(log).containsExactly("open by ann", "open by bob", "open by null", "then cid", "complete cid");
    }

    @Test
    void boundedMailbox_keepsTheContextWithItsCall_andDropsBoth() {
        var threadless =
                ActorSpace.create(settings().withoutThread().withOnDeadLetter(letter -> log.add("dead " + letter)));
        Door door = threadless.spawn(
                Door.class, PlainDoor::new, ActorSettings.defaults().withMailbox(2, Overflow.DROP_OLDEST));
        for (String user : List.of("ann", "bob", "cid")) {
            USER.set(user);
            door.open();
        }
        USER.remove();
        threadless.runQueued();
        assertThat(log).hasSize(3);
        assertThat(log.getFirst()).startsWith("dead ").contains("Door.open()");
        assertThat(log.subList(1, 3)).containsExactly("open by bob", "open by cid");
        threadless.close();
    }

    @Test
    void stoppedActorAndClosedSpace_rejectCarriedCalls_byTheirNames() {
        var threadless =
                ActorSpace.create(settings().withoutThread().withOnDeadLetter(letter -> log.add(letter.message())));
        Door door = threadless.spawn(Door.class, PlainDoor::new);
        Door stopped = threadless.spawn(Door.class, PlainDoor::new);
        threadless.stop(stopped);
        USER.set("ann");
        stopped.open();
        threadless.runQueued();
        assertThat(log).containsExactly("Door.open()");
        Promise<String> late = door.ask();
        late.exceptionally(error -> "");
        threadless.close();
        assertThat(late.isDone()).isTrue();
    }

    @Test
    void hookThatThrows_isReported_andTheTurnRunsWithoutContext() throws Exception {
        Door door = door();
        assertThat(as("broken", door::ask).get(LONG)).isEqualTo("asked by null");
        assertThat(as("lost", door::ask).get(LONG)).isEqualTo("asked by null");
        assertThat(errors).containsExactly("capture of the user: no capture", "restore of the user: no restore");
    }

    @Test
    void timeLimit_behindCarriedCalls_saysHowManyComeFirst() {
        var threadless = ActorSpace.create(settings().withoutThread());
        Door door = threadless.spawn(Door.class, PlainDoor::new);
        USER.set("ann");
        threadless.execute(() -> {
            for (int before = 0; before < 600; before++) {
                door.open();
            }
            door.ask().orTimeout(Duration.ZERO).exceptionally(late -> log.add(late.getMessage()) ? "" : "");
        });
        threadless.runQueued();
        assertThat(log)
                .filteredOn(line -> line.startsWith("no answer"))
                .singleElement()
                .asString()
                .contains("which has not begun it: ");
        threadless.close();
    }
}
