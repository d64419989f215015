package io.troupe.demo.evaluate;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.Simulation;
import java.net.InetAddress;
import java.net.Socket;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The world of a JVM that measures. */
class PaperWorldTest {
    private static final PaperWorld WORLD = PaperWorld.read(Path.of("worlds", "paper-arena.cfg"));
    private static final double WORLD_SECONDS = 0.5;
    private static final int HEADER_BYTES = 40;
    private static final int ACCESS = 3;
    private static final int NEXT_DATA = 4;
    private static final int DATA_MODE = 5;
    private static final int PULL = 2;

    private static String robots(long seed) {
        try (var simulation = Simulation.open(WORLD.scenario(), PaperWorld.settings(seed))) {
            return simulation.tick().robots().toString();
        }
    }

    @Test
    void seed_movesTheStartPoses() {
        assertThat(robots(1)).isEqualTo(robots(1)).isNotEqualTo(robots(2));
    }

    /** A request to the Player device, encoded as in Player's clients. */
    private static byte[] request(int subtype, int... payload) {
        int bytes = Integer.BYTES * payload.length;
        // host, robot, interface, index, message type, subtype, time (two words), sequence number, length
        var header = IntStream.of(0, 0, 1, 0, 3, subtype, 0, 0, 0, bytes);
        var request = ByteBuffer.allocate(HEADER_BYTES + bytes);
        IntStream.concat(header, IntStream.of(payload)).forEach(request::putInt);
        return request.array();
    }

    @Test
    @Timeout(60)
    void clientThatNeverAnswers_isGreetedAsByPlayer_andTheWorldGoesOnInRealTime() throws Exception {
        var passed = new CountDownLatch(1);
        try (var server = WORLD.serve(1, seconds -> {
                    if (seconds >= WORLD_SECONDS) {
                        passed.countDown();
                    }
                });
                var client = new Socket(InetAddress.getLoopbackAddress(), server.port())) {
            client.setSoTimeout(30_000);
            String banner = new String(client.getInputStream().readNBytes(32), StandardCharsets.US_ASCII);
            assertThat(banner).hasSize(32).startsWith("Player v.").endsWith("\0");
            long beganNanos = System.nanoTime();
            var out = client.getOutputStream();
            out.write(request(DATA_MODE, PULL)); // in lock step the world would wait for such a client
            out.write(request(ACCESS, 0, 0, 4, 0, 1, 0, 0)); // opens position2d:0
            out.write(request(NEXT_DATA)); // only once
            assertThat(passed.await(40, TimeUnit.SECONDS))
                    .as("the world has gone on to %s s without an answer", WORLD_SECONDS)
                    .isTrue();
            assertThat((System.nanoTime() - beganNanos) / 1e9)
                    .as("seconds on the wall, not fewer than in the world")
                    .isGreaterThanOrEqualTo(WORLD_SECONDS);
        }
    }
}
