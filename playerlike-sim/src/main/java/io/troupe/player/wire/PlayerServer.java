package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import org.jspecify.annotations.Nullable;

/** A Player server as its clients see it, in this JVM or behind a socket. */
public interface PlayerServer {
    /** The 31 characters at most by which the server greets. */
    String banner();

    /**
     * Connects a client.
     *
     * @param sink receives what the devices publish; called on {@code space}'s thread if one is given, else on the
     *     server's
     * @param space the actor space the client lives on, or null. All clients of one space receive a tick's frames in
     *     one turn of it, in the order in which they connected, and have answered the tick when nothing is left to do
     *     in that space
     */
    PlayerConnection connect(DataSink sink, @Nullable ActorSpace space);
}
