package io.troupe.actor;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Promise;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * An actor as its space sees it: where its messages go and who handles them. For generated code.
 *
 * <p><b>Threads.</b> {@link #send} from any thread, everything else on the space's.
 */
public final class ActorCell {
    private final ActorSpace space;
    private final Class<?> type;
    private final int number;
    private final Supplier<?> factory;
    private final ActorSettings settings;
    private final @Nullable BoundedMailbox mailbox;
    private @Nullable Object implementation;
    private @Nullable Object proxy;
    private @Nullable FailureCount failures;
    private @Nullable Deferred<@Nullable Void> ended; // guarded by this, as is stopped for other threads
    private Life life;
    private boolean begun;
    private boolean stopped;

    @Nullable
    ActorCell before;

    @Nullable
    ActorCell after;

    /**
     * An actor that has not started.
     *
     * @param type what it is called by if it has no name of its own
     * @param number tells it from others of its type then
     */
    ActorCell(ActorSpace space, Class<?> type, int number, Supplier<?> factory, ActorSettings settings) {
        this.space = space;
        this.type = type;
        this.life = new Life(this);
        this.number = number;
        this.factory = factory;
        this.settings = settings;
        MailboxBound bound = settings.mailbox();
        this.mailbox = bound == null ? null : new BoundedMailbox(bound);
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Message message) {
        if (mailbox != null) {
            sendBounded(message, mailbox);
        } else if (Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            thread.mails().add(message);
        } else {
            space.enqueueMail(message);
        }
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Request<?> request) {
        if (mailbox == null && Thread.currentThread() instanceof SpaceThread thread && thread.serves(space)) {
            request.noteAsker(true);
            thread.mails().add(request);
        } else {
            sendSlowly(request);
        }
    }

    /** From another thread, from one that cranks or has borrowed the space, or to a mailbox that may be full. */
    private void sendSlowly(Request<?> request) {
        request.noteAsker(space.isCurrent());
        if (mailbox != null) {
            sendBounded(request, mailbox);
        } else {
            space.enqueueMail(request);
        }
    }

    private void sendBounded(Node call, BoundedMailbox bounded) {
        switch (bounded.admit(call, this)) {
            case QUEUED -> space.enqueueMail(call);
            case TAKEN_IN -> {}
            case REFUSED -> drop(call, bounded.reason());
        }
    }

    /** A callback argument as the actor gets it: what it sends comes back to the caller's callback queue. */
    public <T extends @Nullable Object> @Nullable Callback<T> returning(@Nullable Callback<T> callback) {
        return ReturningCallback.wrap(callback, space);
    }

    /** Identity, for the {@code equals} of a proxy. */
    public static boolean same(Object first, @Nullable Object second) {
        return first == second;
    }

    ActorSpace space() {
        return space;
    }

    void bind(Object newProxy) {
        proxy = newProxy;
    }

    @Nullable
    Object proxy() {
        return proxy;
    }

    Life life() {
        return life;
    }

    /** Fulfilled when the actor has stopped. Any thread. */
    synchronized Promise<@Nullable Void> ended() {
        if (ended == null) {
            if (stopped) {
                return Promise.done();
            }
            ended = new Deferred<>(space);
        }
        return ended;
    }

    /** The entry that spawning has queued: starts the actor, unless a call that came another way has done so, or it was stopped before. */
    void start() {
        if (!begun && !stopped && !space.isStopping()) {
            startInstance();
        }
    }

    private void startInstance() {
        begun = true;
        space.actors().add(this);
        guard("the start", this::begin);
        if (implementation == null) {
            stop();
        }
    }

    private void begin() {
        Object made = factory.get();
        if (made == null) {
            throw new ActorException("the factory of " + this + " answered null, expected its implementation");
        }
        if (made instanceof ActorProxy) {
            throw new ActorException("the factory of " + this + " answered a proxy, expected a new implementation");
        }
        implementation = made;
        if (made instanceof Actor actor) {
            actor.join(this);
            actor.started();
        }
    }

    void stop() {
        if (stopped) {
            return;
        }
        space.actors().remove(this);
        Deferred<@Nullable Void> watched;
        synchronized (this) {
            stopped = true;
            watched = ended;
        }
        endLife();
        if (watched != null) {
            watched.resolve(null);
        }
    }

    /** The end of one instance. */
    private void endLife() {
        if (implementation instanceof Actor actor) {
            space.beginTurnOf(life);
            try {
                actor.stopped();
            } catch (Throwable thrown) { // reported, and no failure of the instance that comes next
                space.reports().error("stopped() of " + this, thrown, settings.onError());
            }
        }
        implementation = null;
        life.end();
    }

    private void restart() {
        if (stopped) {
            return;
        }
        endLife();
        life = new Life(this);
        startInstance();
    }

    /** Turns a call away that found no room, or had to make room. Any thread. */
    void drop(Node call, String reason) {
        space.reports().turnAway(call, this, reason, new MailboxFullException(call + " was not begun: " + reason));
    }

    /** Begins the turn of a one-way call: the implementation that is to handle it, or null if nobody is, or has done so. */
    @Nullable
    Object target(Message message) {
        Object target = implementation;
        if (target == null || mailbox != null) {
            deliverNext(message);
            return null;
        }
        space.beginTurnOf(life);
        return target;
    }

    /** Begins the turn of a request: the implementation that is to handle it, or null if nobody is, or has done so. */
    @Nullable
    Object target(Request<?> request) {
        Object target = implementation;
        if (target == null || mailbox != null || request.isDone()) {
            deliverNext(request);
            return null;
        }
        space.beginTurnOf(life);
        return target;
    }

    /** The slower way: of a call that may be another's ticket, may have been cancelled, or may find nobody. */
    private void deliverNext(Node ticket) {
        start();
        Node call = mailbox == null ? ticket : mailbox.next(ticket);
        Object target = implementation;
        if (call instanceof Request<?> request && request.isDone()) {
            space.reports().skip(request); // cancelled while it waited
        } else if (target == null) {
            refuse(call);
        } else {
            space.beginTurnOf(life);
            try {
                if (call instanceof Message message) {
                    message.invoke(target);
                } else {
                    ask((Request<?>) call, target);
                }
            } catch (Throwable thrown) {
                space.fail(call, thrown); // the call's own failure, though another was its ticket
            }
        }
    }

    private static <T extends @Nullable Object> void ask(Request<T> request, Object target) throws Throwable {
        request.answer(request.invoke(target));
    }

    /** The call that would be served with this ticket. */
    Node callOf(Node ticket) {
        return mailbox == null ? ticket : mailbox.peek(ticket);
    }

    /** How many calls wait before this one in a mailbox that keeps them itself, or -1 if it is not among the first so many. */
    int placeInMailbox(Node call, int limit) {
        return mailbox == null ? -1 : mailbox.placeOf(call, limit);
    }

    private void refuse(Node call) {
        String reason = space.isStopping() ? "space " + space + " is closed" : "the actor " + this + " has stopped";
        space.reports().turnAway(call, this, reason, new ActorStoppedException(call + " was not begun: " + reason));
    }

    /** Runs something on behalf of this actor; what it throws is a failure of the actor. */
    void guard(String what, Runnable action) {
        space.beginTurnOf(life);
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        }
    }

    /** What the failure leads to comes when the failing turn has returned, and before anything else. */
    void failed(String what, Throwable thrown) {
        space.reports().error(what + " of " + this, thrown, settings.onError());
        if (stopped) {
            return;
        }
        if (failures == null) {
            failures = new FailureCount(settings.supervision());
        }
        switch (failures.note(space.clock().nanos())) {
            case RESUME -> {}
            case STOP -> space.afterTurn(this::stop);
            case RESTART -> space.afterTurn(this::restart);
        }
    }

    @Override
    public String toString() {
        String name = settings.name();
        return name != null ? name : type.getSimpleName() + "#" + number;
    }
}
