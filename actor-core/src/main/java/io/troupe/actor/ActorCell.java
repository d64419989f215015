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
    private final String name;
    private final Supplier<?> factory;
    private final ActorSettings settings;
    private final Deferred<@Nullable Void> ended;
    private final @Nullable BoundedMailbox mailbox;
    private @Nullable Object implementation;
    private @Nullable Object proxy;
    private @Nullable FailureCount failures;
    private Life life = new Life(this);
    private boolean stopped;

    ActorCell(ActorSpace space, String name, Supplier<?> factory, ActorSettings settings) {
        this.space = space;
        this.name = name;
        this.factory = factory;
        this.settings = settings;
        this.ended = new Deferred<>(space);
        MailboxBound bound = settings.mailbox();
        this.mailbox = bound == null ? null : new BoundedMailbox(bound);
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Message message) {
        if (mailbox != null && !mailbox.admit(message, this)) {
            drop(message, mailbox.reason());
        } else {
            space.enqueue(message);
        }
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Request<?> request) {
        request.noteAsker(space.isCurrent());
        if (mailbox != null && !mailbox.admit(request, this)) {
            drop(request, mailbox.reason());
        } else {
            space.enqueue(request);
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

    /** Fulfilled when the actor has stopped. */
    Promise<@Nullable Void> ended() {
        return ended;
    }

    /** Makes the implementation; before the first message, on the space's thread. */
    void start() {
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
        stopped = true;
        space.actors().remove(this);
        endLife();
        ended.resolve(null);
    }

    /** The end of one instance. */
    private void endLife() {
        if (implementation instanceof Actor actor) {
            guard("stopped()", actor::stopped);
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
        start();
    }

    /** Turns a call away that found no room, or had to make room. Any thread. */
    void drop(Node call, String reason) {
        if (call instanceof Request<?> request) {
            request.reject(new MailboxFullException(request + " was not begun: " + reason));
        } else {
            space.deadLetter(this, call.toString(), reason);
        }
    }

    void deliver(Message message) {
        if (mailbox != null && !mailbox.leave(message)) {
            return; // dropped while it waited
        }
        Object target = implementation;
        if (target == null) {
            space.deadLetter(this, message.toString(), space.whyStopped(this));
            return;
        }
        ActorCell before = space.enter(this);
        try {
            message.invoke(target);
        } catch (Throwable thrown) {
            failed(message.method(), thrown);
        } finally {
            space.leave(before);
        }
    }

    void deliver(Request<?> request) {
        if (mailbox != null && !mailbox.leave(request) || request.isDone()) {
            return; // dropped or cancelled while it waited
        }
        Object target = implementation;
        if (target == null) {
            refuse(request);
            return;
        }
        ActorCell before = space.enter(this);
        try {
            request.answer(target);
        } finally {
            space.leave(before);
        }
    }

    /** Answers a request that nobody will handle. */
    void refuse(Request<?> request) {
        String reason = space.whyStopped(this);
        request.reject(new ActorStoppedException(request + " was not begun: " + reason));
    }

    /** Runs something on behalf of this actor; what it throws is a failure of the actor. */
    void guard(String what, Runnable action) {
        ActorCell before = space.enter(this);
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        } finally {
            space.leave(before);
        }
    }

    /** After the failing code has returned, so that nothing of the old instance is on the stack when a new one begins. */
    private void failed(String what, Throwable thrown) {
        space.report(what + " of " + this, thrown, settings.onError());
        if (stopped) {
            return;
        }
        if (failures == null) {
            failures = new FailureCount(settings.supervision());
        }
        switch (failures.note(space.clock().nanos())) {
            case RESUME -> {}
            case STOP -> space.runNext(this::stop);
            case RESTART -> space.runNext(this::restart);
        }
    }

    @Override
    public String toString() {
        return name;
    }
}
