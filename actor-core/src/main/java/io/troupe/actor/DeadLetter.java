package io.troupe.actor;

import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * A message that was not delivered.
 *
 * {@snippet :
 * Consumer<DeadLetter> onDeadLetter = letter -> log.add(letter.message() + " to " + letter.actor());
 * ActorSpace space = ActorSpace.create(
 *         SpaceSettings.named("shop").withOnDeadLetter(onDeadLetter).withoutThread());
 * Counter counter = space.spawn(Counter.class, Counter::new);
 * space.close();
 * counter.add(1); // too late
 * }
 *
 * @param actor the name of the receiver
 * @param message the method with its parameter types
 * @param arguments the arguments themselves. Texts of a dead letter do not show them: they may be secret
 * @param reason why it was not delivered
 */
public record DeadLetter(String actor, String message, List<@Nullable Object> arguments, String reason) {
    /** The actor, the message and the reason. */
    @Override
    public String toString() {
        return message + " to " + actor + ": " + reason;
    }
}
