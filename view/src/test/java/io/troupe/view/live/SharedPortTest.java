package io.troupe.view.live;

import static org.assertj.core.api.Assertions.assertThat;

import com.sun.net.httpserver.HttpServer;
import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.Socket;
import java.net.SocketTimeoutException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Clients that keep connections without use, with real sockets. */
@Timeout(value = 120, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
class SharedPortTest {
    private static final Duration LONG = Duration.ofMinutes(10);
    private static final String SOCKET = "GET / HTTP/1.1\r\nUpgrade: websocket\r\n\r\n";

    private final List<Socket> open = new ArrayList<>();
    private HttpServer http;
    private SharedPort port;

    @BeforeEach
    void start() throws IOException {
        http = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        http.createContext("/", exchange -> {
            exchange.sendResponseHeaders(200, 2);
            exchange.getResponseBody().write("ok".getBytes(StandardCharsets.US_ASCII));
            exchange.close();
        });
        http.start();
        port = start(LONG);
    }

    private SharedPort start(Duration headLimit) throws IOException {
        var started = SharedPort.bind(InetAddress.getLoopbackAddress(), 0, http.getAddress(), headLimit);
        started.start((head, in, out) -> {
            out.write('w');
            in.transferTo(out);
        });
        return started;
    }

    @AfterEach
    void end() throws IOException {
        for (var socket : open) {
            socket.close();
        }
        port.close();
        http.stop(0);
    }

    /** @param from the client's address; on Linux all of 127.0.0.0/8 are addresses of this machine */
    private Socket send(String from, String text) throws IOException {
        var socket = new Socket(InetAddress.getLoopbackAddress(), port.port(), InetAddress.getByName(from), 0);
        open.add(socket);
        socket.getOutputStream().write(text.getBytes(StandardCharsets.US_ASCII));
        return socket;
    }

    private String page() throws IOException {
        var socket = send("127.0.0.1", "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
        return new String(socket.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
    }

    @Test
    void halfRequests_giveWayToOthers() throws IOException {
        for (var i = 0; i < SharedPort.MOST_CONNECTIONS + 20; i++) {
            send("127.0.0." + (2 + i % 4), "G");
        }
        assertThat(page()).startsWith("HTTP/1.1 200").endsWith("ok");
        for (var i = 0; i < SharedPort.MOST_OF_ONE_ADDRESS + 20; i++) {
            send("127.0.0.1", "G");
        }
        assertThat(page()).startsWith("HTTP/1.1 200").endsWith("ok");
    }

    @Test
    void socketsOfOneAddress_areLimited_andLeaveRoomForOthers() throws IOException {
        var accepted = 0;
        for (var i = 0; i < SharedPort.MOST_OF_ONE_ADDRESS + 20; i++) {
            accepted += answers(send("127.0.0.2", SOCKET)) ? 1 : 0;
        }
        assertThat(accepted).isEqualTo(SharedPort.MOST_OF_ONE_ADDRESS);
        assertThat(page()).startsWith("HTTP/1.1 200").endsWith("ok");
        assertThat(answers(send("127.0.0.1", SOCKET))).isTrue();
    }

    private static boolean answers(Socket socket) {
        try {
            return socket.getInputStream().read() == 'w';
        } catch (IOException refused) {
            return false;
        }
    }

    /** A byte now and then does not prolong it. */
    @Test
    void head_hasALimitAsAWhole() throws IOException {
        port.close();
        port = start(Duration.ofSeconds(1));
        var socket = send("127.0.0.1", "G");
        socket.setSoTimeout(50);
        for (var isOpen = true; isOpen; ) {
            try {
                isOpen = socket.getInputStream().read() >= 0;
            } catch (SocketTimeoutException stillThere) {
                isOpen = sends(socket);
            } catch (IOException reset) {
                isOpen = false;
            }
        }
        assertThat(page()).endsWith("ok");
    }

    private static boolean sends(Socket socket) {
        try {
            socket.getOutputStream().write('E');
            return true;
        } catch (IOException closed) {
            return false;
        }
    }

    /** The HTTP server answers or ends the connection, and this port goes on without a stack trace. */
    @ParameterizedTest
    @ValueSource(strings = {"\n\n", "\r\n\r\n", " \r\n\r\n", ":\n\n", "GET\n\n"})
    void requestWithoutWords_isLeftToTheHttpServer(String bytes) throws IOException {
        var failures = new ArrayList<Throwable>();
        var before = Thread.getDefaultUncaughtExceptionHandler();
        Thread.setDefaultUncaughtExceptionHandler((thread, failure) -> failures.add(failure));
        try {
            var socket = send("127.0.0.1", bytes);
            socket.shutdownOutput();
            socket.getInputStream().readAllBytes();
            assertThat(page()).endsWith("ok");
            assertThat(failures).isEmpty();
        } finally {
            Thread.setDefaultUncaughtExceptionHandler(before);
        }
    }
}
