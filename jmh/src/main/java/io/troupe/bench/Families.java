package io.troupe.bench;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;

/** Twenty copies of a contender's {@link Family}: two hundred message types. */
final class Families {
    private static final int COPIES = 20;

    /** How many message types there are. */
    static final int TYPES = COPIES * Family.TYPES;

    private final Finish finish = new Finish();
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

    /** Sends so many messages of all types in turn, a multiple of {@link #TYPES}, and waits for the last one. */
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

    /** What each actor has added up. */
    List<Long> sums() {
        return tallies.stream().map(Tally::sum).toList();
    }
}
