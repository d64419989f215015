package io.troupe.actor;

import java.time.Duration;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * Observes the calls of actors, and their turns, in the spaces that have it in their settings.
 *
 * {@snippet :
 * var observer = new CallObserver() {
 *     @Override
 *     public void called(Party from, Party to, Call call) {
 *         seen.add(from.name() + " calls " + to.name() + "." + call.method());
 *     }
 * };
 * ActorSpace space = ActorSpace.create(SpaceSettings.named("shop").withCallObserver(observer));
 * }
 *
 * <p><b>Role.</b> {@link CallGraph} is one that counts.
 *
 * <p><b>Threads.</b> The thread on which it happens: the caller's, or that of the actor's space. It must not block.
 *
 * <p><b>Order.</b> A call is observed before it is in the mailbox, then when it leaves the mailbox, then when its
 * promise is settled.
 *
 * <p><b>Cost.</b> Each call in such a space is wrapped, like a call with a {@link TurnContext}; none in other spaces.
 *
 * <p><b>Errors.</b> An exception is reported to the error handler of the space, and has no effect on the call.
 */
public interface CallObserver {
    /**
     * A caller or a receiver; equal for all events of one space that have this name and number. Those of two spaces
     * differ, also if the spaces have one name.
     */
    interface Party {
        /** The name of its space; empty for threads that belong to none. */
        String space();

        /**
         * Of an actor as in {@link ActorSettings}, or the simple name of its type; or {@link CallGraph#OUTSIDE} or
         * {@link CallGraph#TASKS}.
         */
        String name();

        /** Of an actor without a name, which no other actor of its space has; otherwise 0. */
        int number();

        /** The name; of an actor without a name, as in other texts, with its number: {@code Counter#2}. */
        @Override
        String toString();
    }

    /** A call of an actor; equal for all events of one call. */
    interface Call {
        /** The type under which the actor was spawned. */
        Class<?> type();

        /** The method's name. */
        String method();

        /** The arguments; callbacks as the actor sees them. */
        List<@Nullable Object> arguments();

        /** True if its caller gets a promise; false for a one-way message. */
        boolean isRequest();

        /** True if its receiver is a connection to a service, which makes the same call of the provider. */
        boolean isPassedOn();

        /**
         * Calls back with the error, or null, when the promise of the request is settled, on the thread that settles
         * it; never for a one-way message.
         */
        void whenSettled(Consumer<@Nullable Throwable> callback);
    }

    /** A turn that has begun. */
    interface Turn {
        /** A turn whose end is not observed. */
        Turn NONE = () -> {};

        void end();
    }

    /** A message or a request is sent. It may still be refused by a full mailbox. */
    default void called(Party from, Party to, Call call) {}

    /** The actor begins a call; what it does then {@linkplain #servedCall serves} this same object. */
    default void begun(Party actor, Call call) {}

    /** A call has left the mailbox, and will not begin: it was refused or cancelled, or the actor has stopped. */
    default void dropped(Party actor, Call call) {}

    /** The actor holds its calls back: see {@link ActorContext#hold}. */
    default void held(Party actor) {}

    /** The actor takes its calls again, or the instance that held them has ended. */
    default void released(Party actor) {}

    /** A result is sent to a callback, which {@code to} had passed as an argument. */
    default void returned(Party from, Party to) {}

    /**
     * A turn begins: a call, a listener, a timer or a result of a callback.
     *
     * @param stallLimit as in the settings of the space; null = no limit
     */
    default Turn turnBegun(Party party, @Nullable Duration stallLimit) {
        return Turn.NONE;
    }

    /**
     * The observed call that the calling thread serves: in the turn of the call, in the listeners that it registers
     * there, and in its sequential bodies and suspend functions; null elsewhere, also in timers. In {@link #called}, it
     * is the call whose actor makes the new one.
     */
    static @Nullable Call servedCall() {
        return ObservedCalls.served();
    }

    /** Both observe, this one first, each whatever the other one throws. */
    default CallObserver and(CallObserver other) {
        return new ObservedCalls.Both(this, other);
    }
}
