package io.troupe.actor;

import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * How an actor is made; immutable.
 *
 * {@snippet :
 * ActorSettings settings = ActorSettings.named("counter")
 *         .withSupervision(Supervision.restart(3, Duration.ofMinutes(1)))
 *         .withMailbox(1_000, Overflow.REJECT);
 * Counter counter = space.spawn(Counter.class, Counter::new, settings);
 * }
 *
 * @param name for messages about it; null = the type's simple name and a number
 * @param onError is told what its one-way messages and timers throw; null = the space's handler is
 * @param supervision what becomes of it then
 * @param mailbox how many calls may wait for it; null = any number
 */
public record ActorSettings(
        @Nullable String name,
        @Nullable ErrorHandler onError,
        Supervision supervision,
        @Nullable MailboxBound mailbox) {
    public static final ActorSettings DEFAULT = new ActorSettings(null, null, Supervision.RESUME, null);

    public ActorSettings {
        Objects.requireNonNull(supervision, "supervision");
    }

    public static ActorSettings named(String name) {
        return new ActorSettings(Objects.requireNonNull(name, "name"), null, Supervision.RESUME, null);
    }

    public ActorSettings withOnError(ErrorHandler handler) {
        return new ActorSettings(name, Objects.requireNonNull(handler, "handler"), supervision, mailbox);
    }

    public ActorSettings withSupervision(Supervision newSupervision) {
        return new ActorSettings(name, onError, newSupervision, mailbox);
    }

    public ActorSettings withMailbox(int capacity, MailboxBound.Overflow overflow) {
        return new ActorSettings(name, onError, supervision, new MailboxBound(capacity, overflow));
    }
}
