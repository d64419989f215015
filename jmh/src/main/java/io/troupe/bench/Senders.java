package io.troupe.bench;

/** Who sends the messages of {@link Contender#tell}. */
interface Senders {
    /** The calling thread alone. */
    Senders ONE = (messages, loop) -> loop.send(messages);

    /** Returns when all are sent, though not yet handled. */
    void send(int messages, Loop loop) throws Exception;

    /** The contender's own loop that sends so many messages; several threads may run it at once. */
    interface Loop {
        void send(int messages);
    }
}
