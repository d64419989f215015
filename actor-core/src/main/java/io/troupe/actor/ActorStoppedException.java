package io.troupe.actor;

import org.jspecify.annotations.Nullable;

/**
 * The error of a request whose actor stopped, or whose space was closed, before it was answered; also of a request that
 * had begun when its actor was restarted.
 *
 * {@snippet :
 * Promise<String> answer = greeter.greet("Ada")
 *         .exceptionally(error -> error instanceof ActorStoppedException ? "gone" : "failed");
 * }
 *
 * <p>The cause is the exception that made the actor stop or restart, if there was one.
 */
public final class ActorStoppedException extends ActorException implements Unanswered {
    private static final long serialVersionUID = 1L;

    private final boolean begun;

    ActorStoppedException(String message) {
        this(message, null, false);
    }

    ActorStoppedException(String message, @Nullable Throwable cause, boolean begun) {
        super(message, cause);
        this.begun = begun;
    }

    /** For all requests of one kind: without a stack trace, a cause and suppressed exceptions. */
    private ActorStoppedException(String message, boolean begun) {
        super(message, null, false, false);
        this.begun = begun;
    }

    /** The shared error of requests, for which there is no memory to make separate ones. */
    static ActorStoppedException withoutMemory(boolean begun) {
        return begun ? WithoutMemory.BEGUN : WithoutMemory.NOT_BEGUN;
    }

    private static final class WithoutMemory {
        static final ActorStoppedException BEGUN = new ActorStoppedException(
                "a request was begun and not answered, and there is no memory for more words", true);
        static final ActorStoppedException NOT_BEGUN =
                new ActorStoppedException("a request was not begun, and there is no memory for more words", false);
    }

    /** True if the actor had begun the request. */
    @Override
    public boolean mayHaveRun() {
        return begun;
    }
}
