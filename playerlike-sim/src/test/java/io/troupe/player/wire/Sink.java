package io.troupe.player.wire;

import java.util.function.Consumer;

/** A sink made of two lambdas. */
record Sink(Consumer<Frame> onFrame, Consumer<String> onLoss) implements DataSink {
    /** Ignores everything. */
    static final Sink NONE = new Sink(frame -> {}, reason -> {});

    @Override
    public void frame(Frame frame) {
        onFrame.accept(frame);
    }

    @Override
    public void lost(String reason) {
        onLoss.accept(reason);
    }
}
