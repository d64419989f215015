package io.troupe.actor;

/**
 * The thread of a space that is not cranked by hand. It knows the rings of its space.
 *
 * <p>That is for speed: the processor can begin to serve one message while it is still at work on the one before, but
 * not if where the next one is to be stored depends on a long way through the objects of this one. From the thread the
 * way is short, and the same for all messages.
 */
final class SpaceThread extends Thread {
    private final SpaceHome space;
    private final NodeRing callbacks;
    private final NodeRing mails;
    private final SpaceLoop loop;

    SpaceThread(SpaceHome space, NodeRing callbacks, NodeRing mails, SpaceLoop loop) {
        super(null, null, space.toString(), 0, false);
        this.space = space;
        this.loop = loop;
        this.callbacks = callbacks;
        this.mails = mails;
        setDaemon(true);
    }

    boolean serves(SpaceHome which) {
        return space == which;
    }

    NodeRing callbacks() {
        return callbacks;
    }

    NodeRing mails() {
        return mails;
    }

    @Override
    public void run() {
        loop.live();
    }
}
