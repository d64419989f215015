package io.troupe.player.wire;

import static io.troupe.player.wire.RemoteConnectionTest.connect;
import static io.troupe.player.wire.RemoteConnectionTest.is;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.time.ManualClock;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import java.io.InputStream;
import java.net.SocketTimeoutException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import java.util.logging.SimpleFormatter;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Servers that stay connected and do not send what a client waits for. */
@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class SilentServerTest implements PlayerConstants {
    private static final int SET_INTEGER_PROPERTY = 253;

    private final List<String> events = new ArrayList<>();
    private final ManualClock clock = new ManualClock();
    private Duration limit = Duration.ofSeconds(4);

    /**
     * Reads come from the list: a number of bytes, 0 for a time-out of one second, -1 for the end of the stream. The
     * limit is four seconds.
     */
    private RemoteReader.KeepAliveInput input(Integer... reads) {
        Queue<Integer> next = new ArrayDeque<>(List.of(reads));
        var in = new InputStream() {
            @Override
            public int read() {
                throw new AssertionError("byte by byte");
            }

            @Override
            public int read(byte[] bytes, int offset, int length) throws SocketTimeoutException {
                int count = next.remove();
                if (count == 0) {
                    clock.advance(Duration.ofSeconds(1));
                    throw new SocketTimeoutException();
                }
                events.add("read " + count);
                return count;
            }
        };
        return new RemoteReader.KeepAliveInput(
                in, clock, () -> limit, () -> events.add("ask"), () -> events.add("silent"));
    }

    @Test
    void input_asksAfterHalfOfTheLimit_andReportsSilenceAfterAll_once() throws Exception {
        var in = input(0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, -1);
        for (int expected : new int[] {1, 2, 3, -1}) {
            assertThat(in.read(new byte[8], 0, 8)).isEqualTo(expected);
        }
        assertThat(events).containsExactly("read 1", "ask", "read 2", "ask", "silent", "read 3", "read -1");
    }

    @Test
    void input_withoutALimit_isReadOnAndOn() throws Exception {
        limit = Duration.ZERO;
        assertThat(input(0, 0, 0, 0, 0, 0, 0, 0, 7).read(new byte[8], 0, 8)).isEqualTo(7);
        assertThat(events).containsExactly("read 7");
    }

    @Test
    void serverThatFallsSilent_endsTheWaiting_andIsStillSentCommands() throws Exception {
        var silent = new AtomicBoolean();
        try (var server = new ScriptedSocket((message, self) -> silent.get())) {
            var client = connect(server);
            var wheels = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            silent.set(true);
            client.setSilenceLimit(Duration.ofMillis(100));
            assertThatThrownBy(client::readAll)
                    .isInstanceOf(PlayerException.class)
                    .hasMessage(
                            "the Player server at localhost:" + server.port()
                                    + " is connected and silent: nothing has come from it for 100 ms, and no answer to a request");
            wheels.setSpeed(0, 0);
            assertThat(server.nextCommand().header().subtype()).isEqualTo(1);
            client.close();
        }
    }

    @Test
    void silenceLimit_ofLessThanTwoMilliseconds_isRefused() throws Exception {
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            assertThatThrownBy(() -> client.setSilenceLimit(Duration.ofMillis(1)))
                    .isInstanceOf(PlayerException.class)
                    .hasMessage("silence limit is PT0.001S, expected 2 ms or more, or zero for none");
            client.close();
        }
    }

    @Test
    void silenceLimit_beyondAllNanoseconds_isTaken_andEndsNothing() throws Exception {
        limit = Duration.ofSeconds(Long.MAX_VALUE);
        assertThat(input(0, 0, 0, 7).read(new byte[8], 0, 8)).isEqualTo(7);
        assertThat(events).containsExactly("read 7");
        try (var server = new ScriptedSocket((message, self) -> false)) {
            var client = connect(server);
            client.setSilenceLimit(limit);
            client.setReadTimeout(Long.MAX_VALUE);
            client.requestAddReplaceRule(-1, -1, 1, -1, 1);
            client.setSilenceLimit(Duration.ZERO);
            client.requestAddReplaceRule(-1, -1, 1, -1, 1);
            client.close();
        }
    }

    @Test
    void serverThatRefusesCommandLimits_isNamedInTheLogOnce_andObeysAsEver() throws Exception {
        List<String> said = new CopyOnWriteArrayList<>();
        Handler handler = new Handler() {
            @Override
            public void publish(LogRecord entry) {
                said.add(entry.getLevel() + " " + new SimpleFormatter().formatMessage(entry));
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        Logger log = Logger.getLogger(PlayerClient.class.getName());
        log.addHandler(handler);
        try (var server = new ScriptedSocket((message, self) -> {
            boolean limit = is(message, 4, SET_INTEGER_PROPERTY);
            if (limit) {
                self.send(self.reply(message, MessageType.NACK, Content.NONE));
            }
            return limit;
        })) {
            var client = connect(server);
            var wheels = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
            wheels.setCommandLimit(Duration.ofMillis(400));
            wheels.setCommandLimit(Duration.ofMillis(500));
            wheels.setSpeed(0.1, 0);
            assertThat(server.nextCommand().header().subtype()).isEqualTo(1);
            client.requestAddReplaceRule(-1, -1, 1, -1, 1); // waits for its reply, which comes after the refusals
            client.close();
        } finally {
            log.removeHandler(handler);
        }
        assertThat(said)
                .hasSize(1)
                .first()
                .asString()
                .startsWith("INFO")
                .contains("position2d:0", "the server decides");
    }
}
