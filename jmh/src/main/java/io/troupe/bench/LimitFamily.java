package io.troupe.bench;

import java.util.function.Consumer;

/** Ten objects of ten classes, sent again and again. They carry no number, but count how often they were sent. */
public final class LimitFamily implements Family {
    private final Consumer<Object> inbox;
    private final Tally tally;
    private final Limit.Task[] tasks;
    private int round;

    public LimitFamily(Consumer<Object> inbox, Tally tally) {
        this.inbox = inbox;
        this.tally = tally;
        tasks = new Limit.Task[] {
            new Add1(),
            new Add2(),
            new Add3(),
            new Add4(),
            new Add5(),
            new Add6(),
            new Add7(),
            new Add8(),
            new Add9(),
            new Add10()
        };
    }

    private final class Add1 extends Limit.Task {
        @Override
        public void run() {
            tally.add(round);
        }
    }

    private final class Add2 extends Limit.Task {
        @Override
        public void run() {
            tally.add(2 * round);
        }
    }

    private final class Add3 extends Limit.Task {
        @Override
        public void run() {
            tally.add(3 * round);
        }
    }

    private final class Add4 extends Limit.Task {
        @Override
        public void run() {
            tally.add(4 * round);
        }
    }

    private final class Add5 extends Limit.Task {
        @Override
        public void run() {
            tally.add(5 * round);
        }
    }

    private final class Add6 extends Limit.Task {
        @Override
        public void run() {
            tally.add(6 * round);
        }
    }

    private final class Add7 extends Limit.Task {
        @Override
        public void run() {
            tally.add(7 * round);
        }
    }

    private final class Add8 extends Limit.Task {
        @Override
        public void run() {
            tally.add(8 * round);
        }
    }

    private final class Add9 extends Limit.Task {
        @Override
        public void run() {
            tally.add(9 * round);
        }
    }

    private final class Add10 extends Limit.Task {
        @Override
        public void run() {
            tally.add(10 * round++);
        }
    }

    @Override
    public void send(int amount) {
        for (Limit.Task task : tasks) {
            inbox.accept(task);
        }
    }
}
