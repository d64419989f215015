package io.troupe.actor.promise;

import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * A promise that was settled while some of its listeners live on other threads. Whoever registers while they are being told joins the end of the line;
 * whoever registers later goes behind those who may still wait in their home's inbox. So nobody overtakes those who registered before.
 */
final class Settling extends Special {
    private final Object outcome;
    private final AtomicReference<@Nullable Node> late = new AtomicReference<>();

    Settling(Object outcome) {
        this.outcome = outcome;
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

        /** Those who came late, newest first, with this end behind them; null if nobody came, and the line is closed for good. */
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
