package io.troupe.bench;

import org.jspecify.annotations.Nullable;
import org.nustaq.kontraktor.Actor;
import org.nustaq.kontraktor.Actors;
import org.nustaq.kontraktor.impl.SimpleScheduler;

/** An actor with ten one-way messages. */
public final class KontraktorFamily implements Family {
    private final Ten ten;

    public KontraktorFamily(SimpleScheduler scheduler, Tally tally) {
        ten = Actors.AsActor(Ten.class, scheduler);
        ten.count(tally);
    }

    /** The actor; not final, since its proxy is a subclass. */
    @SuppressWarnings("serial") // Kontraktor's actors are serializable, but are never serialized here
    public static class Ten extends Actor<Ten> {
        private @Nullable Tally tally;

        public void count(Tally newTally) {
            tally = newTally;
        }

        public void add1(int amount) {
            tally.add(amount);
        }

        public void add2(int amount) {
            tally.add(2 * amount);
        }

        public void add3(int amount) {
            tally.add(3 * amount);
        }

        public void add4(int amount) {
            tally.add(4 * amount);
        }

        public void add5(int amount) {
            tally.add(5 * amount);
        }

        public void add6(int amount) {
            tally.add(6 * amount);
        }

        public void add7(int amount) {
            tally.add(7 * amount);
        }

        public void add8(int amount) {
            tally.add(8 * amount);
        }

        public void add9(int amount) {
            tally.add(9 * amount);
        }

        public void add10(int amount) {
            tally.add(10 * amount);
        }
    }

    @Override
    public void send(int amount) {
        ten.add1(amount);
        ten.add2(amount);
        ten.add3(amount);
        ten.add4(amount);
        ten.add5(amount);
        ten.add6(amount);
        ten.add7(amount);
        ten.add8(amount);
        ten.add9(amount);
        ten.add10(amount);
    }
}
