package io.troupe.actor;

import io.troupe.actor.internal.loop.EntryQueue;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.internal.loop.QueueEntries;
import io.troupe.actor.internal.loop.QueueEntry;
import java.util.ArrayDeque;
import org.jspecify.annotations.Nullable;
import org.openjdk.jcstress.annotations.Actor;
import org.openjdk.jcstress.annotations.Arbiter;
import org.openjdk.jcstress.annotations.Expect;
import org.openjdk.jcstress.annotations.JCStressTest;
import org.openjdk.jcstress.annotations.Outcome;
import org.openjdk.jcstress.annotations.State;
import org.openjdk.jcstress.infra.results.I_Result;

/**
 * A listener that a home registers while another thread settles the promise does not overtake an earlier listener of
 * that home.
 */
@JCStressTest
@Outcome(id = "12", expect = Expect.ACCEPTABLE, desc = "In the order of registration.")
@Outcome(expect = Expect.FORBIDDEN, desc = "Overtaken, lost or run twice.")
@State
public class LateListener {
    private final TinyHome home = new TinyHome();
    private final Deferred<Integer> promise;
    private int order;

    public LateListener() {
        home.thread = Thread.currentThread();
        promise = new Deferred<>(home, null);
        promise.then(value -> order = 10 * order + 1);
        home.thread = null;
    }

    @Actor
    public void settle() {
        promise.resolve(1);
    }

    @Actor
    public void register() {
        home.thread = Thread.currentThread();
        promise.then(value -> order = 10 * order + 2);
    }

    @Arbiter
    public void look(I_Result result) {
        home.thread = Thread.currentThread();
        home.drain();
        result.r1 = order;
    }

    /** Like a space: callbacks queued on its thread go to a ring, which is drained before the inbox. */
    private static final class TinyHome extends Home {
        @Override
        protected void runGuarded(Runnable task) {
            task.run();
        }

        private final ArrayDeque<QueueEntry> ring = new ArrayDeque<>();
        private final EntryQueue inbox = new EntryQueue();
        private @Nullable Thread thread;

        void drain() {
            for (QueueEntry node = next(); node != null; node = next()) {
                runOne(node);
            }
        }

        private static void runOne(QueueEntry node) {
            try {
                QueueEntries.serve(node);
            } catch (Throwable thrown) {
                throw new IllegalStateException("a listener threw", thrown);
            }
        }

        private @Nullable QueueEntry next() {
            QueueEntry node = ring.poll();
            return node != null ? node : inbox.poll();
        }

        @Override
        public boolean isCurrent() {
            return Thread.currentThread() == thread;
        }

        @Override
        public boolean isEnding() {
            return false;
        }

        @Override
        public void enqueue(QueueEntry node) {
            if (isCurrent()) {
                ring.add(node);
            } else {
                inbox.offer(node);
            }
        }

        @Override
        public void enqueueAsRemote(QueueEntry node) {
            inbox.offer(node);
        }

        @Override
        public void enqueueAtHome(QueueEntry node) {
            ring.add(node);
        }

        @Override
        public Runnable schedule(long delayNanos, Runnable task, Runnable ifClosed) {
            throw new UnsupportedOperationException("no timers are set here");
        }

        @Override
        public void rejected(QueueEntry rejected, Throwable error) {
            throw new UnsupportedOperationException("no promise is rejected here");
        }

        @Override
        public void await(QueueEntry awaited) {
            throw new UnsupportedOperationException("no thread waits here");
        }
    }
}
