package io.troupe.petri.wiring;

import java.util.List;
import java.util.stream.Collectors;

/** What a component waits for when it cannot go on. */
public sealed interface Wait {
    /** Who waits. */
    String component();

    /** Whom it waits for; one of them would be enough, except for a stop. */
    List<String> on();

    /** For the answer to a call that it made. */
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
     * For somebody to call what it offers.
     *
     * @param state where it stands
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

    /** For the others, to stop together with them. */
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
     * A call, and who might make it.
     *
     * @param callers those that can get to the call without another answer of the component that offers it, such as the
     *     one that holds it; if there are none, all that make the call
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
