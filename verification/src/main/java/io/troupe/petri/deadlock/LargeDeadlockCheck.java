package io.troupe.petri.deadlock;

import static java.util.Objects.requireNonNull;

import io.troupe.petri.LargeMarking;
import io.troupe.petri.LargeNet;
import io.troupe.petri.PetriNet;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.Transition;
import java.util.List;
import java.util.Optional;

/**
 * Looks for a dead marking of a {@link LargeNet}. It searches the net without the large places, which are assumed never
 * to run out of tokens. If {@link DeadlockCheck} finds a dead marking there, its trace is fired again with the tokens
 * of all places. So a trace that is returned is one of the large net, whatever its inhibitor arcs and priorities.
 *
 * <p>There is no proof that a large net cannot deadlock: the tokens of a large place can be used up, and then a
 * transition that waits for them is disabled.
 *
 * {@snippet :
 * var result = LargeDeadlockCheck.decide(large, SearchLimits.markings(1_000_000));
 * assertThat(result).isInstanceOf(LargeDeadlockCheck.CanDeadlock.class);
 * }
 *
 * <p><b>Threads.</b> Thread-safe.
 *
 * <p><b>Cost.</b> That of {@link DeadlockCheck#decide(PetriNet, SearchLimits)}.
 *
 * <p><b>Errors.</b> A net without large places throws {@link IllegalArgumentException}: {@code DeadlockCheck} decides
 * it.
 */
public final class LargeDeadlockCheck {
    private LargeDeadlockCheck() {}

    /** The result of {@link #decide}. */
    public sealed interface Result {}

    /**
     * The net can deadlock.
     *
     * @param marking a reachable marking in which no transition may fire
     * @param trace a firing sequence that leads there from the initial marking
     */
    public record CanDeadlock(LargeMarking marking, List<Transition> trace) implements Result {
        public CanDeadlock {
            requireNonNull(marking, "marking");
            trace = List.copyOf(trace);
        }
    }

    /**
     * Not known.
     *
     * @param reason in words, with the large places
     */
    public record Unknown(String reason) implements Result {
        public Unknown {
            requireNonNull(reason, "reason");
        }
    }

    /** Searches within {@code limits}, as {@link DeadlockCheck} does. */
    public static Result decide(LargeNet large, SearchLimits limits) {
        var places = large.largePlaces();
        if (places.isEmpty()) {
            throw new IllegalArgumentException("net " + large.net().name() + " has no large places");
        }
        DeadlockCheck.Result result;
        try {
            result = DeadlockCheck.decide(large.withoutLargePlaces(), limits);
        } catch (ArithmeticException e) {
            return new Unknown("the net without " + places + " cannot be searched: " + e.getMessage());
        }
        return switch (result) {
            case DeadlockCheck.CanDeadlock found -> replay(large, found.trace());
            case DeadlockCheck.Proved proof ->
                new Unknown("no marking is dead while " + places + " enable and inhibit what they do at first ("
                        + proof.reason() + "); what follows then is not searched");
            case DeadlockCheck.Unknown unknown ->
                new Unknown("no dead marking among " + unknown.markings() + " of the net without " + places
                        + ", end of the search: " + unknown.end());
        };
    }

    private static Result replay(LargeNet large, List<Transition> trace) {
        var firings = trace.stream().map(t -> large.net().transition(t.name())).toList();
        Optional<LargeMarking> end;
        try {
            end = large.after(firings);
        } catch (ArithmeticException e) {
            return new Unknown("the trace that was found cannot be fired: " + e.getMessage());
        }
        return end.isPresent() && large.enabled(end.get()).isEmpty()
                ? new CanDeadlock(end.get(), firings)
                : new Unknown("the dead marking that was found in the net without " + large.largePlaces()
                        + " is none with their tokens");
    }
}
