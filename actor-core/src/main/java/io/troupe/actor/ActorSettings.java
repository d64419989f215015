package io.troupe.actor;

import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Settings of an actor; immutable.
 *
 * {@snippet :
 * ActorSettings settings = ActorSettings.named("counter")
 *         .withSupervision(Supervision.restart(3, Duration.ofMinutes(1)))
 *         .withMailbox(1_000, Overflow.REJECT);
 * Counter counter = space.spawn(Counter.class, Counter::new, settings);
 * }
 *
 * @param name used in log and error messages; null = the type's simple name and a number
 * @param onError receives the exceptions of its one-way messages and timers; null = the space's handler receives them
 * @param supervision what happens to the actor after such an exception
 * @param mailbox the limit of queued calls; null = unlimited
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
