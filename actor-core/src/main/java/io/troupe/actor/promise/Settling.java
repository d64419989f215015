package io.troupe.actor.promise;

import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A promise that was settled by a thread that is not its listeners' own. While they are being told, whoever registers
 * joins the end of the line. After that, as long as any of them has still to run, the way to a listener is the one that
 * they took, through the inbox of its home: what a home queues for itself would overtake them there.
 */
final class Settling extends Special {
    private final Object outcome;
    private final AtomicReference<@Nullable Node> late = new AtomicReference<>();
    private final AtomicInteger onTheirWay = new AtomicInteger();

    Settling(Object outcome, Node listeners) {
        this.outcome = outcome;
        for (Node node = listeners; node != null; node = node.next) {
            if (node instanceof Stage) {
                onTheirWay.incrementAndGet();
            }
        }
    }

    /** One more listener that has still to run; whether others have, too. */
    boolean setOut(Node listener) {
        return listener instanceof Stage && onTheirWay.getAndIncrement() > 0;
    }

    /** A listener runs. */
    void arrive() {
        onTheirWay.decrementAndGet();
    }

    /** Whether some listener's home may be running beside the calling thread. */
    static boolean isNeeded(Node newest) {
        for (Node node = newest; node != null; node = node.next) {
            if (node instanceof Stage<?, ?> stage && stage.isElsewhere()) {
                return true;
            }
        }
        return false;
    }

    Object outcome() {
        return outcome;
    }

    /** Puts a listener at the end of the line; false if the line is closed: everybody in it has been told. */
    boolean join(Node listener) {
        while (true) {
            Node now = late.get();
            if (now == Claim.REFUSED) {
                return false;
            }
            listener.next = now;
            if (late.compareAndSet(now, listener)) {
                return true;
            }
        }
    }

    /** The last in line: closes it, or lets those who came late go first. */
    static final class End extends Node {
        private final Settling settling;

        End(Settling settling, Node listeners) {
            this.settling = settling;
            this.next = listeners;
        }

        /**
         * Those who came late, newest first, with this end behind them; null if nobody came, and the line is closed.
         */
        @Nullable
        Node tryToEnd() {
            if (settling.late.compareAndSet(null, Claim.REFUSED)) {
                return null;
            }
            next = settling.late.getAndSet(null);
            return this;
        }

        @Override
        protected void run() {
            throw new IllegalStateException("the end of a line is never run");
        }
    }
}
