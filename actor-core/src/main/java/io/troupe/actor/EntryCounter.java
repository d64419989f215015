package io.troupe.actor;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;

/** Padding that keeps the following field off the cache lines of the fields before it. */
@SuppressWarnings("unused")
abstract class EntryCounterPadding {
    private long p00, p01, p02, p03, p04, p05, p06, p07, p08, p09, p10, p11, p12, p13, p14, p15;
}

/** The counter. */
abstract class EntryCounterValue extends EntryCounterPadding {
    long served;
}

/**
 * The number of entries that a space has processed. Its thread writes it for every entry, other threads read it
 * occasionally; it occupies separate cache lines.
 */
@SuppressWarnings("unused")
final class EntryCounter extends EntryCounterValue {
    private static final VarHandle SERVED;

    private long q00, q01, q02, q03, q04, q05, q06, q07, q08, q09, q10, q11, q12, q13, q14, q15;

    static {
        try {
            SERVED = MethodHandles.lookup().findVarHandle(EntryCounterValue.class, "served", long.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    /** Adds one; on the space's thread. */
    void step() {
        SERVED.setOpaque(this, served + 1);
    }

    /** The count; from any thread, slightly delayed. */
    long served() {
        return (long) SERVED.getOpaque(this);
    }
}
