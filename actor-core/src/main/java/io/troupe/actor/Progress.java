package io.troupe.actor;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;

/** Keeps what comes behind it off the cache lines of what comes before. */
@SuppressWarnings("unused")
abstract class ProgressPadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** The count itself. */
abstract class ProgressCount extends ProgressPadding {
    long served;
}

/**
 * How many entries a space has served: written by its thread at every one, read by others now and then, on a cache line
 * that nobody else needs.
 */
@SuppressWarnings("unused")
final class Progress extends ProgressCount {
    private static final VarHandle SERVED;

    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;

    static {
        try {
            SERVED = MethodHandles.lookup().findVarHandle(ProgressCount.class, "served", long.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    /** One more; on the space's thread. */
    void step() {
        SERVED.setOpaque(this, served + 1);
    }

    /** From any thread, a little behind. */
    long served() {
        return (long) SERVED.getOpaque(this);
    }
}
