package io.troupe.actor;

import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.ZZI_Result;

/** Of two threads that settle a promise, one succeeds, and the promise has its value. */
@JCStressTest
@Outcome(id = "true, false, 1", expect = Expect.ACCEPTABLE, desc = "The first won.")
@Outcome(id = "false, true, 2", expect = Expect.ACCEPTABLE, desc = "The second won.")
@Outcome(expect = Expect.FORBIDDEN, desc = "None or both, or the loser's value.")
@State
public class SettleAgainstSettle {
    private final Deferred<Integer> promise = new Deferred<>();

    @Actor
    public void first(ZZI_Result result) {
        result.r1 = promise.resolve(1);
    }

    @Actor
    public void second(ZZI_Result result) {
        result.r2 = promise.resolve(2);
    }

    @Arbiter
    public void look(ZZI_Result result) {
        result.r3 = promise.getNow();
    }
}
