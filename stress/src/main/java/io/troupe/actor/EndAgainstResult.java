package io.troupe.actor;

import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.IZ_Result;

/** Two threads share a callback: one sends a result while the other one finishes it. Nothing follows the end. */
@JCStressTest
@Outcome(id = "19, false", expect = Expect.ACCEPTABLE, desc = "The result came first.")
@Outcome(id = "9, true", expect = Expect.ACCEPTABLE, desc = "The end came first: the sender got an exception.")
@Outcome(id = "9, false", expect = Expect.ACCEPTABLE, desc = "The end overtook the result, which is dropped.")
@Outcome(expect = Expect.FORBIDDEN, desc = "A result after the end, no end, or one that was rejected and delivered.")
@State
public class EndAgainstResult {
    private final ActorSpace space =
            ActorSpace.create(SpaceSettings.named("law").withoutThread());
    private final Callback<Integer> results;
    private int order;

    public EndAgainstResult() {
        var reader = new Callback.Stream<Integer>(result -> order = 10 * order + result, end -> order = 10 * order + 9);
        results = ReturningCallback.to(reader, space.home);
    }

    @Actor
    public void send(IZ_Result result) {
        try {
            results.next(1);
        } catch (IllegalStateException ended) {
            result.r2 = true;
        }
    }

    @Actor
    public void finish() {
        results.finish();
    }

    @Arbiter
    public void look(IZ_Result result) {
        space.runQueued();
        result.r1 = order;
    }
}
