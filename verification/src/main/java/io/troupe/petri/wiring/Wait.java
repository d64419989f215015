package io.troupe.petri.wiring;

import java.util.List;
import java.util.stream.Collectors;

/** What a component waits for when it cannot go on. */
public sealed interface Wait {
    /** The waiting component. */
    String component();

    /** The components that it waits for: any one of them is enough, except for a stop, which needs all. */
    List<String> on();

    /** Waits for the answer to a call that it made. */
    record Answer(String component, String provider, String call) implements Wait {
        @Override
        public List<String> on() {
            return List.of(provider);
        }

        @Override
        public String toString() {
            return component + " waits for " + provider + "." + call;
        }
    }

    /**
     * Waits for a caller of one of its offers.
     *
     * @param state the state it is in
     */
    record Call(String component, String state, List<Offer> offers) implements Wait {
        public Call {
            offers = List.copyOf(offers);
        }

        @Override
        public List<String> on() {
            return offers.stream()
                    .flatMap(offer -> offer.callers().stream())
                    .distinct()
                    .toList();
        }

        @Override
        public String toString() {
            return component + " (" + state + ") waits to be called: "
                    + offers.stream().map(Offer::toString).collect(Collectors.joining(", "));
        }
    }

    /**
     * Waits for a unit of a resource.
     *
     * @param on those that hold a unit
     */
    record Resource(String component, String resource, List<String> on) implements Wait {
        public Resource {
            on = List.copyOf(on);
        }

        @Override
        public String toString() {
            return component + " waits for " + resource + ", which " + String.join(" and ", on)
                    + (on.size() == 1 ? " holds" : " hold");
        }
    }

    /**
     * Waits for a one-way message.
     *
     * @param on those that send it
     * @param mailbox what the mailbox holds instead, oldest first
     */
    record Message(String component, String state, String message, List<String> on, List<String> mailbox)
            implements Wait {
        public Message {
            on = List.copyOf(on);
            mailbox = List.copyOf(mailbox);
        }

        @Override
        public String toString() {
            return component + " (" + state + ") waits for the message " + message
                    + (on.isEmpty() ? "" : " from " + String.join(" or ", on)) + ", its mailbox holds " + mailbox;
        }
    }

    /**
     * Waits for room to send a message, or an item of a stream.
     *
     * @param receiver who has to make room
     * @param what the message, or the call of the stream
     * @param content what the mailbox of the receiver holds, oldest first; of a stream, as many items as it may hold
     */
    record Room(String component, String receiver, String what, List<String> content) implements Wait {
        public Room {
            content = List.copyOf(content);
        }

        @Override
        public List<String> on() {
            return List.of(receiver);
        }

        @Override
        public String toString() {
            return component + " waits for room to send " + what + " to " + receiver + ", which has not taken "
                    + content;
        }
    }

    /** Waits for any one of several things. */
    record AnyOf(String component, String state, List<Wait> ways) implements Wait {
        public AnyOf {
            ways = List.copyOf(ways);
        }

        @Override
        public List<String> on() {
            return ways.stream().flatMap(way -> way.on().stream()).distinct().toList();
        }

        @Override
        public String toString() {
            return ways.stream().map(Wait::toString).collect(Collectors.joining(", or "));
        }
    }

    /** Waits for the others, to stop together with them. */
    record Stop(String component, List<String> on) implements Wait {
        public Stop {
            on = List.copyOf(on);
        }

        @Override
        public String toString() {
            return component + " waits to stop together with " + String.join(", ", on);
        }
    }

    /**
     * A call, and its possible callers.
     *
     * @param callers those that can get to the call without another answer of the component that offers it, such as the
     *     holder of a fork; if there are none, all that make the call
     */
    record Offer(String call, List<String> callers) {
        public Offer {
            callers = List.copyOf(callers);
        }

        @Override
        public String toString() {
            return call + " by " + String.join(" or ", callers);
        }
    }
}
