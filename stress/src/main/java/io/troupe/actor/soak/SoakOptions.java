package io.troupe.actor.soak;

import java.util.List;

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

    /** Parses {@code --name number} pairs. */
    static SoakOptions parse(List<String> arguments) {
        var options = DEFAULT;
        for (int at = 0; at < arguments.size(); at += 2) {
            String name = arguments.get(at);
            if (at + 1 == arguments.size()) {
                throw new IllegalArgumentException(name + " has no value, expected a whole number");
            }
            options = options.with(name, arguments.get(at + 1));
        }
        return options;
    }

    private SoakOptions with(String name, String value) {
        long number;
        try {
            number = Long.parseLong(value.replace("_", ""));
        } catch (NumberFormatException notOne) {
            throw new IllegalArgumentException(name + " is " + value + ", expected a whole number", notOne);
        }
        return switch (name) {
            case "--messages" -> new SoakOptions(number, producers, window, capacity, heapBoundMib);
            case "--producers" -> new SoakOptions(messages, Math.toIntExact(number), window, capacity, heapBoundMib);
            case "--window" -> new SoakOptions(messages, producers, Math.toIntExact(number), capacity, heapBoundMib);
            case "--capacity" -> new SoakOptions(messages, producers, window, Math.toIntExact(number), heapBoundMib);
            case "--heap-bound-mib" -> new SoakOptions(messages, producers, window, capacity, Math.toIntExact(number));
            default ->
                throw new IllegalArgumentException("unknown option " + name
                        + ", expected --messages, --producers, --window, --capacity or --heap-bound-mib");
        };
    }
}
