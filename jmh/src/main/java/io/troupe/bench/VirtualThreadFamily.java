package io.troupe.bench;

import java.util.concurrent.LinkedTransferQueue;

/** A virtual thread that takes ten types of records from its queue. */
public final class VirtualThreadFamily implements Family {
    private final LinkedTransferQueue<Message> mailbox = new LinkedTransferQueue<>();
    private final Tally tally;

    public VirtualThreadFamily(Tally tally) {
        this.tally = tally;
        Thread.startVirtualThread(this::receive);
    }

    private sealed interface Message {}

    private record Add1(int amount) implements Message {}

    private record Add2(int amount) implements Message {}

    private record Add3(int amount) implements Message {}

    private record Add4(int amount) implements Message {}

    private record Add5(int amount) implements Message {}

    private record Add6(int amount) implements Message {}

    private record Add7(int amount) implements Message {}

    private record Add8(int amount) implements Message {}

    private record Add9(int amount) implements Message {}

    private record Add10(int amount) implements Message {}

    private void receive() {
        try {
            while (true) {
                handle(mailbox.take());
            }
        } catch (InterruptedException stopped) {
            throw new IllegalStateException("no caller stops an actor this way", stopped);
        }
    }

    private void handle(Message message) {
        switch (message) {
            case Add1 add -> tally.add(add.amount());
            case Add2 add -> tally.add(2 * add.amount());
            case Add3 add -> tally.add(3 * add.amount());
            case Add4 add -> tally.add(4 * add.amount());
            case Add5 add -> tally.add(5 * add.amount());
            case Add6 add -> tally.add(6 * add.amount());
            case Add7 add -> tally.add(7 * add.amount());
            case Add8 add -> tally.add(8 * add.amount());
            case Add9 add -> tally.add(9 * add.amount());
            case Add10 add -> tally.add(10 * add.amount());
        }
    }

    @Override
    public void send(int amount) {
        mailbox.add(new Add1(amount));
        mailbox.add(new Add2(amount));
        mailbox.add(new Add3(amount));
        mailbox.add(new Add4(amount));
        mailbox.add(new Add5(amount));
        mailbox.add(new Add6(amount));
        mailbox.add(new Add7(amount));
        mailbox.add(new Add8(amount));
        mailbox.add(new Add9(amount));
        mailbox.add(new Add10(amount));
    }
}
