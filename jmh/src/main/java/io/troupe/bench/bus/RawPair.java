package io.troupe.bench.bus;

import io.nats.client.Connection;
import io.nats.client.Dispatcher;
import io.nats.client.Message;
import io.nats.client.Nats;
import io.nats.client.Options;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.function.BooleanSupplier;

/** Two connections of the NATS client with its defaults, which send the bytes of our frames. */
final class RawPair implements BusPair {
    private static final Duration LIMIT = Duration.ofSeconds(60);
    private static final String ECHO = "raw.echo.";
    private static final String SONAR = "raw.robot1.sonar";

    private final PassingWindow window = new PassingWindow();
    private final Map<Integer, LoopEngine.Sample> frames = new HashMap<>();
    private final Connection near;
    private final Connection far;

    RawPair(String server) throws Exception {
        far = Nats.connect(Options.builder().server(server).build());
        Dispatcher requests = far.createDispatcher();
        for (BusWorkload each : BusWorkload.Part.ASK.workloads()) {
            int payloadBytes = each.payloadBytes();
            var sample = LoopEngine.Sample.of(payloadBytes);
            frames.put(payloadBytes, sample);
            requests.subscribe(ECHO + payloadBytes, request -> far.publish(request.getReplyTo(), sample.reply()));
        }
        Dispatcher publications = far.createDispatcher();
        publications.setPendingLimits(2L * PassingWindow.SIZE, 64L << 20);
        publications.subscribe(SONAR, record -> window.received());
        far.flush(LIMIT);
        near = Nats.connect(Options.builder().server(server).build());
    }

    private LoopEngine.Sample frames(int payloadBytes) {
        var known = frames.get(payloadBytes);
        if (known == null) {
            throw new IllegalArgumentException(
                    "a request has " + payloadBytes + " bytes, expected one of " + frames.keySet());
        }
        return known;
    }

    @Override
    public void askWhile(int payloadBytes, BooleanSupplier again) throws InterruptedException {
        var sample = frames(payloadBytes);
        String subject = ECHO + payloadBytes;
        do {
            Message reply = near.request(subject, sample.request(), LIMIT);
            if (reply == null || reply.getData().length != sample.reply().length) {
                throw new IllegalStateException(
                        "the reply is " + reply + ", expected one of " + sample.reply().length + " bytes");
            }
        } while (again.getAsBoolean());
    }

    @Override
    public void publishAll() throws InterruptedException {
        byte[] record = frames(64).publication();
        for (int i = 0; i < RECORDS; i++) {
            if (i % PassingWindow.GROUP == 0) {
                window.awaitGroup();
            }
            near.publish(SONAR, record);
        }
        window.awaitAll();
    }

    @Override
    public void close() {
        try {
            near.close();
            far.close();
        } catch (InterruptedException interrupted) {
            Thread.currentThread().interrupt();
        }
    }
}
