package io.troupe.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.ConnectException;
import java.net.InetAddress;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** A real server that is started, killed and started again. */
class NatsServerProcessTest {
    @TempDir
    private Path folder;

    @BeforeEach
    void needsTheServer() {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
    }

    /** What the server sends first. */
    private static String greeting(NatsServerProcess server) throws IOException {
        try (var socket = new Socket(InetAddress.getLoopbackAddress(), server.port());
                var in =
                        new BufferedReader(new InputStreamReader(socket.getInputStream(), StandardCharsets.US_ASCII))) {
            return in.readLine();
        }
    }

    @Test
    void server_acceptsConnections_untilItIsKilled_andOnTheSamePortWhenItIsStartedAgain() throws Exception {
        try (var server = NatsServerProcess.start()) {
            assertThat(server.address()).isEqualTo("nats://127.0.0.1:" + server.port());
            assertThat(greeting(server)).startsWith("INFO {");
            int port = server.port();
            server.kill();
            assertThatThrownBy(() -> greeting(server)).isInstanceOf(ConnectException.class);
            server.startAgain();
            assertThat(server.port()).isEqualTo(port);
            assertThat(greeting(server)).startsWith("INFO {");
        }
    }

    @Test
    void configurationWithVariables_isUsed_withoutItsAddress() throws Exception {
        Path file = Files.writeString(folder.resolve("x.conf"), "port: 1\nserver_name: $WHO\n");
        try (var server = NatsServerProcess.start(List.of("-c", file.toString()), Map.of("WHO", "hub7"))) {
            assertThat(greeting(server)).contains("\"server_name\":\"hub7\"");
        }
    }

    @Test
    void serverThatDoesNotStart_isAnErrorWithItsLog() {
        assertThatThrownBy(() -> NatsServerProcess.start(
                        "-c", folder.resolve("missing.conf").toString()))
                .isInstanceOf(IOException.class)
                .hasMessageStartingWith("nats-server did not start:")
                .hasMessageContaining("missing.conf");
    }
}
