package io.troupe.petri.testkit;

import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.DeadlockFree;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.petri.wiring.WiringResult.Unknown;
import java.util.function.Function;
import org.assertj.core.api.AbstractAssert;
import org.jspecify.annotations.Nullable;

/**
 * An AssertJ assertion about a {@link Wiring}.
 *
 * {@snippet :
 * @Test
 * void components_neverDeadlock() {
 *     assertThat(Wiring.of("demo").component(client()).component(planner()).build()).cannotDeadlock();
 * }
 * }
 *
 * <p><b>Role.</b> For unit tests whose class path has AssertJ 3.
 *
 * <p><b>Cost.</b> That of {@link WiringCheck#check(Wiring)} for each assertion.
 *
 * <p><b>Errors.</b> An assertion that fails throws {@link AssertionError}; its message is the counterexample: who waits
 * for whom, and the steps that lead there.
 */
public final class WiringAssert extends AbstractAssert<WiringAssert, Wiring> {
    private final Function<Wiring, WiringResult> check;

    private WiringAssert(@Nullable Wiring wiring, Function<Wiring, WiringResult> check) {
        super(wiring, WiringAssert.class);
        this.check = check;
    }

    /** Starts an assertion within the limits of {@link WiringCheck#check(Wiring)}. */
    public static WiringAssert assertThat(@Nullable Wiring wiring) {
        return new WiringAssert(wiring, WiringCheck::check);
    }

    /** The same assertion, where each search ends within {@code limits}. */
    public WiringAssert within(SearchLimits limits) {
        return new WiringAssert(actual, wiring -> WiringCheck.check(wiring, limits)).as(descriptionText());
    }

    /** Passes if every component can go on from every state that can be reached. */
    public WiringAssert cannotDeadlock() {
        switch (result()) {
            case Proved proved -> {}
            case Deadlock deadlock -> fail("can deadlock", deadlock.counterexample());
            case Blocked blocked ->
                fail("lets components wait for ever while others may go on", blocked.counterexample());
            case DeadlockFree free ->
                fail(
                        "never stops as a whole, but it was too large to know if a component can wait for ever",
                        free.figures() + "\nexpected larger limits, as in assertThat(wiring).within(limits), or"
                                + " neverStopsAsAWhole()");
            case Unknown unknown ->
                fail(
                        "was too large to know if it can deadlock",
                        unknown.figures() + "; " + unknown.reduced()
                                + "\nexpected larger limits, as in assertThat(wiring).within(limits)");
        }
        return this;
    }

    /** Passes if there is no state in which nothing can happen; a component may wait for ever while others go on. */
    public WiringAssert neverStopsAsAWhole() {
        switch (result()) {
            case Proved proved -> {}
            case Blocked blocked -> {}
            case DeadlockFree free -> {}
            case Deadlock deadlock -> fail("can deadlock", deadlock.counterexample());
            case Unknown unknown ->
                fail(
                        "was too large to know if it can deadlock",
                        unknown.figures() + "; " + unknown.reduced()
                                + "\nexpected larger limits, as in assertThat(wiring).within(limits)");
        }
        return this;
    }

    private WiringResult result() {
        isNotNull();
        return check.apply(actual);
    }

    private void fail(String verdict, Object story) {
        failWithMessage("%s", "wiring " + actual.name() + " " + verdict + ":\n" + story);
    }
}
