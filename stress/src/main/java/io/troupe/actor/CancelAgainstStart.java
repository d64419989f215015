package io.troupe.actor;

import io.troupe.actor.internal.loop.QueueEntries;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.ZII_Result;

/** A request that is cancelled while its actor begins it is settled once: cancelled, or with the result. */
@JCStressTest
@Outcome(id = "true, 0, -1", expect = Expect.ACCEPTABLE, desc = "Cancelled in time: never begun.")
@Outcome(id = "true, 1, -1", expect = Expect.ACCEPTABLE, desc = "Cancelled when it had begun: the answer is ignored.")
@Outcome(id = "false, 1, 42", expect = Expect.ACCEPTABLE, desc = "Answered first: cancelling does nothing.")
@Outcome(expect = Expect.FORBIDDEN, desc = "Neither or both, or the outcome is not the winner's.")
@State
public class CancelAgainstStart {
    private static final ActorCell CELL = startedCell();

    private final Ask request = new Ask();

    @Actor
    public void cancel(ZII_Result result) {
        result.r1 = request.cancel();
    }

    @Actor
    public void start() {
        try {
            QueueEntries.serve(request);
        } catch (Throwable thrown) {
            throw new IllegalStateException("an answer was thrown", thrown);
        }
    }

    @Arbiter
    public void look(ZII_Result result) {
        result.r2 = request.begun;
        result.r3 = request.isCancelled() ? -1 : request.getNow();
    }

    private static ActorCell startedCell() {
        var space = ActorSpace.create(SpaceSettings.named("law").withoutThread());
        var cell = new ActorCell(space.home, Object.class, 1, Object::new, ActorSettings.defaults());
        space.execute(cell::start);
        space.runQueued();
        return cell;
    }

    private static final class Ask extends Request<Integer> {
        private int begun;

        Ask() {
            super(CELL);
        }

        @Override
        protected Promise<Integer> invoke(Object implementation) {
            begun++;
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
