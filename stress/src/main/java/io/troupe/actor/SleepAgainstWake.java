package io.troupe.actor;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.QueueEntry;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.ZZ_Result;

/** A space that goes to sleep while another thread queues a message sees the message, or is woken. */
@JCStressTest
@Outcome(
        id = {"false, true", "false, false"},
        expect = Expect.ACCEPTABLE,
        desc = "The sleeper saw the message, and does not park.")
@Outcome(id = "true, false", expect = Expect.ACCEPTABLE, desc = "The sleeper is about to park, and was woken.")
@Outcome(
        id = "true, true",
        expect = Expect.FORBIDDEN,
        desc = "Each missed the other: the space parks with a message waiting.")
@State
public class SleepAgainstWake {
    private static final class Letter extends QueueEntry {}

    /** No timer is set here, so all states may share this wheel. */
    private static final TimerWheel NO_TIMERS = new TimerWheel(Clock.system());

    private static final SpaceSettings SETTINGS = SpaceSettings.named("law").withoutThread();
    private static final ActorSpace SPACE = ActorSpace.create(SETTINGS);

    private final Dispatcher dispatcher = new Dispatcher(
            SPACE.home,
            new EntryQueue(),
            new EntryQueue(),
            new EntryRing(),
            new EntryRing(),
            NO_TIMERS,
            Clock.system());
    private final IdleStrategy lifeline = new IdleStrategy();

    @Actor
    public void sleep(ZZ_Result result) {
        result.r1 = lifeline.fallAsleep(dispatcher);
    }

    @Actor
    public void wake() {
        dispatcher.inbox.offer(new Letter());
        lifeline.wake();
    }

    @Arbiter
    public void look(ZZ_Result result) {
        result.r2 = lifeline.isAsleep();
    }
}
