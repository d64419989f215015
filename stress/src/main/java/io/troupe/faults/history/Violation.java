package io.troupe.faults.history;

import java.util.Comparator;
import java.util.List;
import java.util.stream.Collectors;

/**
 * A rule that a history breaks.
 *
 * @param evidence the lines that show it
 */
public record Violation(Rule rule, String what, List<History.Entry> evidence) {
    /** What has to be true of every history. */
    public enum Rule {
        SETTLED_ONCE("every call is settled exactly once"),
        SETTLED_IN_TIME("every call is settled within its limit"),
        EXECUTED_ONCE("nothing is executed twice"),
        NOT_SENT("a call that surely was not sent is not executed"),
        ANSWERED("an answer is that of one execution"),
        NOT_LATE("no call is executed after its limit"),
        STREAM("a stream has all its items in order, and one end"),
        COUNTED("every value is delivered or reported, once"),
        FRESH("no velocity older than 300 ms is delivered, or reaches a robot"),
        STOPPED("a robot whose driver is gone stops within 0.5 s"),
        STANDS("a robot that gets no speed stands within 0.5 s"),
        DRIVEN_AGAIN("a robot has another driver within 5 s, if one can be reached"),
        CLEAR_END("without a provider, and only then, an arbitrator ends with a clear error"),
        ONE_DRIVER("no robot has two drivers"),
        LEASE("a provider whose lease is over commands nothing"),
        MEMORY("the memory of a node is bounded"),
        SURPRISE("processes do only what is done to them");

        private final String text;

        Rule(String text) {
            this.text = text;
        }

        @Override
        public String toString() {
            return text;
        }
    }

    private static final int LINES_SHOWN = 12;

    public Violation {
        evidence = evidence.stream()
                .sorted(Comparator.comparingLong(History.Entry::nanos))
                .toList();
    }

    @Override
    public String toString() {
        int left = Math.max(0, evidence.size() - LINES_SHOWN);
        return rule + ": " + what
                + evidence.stream()
                        .limit(LINES_SHOWN)
                        .map(entry -> "\n    " + entry)
                        .collect(Collectors.joining())
                + (left == 0 ? "" : "\n    and " + left + " more lines");
    }
}
