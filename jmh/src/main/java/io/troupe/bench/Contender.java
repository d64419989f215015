package io.troupe.bench;

/**
 * One way to run actors, under the workloads of {@link Workload}. The actor is a counter.
 *
 * <p><b>Role.</b> Each loop is inside the contender, written as its users would, so the harness adds no call per
 * message. A method returns when the last of its messages has been handled.
 *
 * <p><b>Threads.</b> Called by one thread outside the actors.
 *
 * <p><b>Errors.</b> Whatever the contender throws; it ends the process of this contender.
 */
interface Contender extends AutoCloseable {
    /** Outside threads send so many numbers to one actor, which adds them up. */
    void tell(int messages, Senders senders) throws Exception;

    /** One more actor with ten message types of its own; see {@link FamilyLoader}. */
    Family newFamily(Tally tally) throws Exception;

    /** Two actors on one thread pass one message to and fro. */
    void pingPong(int hops) throws Exception;

    /** The outside thread asks one actor again and again without waiting; every answer runs a callback. */
    void askPipelined(int asks) throws Exception;

    /** One actor asks another on the same thread, and asks again in the callback of the answer. */
    void askChain(int asks) throws Exception;

    /** The outside thread asks, and waits for the answer, so many times. */
    void askOnce(int asks) throws Exception;

    /** So many new actors handle their first message. */
    void create(int actors) throws Exception;

    /** Lets go of what {@link #create} made; not timed. */
    default void clear() throws Exception {}

    /** The contender's turn begins. */
    default void wake() {}

    /** The contender's turn is over: until {@link #wake} its threads use no processor. */
    default void rest() {}

    /** Lets its threads end, as far as the contender can, and does not wait for them. */
    @Override
    void close();
}
