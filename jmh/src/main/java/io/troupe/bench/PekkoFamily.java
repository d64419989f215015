package io.troupe.bench;

import org.apache.pekko.actor.typed.ActorRef;
import org.apache.pekko.actor.typed.ActorSystem;
import org.apache.pekko.actor.typed.Behavior;
import org.apache.pekko.actor.typed.Props;
import org.apache.pekko.actor.typed.javadsl.Behaviors;

/** A behaviour that switches over ten types of records. */
public final class PekkoFamily implements Family {
    private final Tally tally;
    private final ActorRef<Message> actor;

    public PekkoFamily(ActorSystem<?> system, String name, Tally tally) {
        this.tally = tally;
        actor = system.systemActorOf(behavior(), name, Props.empty());
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

    private Behavior<Message> behavior() {
        return Behaviors.receiveMessage(message -> {
            handle(message);
            return Behaviors.same();
        });
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
        actor.tell(new Add1(amount));
        actor.tell(new Add2(amount));
        actor.tell(new Add3(amount));
        actor.tell(new Add4(amount));
        actor.tell(new Add5(amount));
        actor.tell(new Add6(amount));
        actor.tell(new Add7(amount));
        actor.tell(new Add8(amount));
        actor.tell(new Add9(amount));
        actor.tell(new Add10(amount));
    }
}
