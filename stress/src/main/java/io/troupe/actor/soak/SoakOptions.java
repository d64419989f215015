package io.troupe.actor.soak;

/**
 * Length and load of a soak test.
 *
 * @param messages the total over both mailboxes and both sinks
 * @param producers the number of sending threads
 * @param window messages of one producer to one sink between two requests
 * @param capacity of the bounded mailbox
 * @param heapBoundMib allowed increase of the heap in use after a collection, since the beginning
 */
record SoakOptions(long messages, int producers, int window, int capacity, int heapBoundMib) {
    static final SoakOptions DEFAULT = new SoakOptions(20_000_000, 4, 5_000, 1_000, 24);

    SoakOptions {
        atLeast("messages", messages, 4L * producers);
        atLeast("producers", producers, 1);
        atLeast("window", window, 1);
        atLeast("capacity", capacity, 1);
        atLeast("heap-bound-mib", heapBoundMib, 1);
    }

    private static void atLeast(String name, long value, long least) {
        if (value < least) {
            throw new IllegalArgumentException("--" + name + " is " + value + ", expected " + least + " or more");
        }
    }
}
