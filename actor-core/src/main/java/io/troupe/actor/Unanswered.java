package io.troupe.actor;

/**
 * An error of a request that got no answer: of an actor ({@link ActorStoppedException}, {@link MailboxFullException}),
 * of a service, or of a handler on a bus. Its method returns whether the request can be repeated.
 *
 * {@snippet :
 * Promise<String> answer = first.greet("Ada")
 *         .exceptionallyCompose(error -> error instanceof Unanswered lost && !lost.mayHaveRun()
 *                 ? second.greet("Ada")
 *                 : Promise.failed(error));
 * }
 */
public interface Unanswered {
    /**
     * False if the request was not begun and will not be: it is safe to repeat it elsewhere. True if part of the work
     * may have been done, or may still be done.
     */
    boolean mayHaveRun();
}
