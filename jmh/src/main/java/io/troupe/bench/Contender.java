package io.troupe.bench;

/**
 * One way to run actors, under the workloads of {@link Workload}. The actor is a counter.
 *
 * <p><b>Role.</b> Each loop is inside the contender, as its users would write it, so the harness adds no call per
 * message. A method returns when the last of its messages has been handled.
 *
 * <p><b>Threads.</b> Called by one thread outside the actors.
 *
 * <p><b>Errors.</b> Any exception ends the process of this contender.
 */
interface Contender extends AutoCloseable {
    /** Outside threads send {@code messages} numbers to one actor, which adds them up. */
    void tell(int messages, Senders senders) throws Exception;

    /** Creates one more actor with ten message types, loaded again for it; see {@link Families#copy}. */
    Family newFamily(Tally tally) throws Exception;

    /** Two actors on one thread pass one message to and fro. */
    void pingPong(int hops) throws Exception;

    /** The outside thread asks one actor repeatedly without waiting; every answer runs a callback. */
    void askPipelined(int asks) throws Exception;

    /** One actor asks another on the same thread, and asks again in the callback of the answer. */
    void askChain(int asks) throws Exception;

    /** The outside thread asks, and waits for the answer, {@code asks} times. */
    void askOnce(int asks) throws Exception;

    /** {@code actors} new actors handle their first message. */
    void create(int actors) throws Exception;

    /** Drops the actors that {@link #create} made; not timed. */
    default void clear() throws Exception {}

    /** Called when the contender's turn begins. */
    default void wake() {}

    /** Called when the contender's turn is over: until {@link #wake} its threads use no processor. */
    default void rest() {}

    /** Lets its threads end, as far as the contender can, without waiting for them. */
    @Override
    void close();

    /** The threads that send the messages of {@link #tell}. */
    interface Senders {
        /** The calling thread alone. */
        Senders ONE = (messages, loop) -> loop.send(messages);

        /** Returns when all messages are sent, though not yet handled. */
        void send(int messages, Loop loop) throws Exception;

        /** The contender's loop that sends {@code messages} messages; several threads may run it at once. */
        interface Loop {
            void send(int messages);
        }
    }
}
