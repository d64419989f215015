package io.troupe.actor;

import java.util.Objects;
import org.jspecify.annotations.Nullable;

/**
 * Base class of an actor that needs its {@link #context}, or that is called by its class instead of an interface
 * ({@code class Demo3 extends Actor}).
 *
 * <p><b>Role.</b> Optional: any object can be the implementation of an actor interface. Created by the factory passed
 * to {@link ActorSpace#spawn}; the public methods that return {@code void} or {@link Promise} are its messages.
 *
 * {@snippet :
 * class Heater extends Actor {
 *     private int degrees = 18;
 *
 *     @Override
 *     protected void started() {
 *         context().every(Duration.ofMinutes(1), () -> degrees++);
 *     }
 *
 *     public void set(int newDegrees) {
 *         degrees = newDegrees;
 *     }
 *
 *     public Promise<Integer> degrees() {
 *         return Promise.of(degrees);
 *     }
 * }
 *
 * Heater heater = space.spawn(Heater.class, Heater::new); // a proxy
 * heater.set(20); // a message
 * }
 *
 * <p>It takes few names away from messages: {@link #self}, {@link #context}, and those of the hooks {@link #started}
 * and {@link #stopped}, which an actor overrides. An actor type whose messages include {@code started()} or
 * {@code stopped()} is refused with an {@link ActorTypeException}, since one method would be both: a class at
 * {@code spawn}, an interface when its implementation turns out to extend this class, which ends the actor as does any
 * factory that fails. (With parameters both are names like others.)
 *
 * <p><b>Threads.</b> The space's thread; {@link #self} throws {@link IllegalStateException} on another one.
 *
 * <p><b>Source.</b> Paper, Figures 17 and 20.
 */
public abstract class Actor {
    private @Nullable ActorContext context;

    protected Actor() {}

    /** Makes this object the instance of an actor, before anything of it is started. */
    final void join(ActorCell mine) {
        if (context == null) {
            context = new ActorContext(mine.life());
        } else if (context.cell() == mine) {
            context.begin(mine.life());
        } else {
            throw new ActorException("the factory of " + mine + " returned an object that is the actor "
                    + context.cell() + " already, expected a separate one");
        }
    }

    /**
     * The proxy of this actor: pass it to others, and call it to send this actor a message that is processed in a later
     * turn. (A call on {@code this} runs immediately.)
     *
     * <p><b>Order.</b> The message is queued behind those that this actor has sent itself before. The order relative to
     * messages of other senders is not defined.
     */
    @SuppressWarnings("unchecked") // the caller names the type with which it spawned this actor
    protected final <A> A self() {
        ActorCell cell = joined("self()").cell();
        cell.space().checkCurrent("self()");
        return (A) Objects.requireNonNull(cell.proxy());
    }

    /**
     * What this actor may do beside answering: its space, its timers, its end.
     *
     * @throws IllegalStateException before {@link #started}
     */
    protected final ActorContext context() {
        return joined("context()");
    }

    /** Called before the first message. */
    protected void started() {}

    /**
     * Called after the last message, but not if the constructor threw. Requests that are still open after it are
     * rejected.
     */
    protected void stopped() {}

    private ActorContext joined(String call) {
        ActorContext mine = context;
        if (mine == null) {
            throw new IllegalStateException(
                    call + " of " + getClass().getName()
                            + " is for a spawned actor itself, from started() on: not for its constructor, and not through its proxy");
        }
        return mine;
    }
}
