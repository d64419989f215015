package io.troupe.actor;

import io.troupe.actor.internal.loop.DetachedEntries;
import org.jspecify.annotations.Nullable;

/**
 * The thread of a space, unless it has none. It holds references to the rings of its space.
 *
 * <p>This is for speed. The processor can begin with one message while it is still executing the one before, unless the
 * address for the next entry depends on a long chain of loads through the current message. From the thread the chain is
 * short, and the same for all messages.
 */
final class SpaceThread extends Thread implements DetachedEntries.Keeper {
    private final @Nullable SpaceHome space; // null if every call needs a context
    private @Nullable SpaceHome direct; // null if calls need a context or a mark now
    private boolean hasLimit;
    private int handlers; // see HandlerTurn
    private final EntryRing callbacks;
    private final EntryRing messages;
    private final SpaceLoop loop;
    private final DetachedEntries detachedNodes = new DetachedEntries();

    /**
     * Creates the thread.
     *
     * @param isDirect whether calls go straight into the rings; false if they need a context, or are observed
     */
    SpaceThread(SpaceHome space, boolean isDirect, EntryRing callbacks, EntryRing messages, SpaceLoop loop) {
        super(null, null, space.toString(), 0, false);
        setContextClassLoader(space.contextClassLoader());
        this.space = isDirect ? space : null;
        this.direct = this.space;
        this.loop = loop;
        this.callbacks = callbacks;
        this.messages = messages;
        setDaemon(true);
    }

    /** True if calls and callbacks of this thread for that space go straight into the rings. */
    boolean serves(SpaceHome which) {
        return direct == which;
    }

    /** True if no call of this thread needs a context or a mark now. */
    boolean isDirect() {
        return direct != null;
    }

    /** Sets whether the current turn has a time limit, which its calls carry. */
    void setHasLimit(boolean has) {
        hasLimit = has;
        direct = has || handlers != 0 ? null : space;
    }

    /** The handlers that run on this thread; see {@link HandlerTurn}. */
    int handlers() {
        return handlers;
    }

    /** Sets the handlers that run on this thread, with which its calls are marked. */
    void setHandlers(int now) {
        handlers = now;
        direct = hasLimit || now != 0 ? null : space;
    }

    EntryRing callbacks() {
        return callbacks;
    }

    EntryRing messages() {
        return messages;
    }

    @Override
    public DetachedEntries detachedNodes() {
        return detachedNodes;
    }

    @Override
    public void run() {
        loop.run();
    }
}
