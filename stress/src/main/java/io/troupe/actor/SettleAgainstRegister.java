package io.troupe.actor;

import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.II_Result;

/** A listener registered while the promise is being settled runs exactly once, and receives the value. */
@JCStressTest
@Outcome(id = "1, 42", expect = Expect.ACCEPTABLE, desc = "Ran once, with the value.")
@Outcome(expect = Expect.FORBIDDEN, desc = "Lost, run twice, or without the value.")
@State
public class SettleAgainstRegister {
    private final Deferred<Integer> promise = new Deferred<>();
    private int runs;
    private int value;

    @Actor
    public void settle() {
        promise.resolve(42);
    }

    @Actor
    public void register() {
        promise.then(result -> {
            runs++;
            value = result;
        });
    }

    @Arbiter
    public void look(II_Result result) {
        result.r1 = runs;
        result.r2 = value;
    }
}
