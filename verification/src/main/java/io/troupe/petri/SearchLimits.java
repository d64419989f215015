package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.function.BooleanSupplier;
import java.util.function.Consumer;

/**
 * How far a search over markings may go, how to stop it, and what to report.
 *
 * <p><b>Threads.</b> The search asks {@code cancelled} and calls {@code report} on its own thread. To stop it from
 * another thread, let {@code cancelled} read a volatile value, for example {@code AtomicBoolean::get}.
 *
 * <p><b>Errors.</b> What {@code cancelled} or {@code report} throws ends the search and reaches its caller.
 *
 * @param maxMarkings how many markings the search may keep, 1 or more
 * @param cancelled asked before the successors of each marking are looked for; once true, the search ends with what it
 *     has
 * @param markingsPerReport after how many further markings, whose successors were looked for, {@code report} is called;
 *     1 or more
 * @param report called with how far the search is
 * @param maxBytes how much memory the search may take, 1 or more; before it would take more, it ends with what it has
 */
public record SearchLimits(
        int maxMarkings,
        BooleanSupplier cancelled,
        int markingsPerReport,
        Consumer<SearchProgress> report,
        long maxBytes) {
    public SearchLimits {
        requireNonNull(cancelled, "cancelled");
        requireNonNull(report, "report");
        if (maxMarkings < 1) {
            throw new IllegalArgumentException("maxMarkings is " + maxMarkings + ", expected 1 or more");
        }
        if (markingsPerReport < 1) {
            throw new IllegalArgumentException("markingsPerReport is " + markingsPerReport + ", expected 1 or more");
        }
        if (maxBytes < 1) {
            throw new IllegalArgumentException("maxBytes is " + maxBytes + ", expected 1 or more");
        }
    }

    /** Up to {@code maxMarkings} markings, without a way to cancel and without reports. */
    public static SearchLimits markings(int maxMarkings) {
        return new SearchLimits(maxMarkings, () -> false, Integer.MAX_VALUE, progress -> {}, Long.MAX_VALUE);
    }

    /** These limits, and the search ends once {@code flag} is true. */
    public SearchLimits cancelledBy(BooleanSupplier flag) {
        return new SearchLimits(maxMarkings, flag, markingsPerReport, report, maxBytes);
    }

    /** These limits, and {@code listener} is called after every {@code markings} markings. */
    public SearchLimits reporting(int markings, Consumer<SearchProgress> listener) {
        return new SearchLimits(maxMarkings, cancelled, markings, listener, maxBytes);
    }

    /** These limits, but at most {@code most} markings. */
    public SearchLimits atMost(int most) {
        return new SearchLimits(Math.min(maxMarkings, most), cancelled, markingsPerReport, report, maxBytes);
    }

    /** These limits, and the search ends before it would take more than {@code bytes} of memory. */
    public SearchLimits within(long bytes) {
        return new SearchLimits(maxMarkings, cancelled, markingsPerReport, report, bytes);
    }
}
