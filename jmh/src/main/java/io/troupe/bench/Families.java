package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;

/** Twenty copies of a contender's {@link Family}: two hundred message types, for the workload {@code tellOfMany}. */
final class Families {
    private static final int COPIES = 20;

    /** The number of message types. */
    static final int TYPES = COPIES * Family.TYPES;

    private final CompletionLatch finish = new CompletionLatch();
    private final AtomicInteger busy = new AtomicInteger();
    private final List<Tally> tallies = new ArrayList<>();
    private final List<Family> families = new ArrayList<>();

    Families(Contender contender) throws Exception {
        for (int i = 0; i < COPIES; i++) {
            var tally = new Tally(this::familyDone);
            tallies.add(tally);
            families.add(contender.newFamily(tally));
        }
    }

    private void familyDone() {
        if (busy.decrementAndGet() == 0) {
            finish.reach();
        }
    }

    /**
     * Sends {@code messages}, a multiple of {@link #TYPES}, of all types in turn, and waits until the last one is
     * handled.
     */
    void tell(int messages) {
        finish.reset();
        busy.set(COPIES);
        for (Tally tally : tallies) {
            tally.expect(messages / COPIES);
        }
        for (int i = 0; i < messages / TYPES; i++) {
            for (Family family : families) {
                family.send(i);
            }
        }
        finish.await();
    }

    List<Family> all() {
        return List.copyOf(families);
    }

    /** The sum that each actor has added up. */
    List<Long> sums() {
        return tallies.stream().map(Tally::sum).toList();
    }
}
