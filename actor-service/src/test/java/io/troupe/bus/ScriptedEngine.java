package io.troupe.bus;

import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** An engine that keeps what its node sends, and to which a test gives what arrives. */
final class ScriptedEngine implements BusEngine {
    /** @param to a node, or a topic */
    record Sent(String how, String to, long number, byte[] frame) {}

    final List<Sent> sent = new ArrayList<>();
    final List<String> topics = new ArrayList<>();

    @Nullable
    RuntimeException failure;

    @Nullable
    Error replyError; // of the next reply

    @Nullable
    String why;

    int maxFrameBytes = 1_000;
    long incarnation;
    boolean closed;
    private @Nullable Listener listener;

    Listener listener() {
        return Objects.requireNonNull(listener);
    }

    /** The frames sent so far, as text; they are forgotten. */
    List<String> takeSent(String receiver) {
        var all = sent.stream()
                .map(each -> each.how + " " + each.to + ": "
                        + Frames.read(each.frame, receiver).body())
                .toList();
        sent.clear();
        return all;
    }

    @Override
    public void start(String node, long itsIncarnation, Listener itsListener) {
        incarnation = itsIncarnation;
        listener = itsListener;
        if (failure != null) {
            throw failure;
        }
    }

    @Override
    public @Nullable String whyDisconnected() {
        return why;
    }

    @Override
    public int maxFrameBytes() {
        return maxFrameBytes;
    }

    private void keep(Sent frame) {
        if (failure != null) {
            throw failure;
        }
        sent.add(frame);
    }

    @Override
    public void send(String node, long number, byte[] frame) {
        keep(new Sent("send", node, number, frame));
    }

    @Override
    public void reply(String node, long toIncarnation, long number, byte[] frame) {
        Error thrown = replyError;
        replyError = null;
        if (thrown != null) {
            throw thrown;
        }
        keep(new Sent("reply", node, number, frame));
    }

    @Override
    public void publish(String topic, byte[] frame) {
        keep(new Sent("publish", topic, 0, frame));
    }

    @Override
    public void subscribe(String topic) {
        topics.add("+" + topic);
    }

    @Override
    public void unsubscribe(String topic) {
        topics.add("-" + topic);
    }

    @Override
    public void close() {
        closed = true;
    }
}
