package io.troupe.bench;

import kotlin.Unit;
import kotlinx.coroutines.CoroutineScope;

/** A coroutine that receives ten types of records from its channel. */
public final class ChannelFamily implements Family {
    private final Ten ten;

    public ChannelFamily(CoroutineScope scope, Tally tally) {
        ten = new Ten(tally);
        ten.start(scope);
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

    private static final class Ten extends ChannelContender.Mailbox<Message> {
        private final Tally tally;

        Ten(Tally tally) {
            this.tally = tally;
        }

        @Override
        public Object handle(Message message, ChannelContender.Receiver<Message> receiver) {
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
            return Unit.INSTANCE;
        }
    }

    @Override
    public void send(int amount) {
        ten.send(new Add1(amount));
        ten.send(new Add2(amount));
        ten.send(new Add3(amount));
        ten.send(new Add4(amount));
        ten.send(new Add5(amount));
        ten.send(new Add6(amount));
        ten.send(new Add7(amount));
        ten.send(new Add8(amount));
        ten.send(new Add9(amount));
        ten.send(new Add10(amount));
    }
}
