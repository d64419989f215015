package io.troupe.actor;

import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.IJ_Result;

/**
 * A result that a subscriber of the newest one receives while the next one is sent is received or counted, not both.
 */
@JCStressTest
@Outcome(id = "12, 0", expect = Expect.ACCEPTABLE, desc = "Received before it could be replaced.")
@Outcome(id = "2, 1", expect = Expect.ACCEPTABLE, desc = "Replaced, and counted.")
@Outcome(expect = Expect.FORBIDDEN, desc = "Lost, received twice, out of order or not counted.")
@State
public class NewestAgainstReceiver {
    private final ActorSpace space =
            ActorSpace.create(SpaceSettings.named("law").withoutThread());
    private final Callback.Stream<Integer> reader;
    private final Callback<Integer> results;
    private int order;

    public NewestAgainstReceiver() {
        reader = new Callback.Stream<>(1, result -> order = 10 * order + result, end -> {});
        results = ReturningCallback.to(reader, space.home);
        results.next(1);
    }

    @Actor
    public void send() {
        results.next(2);
    }

    @Actor
    public void receive() {
        space.runQueued();
    }

    @Arbiter
    public void look(IJ_Result result) {
        space.runQueued();
        result.r1 = order;
        result.r2 = reader.dropped();
    }
}
