package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class RepeatWhileTest {
    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void repeatWhile_sharesTheThreadBetweenRounds() {
        var log = new ArrayList<String>();
        test.run(() -> {
            var left = new int[] {3};
            test.space().repeatWhile(() -> left[0] > 0, () -> {
                log.add("a" + left[0]--);
            });
            var right = new int[] {2};
            test.space().repeatWhile(() -> right[0] > 0, () -> {
                log.add("b" + right[0]--);
            });
        });
        assertThat(log).containsExactly("a3", "b2", "a2", "b1", "a1");
    }

    @Test
    void repeatWhile_waitsForThePromiseOfItsBody() {
        var steps = new ArrayList<Deferred<String>>();
        var end = new ArrayList<String>();
        test.run(() -> test.space()
                .repeatWhile(() -> steps.size() < 2, () -> {
                    var step = new Deferred<String>();
                    steps.add(step);
                    return step;
                })
                .thenRun(() -> end.add("over")));
        assertThat(steps).hasSize(1);
        steps.getFirst().resolve("first");
        test.crank();
        assertThat(steps).hasSize(2);
        assertThat(end).isEmpty();
        steps.getLast().resolve("second");
        test.crank();
        assertThat(end).containsExactly("over");
    }

    @Test
    void repeatWhile_thatThrows_rejectsItsPromise() {
        var errors = new ArrayList<String>();
        test.run(() -> test.space()
                .repeatWhile(() -> true, () -> {
                    throw new IllegalStateException("third time unlucky");
                })
                .exceptionally(error -> {
                    errors.add(error.getMessage());
                    return null;
                }));
        assertThat(errors).containsExactly("third time unlucky");
    }
}
