package io.troupe.actor.model;

import java.util.List;
import org.jspecify.annotations.Nullable;

/** What the model says a program shows, and how far that goes. */
enum Expectation {
    /** As documented, to the end: actors that fail or stop themselves end with the turn in which they did. */
    FULL,
    /** As {@link #FULL}, up to the first known error. */
    CHANGED,
    /** Actors end behind the callbacks that wait; up to the first known error. */
    TODAY,
    /** As far as both agree, and neither comes to a drop of the oldest, a listener of a stopped actor or a delay that a close cuts short. */
    AGREED;

    /** @param whole whether nothing may follow the events */
    private record Foretold(List<String> events, boolean whole) {}

    /** The difference between the model and the library, or null; and never one for a program that grows too long. */
    @Nullable
    String difference(List<Act> program) {
        Foretold foretold = foretell(program);
        var seen = LibraryRun.of(program).events();
        int same = firstDifference(foretold.events, seen);
        boolean equal = same == foretold.events.size() && (!foretold.whole || same == seen.size());
        if (equal) {
            return null;
        }
        var before = String.join("\n  ", foretold.events.subList(Math.max(0, same - 12), same));
        return "after %d equal events, the last of which are%n  %s%nthe model expects%n  %s%nand the library shows%n  %s"
                .formatted(same, before, at(foretold.events, same), at(seen, same));
    }

    private static String at(List<String> events, int index) {
        return index < events.size() ? events.get(index) : "nothing more";
    }

    private Foretold foretell(List<Act> program) {
        var withTurn = ModelRun.of(program, ModelSpace.End.WITH_ITS_TURN);
        var behind = ModelRun.of(program, ModelSpace.End.BEHIND_CALLBACKS);
        if (withTurn.isFull() || behind.isFull()) {
            return new Foretold(List.of(), false);
        }
        return switch (this) {
            case FULL -> first(withTurn, withTurn.events().size());
            case CHANGED -> first(withTurn, withTurn.right());
            case TODAY -> first(behind, behind.right());
            case AGREED -> {
                int agreed = firstDifference(withTurn.events(), behind.events());
                int settled = Math.min(withTurn.settled(), behind.settled());
                int sure = Math.min(agreed, settled);
                boolean whole = sure == withTurn.events().size()
                        && sure == behind.events().size();
                yield new Foretold(withTurn.events().subList(0, sure), whole);
            }
        };
    }

    private static Foretold first(History history, int events) {
        return new Foretold(
                history.events().subList(0, events), events == history.events().size());
    }

    /** How much of what a program shows is compared, for the report: events compared and events in all. */
    int[] coverage(List<Act> program) {
        return new int[] {
            foretell(program).events.size(), LibraryRun.of(program).events().size()
        };
    }

    private static int firstDifference(List<String> one, List<String> other) {
        int at = 0;
        while (at < one.size() && at < other.size() && one.get(at).equals(other.get(at))) {
            at++;
        }
        return at;
    }
}
