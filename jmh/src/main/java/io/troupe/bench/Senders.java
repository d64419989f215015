package io.troupe.bench;

/** The threads that send the messages of {@link Contender#tell}. */
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
