package io.troupe.actor;

import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Settings of an actor.
 *
 * {@snippet :
 * ActorSettings settings = ActorSettings.named("counter")
 *         .withSupervision(Supervision.restart(3, Duration.ofMinutes(1)))
 *         .withMailbox(1_000, Overflow.REJECT);
 * Counter counter = space.spawn(Counter.class, Counter::new, settings);
 * }
 */
public final class ActorSettings extends Settings<ActorSettings> {
    /** What happens to a call when the mailbox is full. */
    public enum Overflow {
        /**
         * The new request is rejected with {@link MailboxFullException}; a new one-way message becomes a dead letter.
         */
        REJECT,
        /**
         * A caller outside every actor space waits for room; if it is interrupted, the call is rejected as by
         * {@link #REJECT}. A caller on the thread of a space must not wait, and its call is treated as by
         * {@link #REJECT}. The same holds for every caller of an actor in a space without a thread, where no other
         * thread would make room.
         */
        BLOCK,
        /** The oldest queued call is rejected, or becomes a dead letter, to make room. */
        DROP_OLDEST
    }

    private static final ActorSettings DEFAULTS = new ActorSettings();

    private @Nullable String name;
    private @Nullable ErrorHandler onError;
    private Supervision supervision = Supervision.RESUME;
    private @Nullable Integer mailboxCapacity;
    private Overflow overflow = Overflow.REJECT;

    private ActorSettings() {}

    /** No name, errors to the space's handler, {@link Supervision#RESUME}, and a mailbox without a limit. */
    public static ActorSettings defaults() {
        return DEFAULTS;
    }

    /** Default settings with a name. */
    public static ActorSettings named(String name) {
        return DEFAULTS.withName(name);
    }

    @Override
    protected void check() {
        if (mailboxCapacity != null && mailboxCapacity < 1) {
            throw new IllegalArgumentException("the capacity of the mailbox is " + mailboxCapacity
                    + ", expected 1 or more, or withoutMailboxLimit()");
        }
    }

    /** Used in log and error messages; by default the type's simple name and a number. */
    public ActorSettings withName(String newName) {
        Objects.requireNonNull(newName, "name");
        return with(copy -> copy.name = newName);
    }

    /** Receives the exceptions of its one-way messages and timers; by default the space's handler receives them. */
    public ActorSettings withOnError(ErrorHandler handler) {
        Objects.requireNonNull(handler, "handler");
        return with(copy -> copy.onError = handler);
    }

    /** What happens to the actor after such an exception; by default it resumes. */
    public ActorSettings withSupervision(Supervision newSupervision) {
        Objects.requireNonNull(newSupervision, "supervision");
        return with(copy -> copy.supervision = newSupervision);
    }

    /**
     * Bounds the mailbox. A cancelled request occupies its place until its turn, because it stays in the queue until
     * then: cancelling cannot make a bounded mailbox grow.
     *
     * {@snippet :
     * ActorSettings newestOnly = ActorSettings.named("printer").withMailbox(1, Overflow.DROP_OLDEST);
     * Printer printer = space.spawn(Printer.class, () -> log::add, newestOnly);
     * printer.print("first");
     * printer.print("second"); // takes the place of the first, which becomes a dead letter
     * }
     *
     * @param capacity the number of calls that may be queued
     * @param newOverflow what happens to a call when the mailbox is full
     */
    public ActorSettings withMailbox(int capacity, Overflow newOverflow) {
        Objects.requireNonNull(newOverflow, "overflow");
        return with(copy -> {
            copy.mailboxCapacity = capacity;
            copy.overflow = newOverflow;
        });
    }

    /** Any number of calls may be queued; the default. */
    public ActorSettings withoutMailboxLimit() {
        return with(copy -> copy.mailboxCapacity = null);
    }

    public @Nullable String name() {
        return name;
    }

    public @Nullable ErrorHandler onError() {
        return onError;
    }

    public Supervision supervision() {
        return supervision;
    }

    /** See {@link #withMailbox}; null = no limit. */
    public @Nullable Integer mailboxCapacity() {
        return mailboxCapacity;
    }

    /** See {@link #withMailbox}; it counts only if there is a capacity. */
    public Overflow overflow() {
        return overflow;
    }
}
