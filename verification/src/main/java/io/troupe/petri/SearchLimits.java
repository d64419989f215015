package io.troupe.petri;

import static java.util.Objects.requireNonNull;

import java.util.function.BooleanSupplier;
import java.util.function.Consumer;

/**
 * The limits of a search over markings, its cancellation and its progress reports.
 *
 * <p><b>Threads.</b> The search calls {@code cancelled} and {@code report} on the thread that runs it. To cancel it
 * from another thread, let {@code cancelled} read a volatile value, for example {@code AtomicBoolean::get}.
 *
 * <p><b>Errors.</b> An exception thrown by {@code cancelled} or {@code report} ends the search and is thrown to its
 * caller.
 *
 * @param maxMarkings the largest number of markings that the search keeps, 1 or more
 * @param cancelled tested before each marking is expanded; once true, the search ends with its result so far
 * @param markingsPerReport the number of expanded markings between two calls of {@code report}, 1 or more
 * @param report called with the progress of the search
 * @param maxBytes the memory that the search may use, 1 or more; it ends with its result so far before it would use
 *     more
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

    /** These limits; the search ends once {@code flag} is true. */
    public SearchLimits cancelledBy(BooleanSupplier flag) {
        return new SearchLimits(maxMarkings, flag, markingsPerReport, report, maxBytes);
    }

    /** These limits; {@code listener} is called after every {@code markings} markings. */
    public SearchLimits reporting(int markings, Consumer<SearchProgress> listener) {
        return new SearchLimits(maxMarkings, cancelled, markings, listener, maxBytes);
    }

    /** These limits, but at most {@code most} markings. */
    public SearchLimits atMost(int most) {
        return new SearchLimits(Math.min(maxMarkings, most), cancelled, markingsPerReport, report, maxBytes);
    }

    /** These limits; the search ends before it would use more than {@code bytes} of memory. */
    public SearchLimits within(long bytes) {
        return new SearchLimits(maxMarkings, cancelled, markingsPerReport, report, bytes);
    }
}
