package io.troupe.actor;

import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.I_Result;

/**
 * Another thread sends a result, then makes the space send the next one. The space's own result does not overtake the
 * first one, although it needs no inbox.
 */
@JCStressTest
@Outcome(id = "123", expect = Expect.ACCEPTABLE, desc = "The space sent its result before the third one was sent.")
@Outcome(id = "132", expect = Expect.ACCEPTABLE, desc = "The space sent its result after the third one was sent.")
@Outcome(expect = Expect.FORBIDDEN, desc = "Lost, or out of order.")
@State
public class ResultsOfTwoThreads {
    private final ActorSpace space =
            ActorSpace.create(SpaceSettings.named("law").withoutThread());
    private final Callback<Integer> results;
    private int order;

    public ResultsOfTwoThreads() {
        results = ReturningCallback.to(
                new Callback.Stream<Integer>(result -> order = 10 * order + result, end -> {}), space.home);
    }

    @Actor
    public void send() {
        results.next(1);
        space.execute(() -> results.next(2));
        results.next(3);
    }

    @Actor
    public void receive() {
        space.runQueued();
    }

    @Arbiter
    public void look(I_Result result) {
        space.runQueued();
        result.r1 = order;
    }
}
