package io.troupe.player.wire;

import io.troupe.actor.ActorSpace;
import org.jspecify.annotations.Nullable;

/** A Player server as seen by its clients, in this JVM or over a socket. */
public interface PlayerServer {
    /** The greeting of the server, at most 31 characters. */
    String banner();

    /**
     * Connects a client.
     *
     * @param sink receives the published frames; called on the thread of {@code space} if one is given, else on a
     *     thread of the server
     * @param space the actor space of the client, or null. All clients of one space receive the frames of a tick in one
     *     turn, in the order in which they connected. They have answered the tick when that space has no more work
     */
    PlayerConnection connect(DataSink sink, @Nullable ActorSpace space);
}
