package io.troupe.actor;

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
    private @Nullable Object implementation;
    private @Nullable Object proxy;
    private boolean stopped;

    ActorCell(ActorSpace space, String name, Supplier<?> factory, ActorSettings settings) {
        this.space = space;
        this.name = name;
        this.factory = factory;
        this.settings = settings;
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Message message) {
        space.enqueue(message);
    }

    /** Puts a call into the actor's mailbox. */
    public void send(Request<?> request) {
        request.noteAsker(space.isCurrent());
        space.enqueue(request);
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

    boolean isStopped() {
        return stopped;
    }

    /** Makes the implementation; before the first message, on the space's thread. */
    void start() {
        guard("the start", () -> {
            Object made = factory.get();
            if (made == null) {
                throw new ActorException("the factory of " + this + " answered null, expected its implementation");
            }
            if (made instanceof ActorProxy) {
                throw new ActorException("the factory of " + this + " answered a proxy, expected a new implementation");
            }
            implementation = made;
            space.actors().add(this);
            if (made instanceof Actor actor) {
                actor.join(this);
                actor.started();
            }
        });
        if (implementation == null) {
            stopped = true;
        }
    }

    void stop() {
        if (stopped) {
            return;
        }
        stopped = true;
        space.actors().remove(this);
        if (implementation instanceof Actor actor) {
            guard("stopped()", actor::stopped);
        }
        implementation = null;
    }

    void deliver(Message message) {
        Object target = implementation;
        if (target == null) {
            space.deadLetter(this, message.toString());
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
        if (request.isDone()) {
            return; // cancelled while it waited
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

    /** Runs something on behalf of this actor, unless it is stopped; false if it is. */
    boolean run(String what, Runnable action) {
        if (stopped) {
            return false;
        }
        guard(what, action);
        return true;
    }

    private void guard(String what, Runnable action) {
        ActorCell before = space.enter(this);
        try {
            action.run();
        } catch (Throwable thrown) {
            failed(what, thrown);
        } finally {
            space.leave(before);
        }
    }

    private void failed(String what, Throwable thrown) {
        space.report(what + " of " + this, thrown, settings.onError());
    }

    @Override
    public String toString() {
        return name;
    }
}
