package io.troupe.view.tools;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.view.tools.FoxgloveConnection.Events;
import io.troupe.view.tools.FoxgloveConnection.Frame;
import java.io.ByteArrayOutputStream;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** The end of a connection; FoxgloveViewTest has the rest, with a client. */
@Timeout(60)
class FoxgloveConnectionTest {
    private static final FoxgloveConnection.Source NOTHING = new FoxgloveConnection.Source() {
        @Override
        public @Nullable Frame newest() {
            return null;
        }

        @Override
        public Events eventsFrom(long number) {
            return new Events(number, List.of());
        }
    };

    @Test
    void endOfTheProgram_isAnnounced() throws Exception {
        var closed = new CountDownLatch(1);
        var out = new ByteArrayOutputStream() {
            @Override
            public synchronized void write(byte[] bytes, int offset, int length) {
                super.write(bytes, offset, length);
                if (toString(StandardCharsets.ISO_8859_1).contains("the program has ended")) {
                    closed.countDown();
                }
            }
        };
        var client = new InputStream() { // which leaves when it receives the end
                    @Override
                    public int read() {
                        try {
                            closed.await();
                        } catch (InterruptedException e) {
                            Thread.currentThread().interrupt();
                        }
                        return -1;
                    }
                };
        Map<String, String> headers = Map.of(
                "sec-websocket-key", "dGhlIHNhbXBsZSBub25jZQ==",
                "sec-websocket-version", "13",
                "sec-websocket-protocol", "foxglove.websocket.v1");
        FoxgloveConnection.serve(headers, client, out, NOTHING, () -> true);
        assertThat(out.toString(StandardCharsets.ISO_8859_1))
                .startsWith("HTTP/1.1 101 Switching Protocols\r\n")
                .contains("\"op\":\"serverInfo\"")
                .endsWith("\u0088\u0017\u0003\u00e9the program has ended");
    }
}
