package io.troupe.demo.verify;

import static java.util.Map.entry;

import io.troupe.petri.Transition;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

/** Descriptions of the transitions of the paper's nets. */
final class PaperWords {
    private static final Map<String, String> MEANINGS = Map.ofEntries(
            entry("Tr1", "robot starts"),
            entry("Tr2''", "robot asks player for proxies"),
            entry("Trp1''", "player takes the request for proxies"),
            entry("Tp1", "player makes the proxies"),
            entry("Trp2''", "player gives the proxies to robot"),
            entry("Tr3", "robot reads its sensors"),
            entry("Tr4''", "robot asks player to set values"),
            entry("Trp3''", "player takes the values"),
            entry("Tp2", "player sets the values"),
            entry("Trp4''", "player tells robot that the values are set"),
            entry("Tr5", "robot goes on"),
            entry("Tr6", "robot decides to stop"),
            entry("Tr7", "robot stops"),
            entry("Tp3''", "player asks middleware to receive the values"),
            entry("Tpm1''", "middleware takes the request of player"),
            entry("Tm3", "middleware receives the values"),
            entry("Tpm2''", "middleware tells player that it has them"),
            entry("Tp4", "player stops"),
            entry("Ts1''", "service asks middleware to register it"),
            entry("Tms1''", "middleware takes the registration"),
            entry("Tm1", "middleware registers service"),
            entry("Tms2''", "middleware tells service that it is registered"),
            entry("Tm2''", "middleware asks service to receive data"),
            entry("Tm4", "middleware stops"),
            entry("Ts8", "service gets ready for data"),
            entry("Tms3''", "service takes the request of middleware"),
            entry("Ts2", "service receives the data"),
            entry("Tms4''", "service tells middleware that it has them"),
            entry("Ts3", "service chooses the wall follower"),
            entry("Ts4", "service chooses the space wanderer"),
            entry("Ts5", "service follows the wall"),
            entry("Ts6", "service wanders"),
            entry("Ts7", "service stops"),
            entry("Tstop", "all four stop together"));

    private PaperWords() {}

    /** A trace in words, one line per firing, for example {@code 8. Tp4: player stops}. */
    static List<String> steps(List<Transition> trace) {
        return IntStream.range(0, trace.size())
                .mapToObj(i -> "%2d. %-7s %s"
                        .formatted(
                                i + 1, trace.get(i).name(), meaning(trace.get(i).name())))
                .toList();
    }

    static String meaning(String transition) {
        var meaning = MEANINGS.get(transition);
        if (meaning == null) {
            throw new IllegalArgumentException("there are no words for the transition " + transition);
        }
        return meaning;
    }
}
