package io.troupe.bench;

import java.util.function.Consumer;

/** Ten classes of messages. */
public final class FloorFamily implements Family {
    private final Consumer<FloorContender.Entry> inbox;
    private final Tally tally;

    public FloorFamily(Consumer<FloorContender.Entry> inbox, Tally tally) {
        this.inbox = inbox;
        this.tally = tally;
    }

    private abstract static class Add extends FloorContender.Entry {
        final Tally tally;
        final int amount;

        Add(Tally tally, int amount) {
            this.tally = tally;
            this.amount = amount;
        }
    }

    private static final class Add1 extends Add {
        Add1(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(amount);
        }
    }

    private static final class Add2 extends Add {
        Add2(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(2 * amount);
        }
    }

    private static final class Add3 extends Add {
        Add3(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(3 * amount);
        }
    }

    private static final class Add4 extends Add {
        Add4(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(4 * amount);
        }
    }

    private static final class Add5 extends Add {
        Add5(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(5 * amount);
        }
    }

    private static final class Add6 extends Add {
        Add6(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(6 * amount);
        }
    }

    private static final class Add7 extends Add {
        Add7(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(7 * amount);
        }
    }

    private static final class Add8 extends Add {
        Add8(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(8 * amount);
        }
    }

    private static final class Add9 extends Add {
        Add9(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(9 * amount);
        }
    }

    private static final class Add10 extends Add {
        Add10(Tally tally, int amount) {
            super(tally, amount);
        }

        @Override
        public void run() {
            tally.add(10 * amount);
        }
    }

    @Override
    public void send(int amount) {
        inbox.accept(new Add1(tally, amount));
        inbox.accept(new Add2(tally, amount));
        inbox.accept(new Add3(tally, amount));
        inbox.accept(new Add4(tally, amount));
        inbox.accept(new Add5(tally, amount));
        inbox.accept(new Add6(tally, amount));
        inbox.accept(new Add7(tally, amount));
        inbox.accept(new Add8(tally, amount));
        inbox.accept(new Add9(tally, amount));
        inbox.accept(new Add10(tally, amount));
    }
}
