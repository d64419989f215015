package io.troupe.actor;

import java.time.Duration;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.ZZ_Result;

/** A request that is sent while the time limit that it shares is over is rejected, and so is the question itself. */
@JCStressTest
@Outcome(id = "true, true", expect = Expect.ACCEPTABLE, desc = "Both are rejected.")
@Outcome(expect = Expect.FORBIDDEN, desc = "A request is never rejected.")
@State
public class LimitAgainstRequest {
    private final ActorSpace space = ActorSpace.create(
            SpaceSettings.named("law").withClock(new ManualClock()).withoutThread());
    private final Request<Integer> request =
            new Ask(new ActorCell(space.home, Object.class, 1, Object::new, ActorSettings.defaults()));
    private final Deferred<Integer> question = new Deferred<>();
    private final TimeLimit limit = TimeLimit.of(space.home, Duration.ZERO, null);

    public LimitAgainstRequest() {
        limit.limit(question);
    }

    @Actor
    public void send() {
        limit.add(request);
    }

    @Actor
    public void expire() {
        limit.check();
    }

    @Arbiter
    public void look(ZZ_Result result) {
        result.r1 = request.isRejected();
        result.r2 = question.isRejected();
    }

    private static final class Ask extends Request<Integer> {
        Ask(ActorCell cell) {
            super(cell);
        }

        @Override
        protected Promise<Integer> invoke(Object implementation) {
            return Promise.of(42);
        }

        @Override
        public String method() {
            return "ask()";
        }

        @Override
        public Object[] arguments() {
            return new Object[0];
        }
    }
}
