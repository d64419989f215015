package io.troupe.actor;

/**
 * The error of a request for which the actor's bounded mailbox had no room.
 *
 * {@snippet :
 * Promise<String> answer = greeter.greet("Bob")
 *         .exceptionally(error -> error instanceof MailboxFullException ? "later" : "never");
 * }
 */
public final class MailboxFullException extends ActorException implements Unanswered {
    private static final long serialVersionUID = 1L;

    MailboxFullException(String message) {
        super(message);
    }

    /** False: the request was not even queued, or was taken out of the queue. */
    @Override
    public boolean mayHaveRun() {
        return false;
    }
}
