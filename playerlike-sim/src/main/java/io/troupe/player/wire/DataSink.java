package io.troupe.player.wire;

/** Receives what a server publishes; implemented by clients. Frames never overlap, and neither method may block. */
public interface DataSink {
    /** Receives a frame, on the thread that {@link PlayerServer#connect} specifies. */
    void frame(Frame frame);

    /** The connection to the server is lost and no frame follows. Called from any thread, any number of times. */
    void lost(String reason);
}
