package io.troupe.player.wire;

/** Where a server delivers to; implemented by clients. Frames never overlap, and neither call blocks. */
public interface DataSink {
    /** On the thread that {@link PlayerServer#connect} says. */
    void frame(Frame frame);

    /** The server has gone; nothing follows. From any thread, any number of times. */
    void lost(String reason);
}
