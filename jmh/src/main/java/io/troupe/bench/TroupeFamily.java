package io.troupe.bench;

import io.troupe.actor.ActorSpace;

/** An interface with ten one-way messages. */
public final class TroupeFamily implements Family {
    private final Ten ten;

    public TroupeFamily(ActorSpace space, Tally tally) {
        ten = space.spawn(Ten.class, () -> new PlainTen(tally));
    }

    /** The actor. */
    public interface Ten {
        void add1(int amount);

        void add2(int amount);

        void add3(int amount);

        void add4(int amount);

        void add5(int amount);

        void add6(int amount);

        void add7(int amount);

        void add8(int amount);

        void add9(int amount);

        void add10(int amount);
    }

    private record PlainTen(Tally tally) implements Ten {
        @Override
        public void add1(int amount) {
            tally.add(amount);
        }

        @Override
        public void add2(int amount) {
            tally.add(2 * amount);
        }

        @Override
        public void add3(int amount) {
            tally.add(3 * amount);
        }

        @Override
        public void add4(int amount) {
            tally.add(4 * amount);
        }

        @Override
        public void add5(int amount) {
            tally.add(5 * amount);
        }

        @Override
        public void add6(int amount) {
            tally.add(6 * amount);
        }

        @Override
        public void add7(int amount) {
            tally.add(7 * amount);
        }

        @Override
        public void add8(int amount) {
            tally.add(8 * amount);
        }

        @Override
        public void add9(int amount) {
            tally.add(9 * amount);
        }

        @Override
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
