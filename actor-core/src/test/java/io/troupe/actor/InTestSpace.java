package io.troupe.actor;

import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;

/** Tests in a test space; its {@code close()} fails a test that forgot an error or a message. */
public abstract class InTestSpace {
    protected final TestSpace test = new TestSpace();
    protected final List<String> log = new ArrayList<>();

    @AfterEach
    protected final void nothingIsLeft() {
        test.close();
    }

    protected final void stop(Object actor) {
        test.space().stop(actor);
        test.runQueued();
    }

    /** The values of promises, after running everything that is queued. */
    protected final List<@Nullable Object> values(Promise<?>... promises) {
        return Stream.of(promises).<@Nullable Object>map(test::get).toList();
    }

    /** The texts of the errors that were reported since the last call. */
    protected final List<@Nullable String> takeErrors() {
        return test.takeProblems().stream()
                .<@Nullable String>map(problem -> problem.error().getMessage())
                .toList();
    }
}
