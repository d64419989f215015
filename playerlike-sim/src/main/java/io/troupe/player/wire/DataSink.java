package io.troupe.player.wire;

/** Where a server delivers to; implemented by clients. Calls never overlap and must not block. */
public interface DataSink {
    void frame(Frame frame);

    /** The server has gone; nothing follows. */
    void lost(String reason);
}
