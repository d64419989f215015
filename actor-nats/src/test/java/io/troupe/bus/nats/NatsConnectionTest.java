package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusException;
import io.troupe.bus.Operation;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.KeyStore;
import java.util.Base64;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;
import javax.net.ssl.KeyManagerFactory;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLSocket;
import javax.net.ssl.TrustManagerFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Connecting to a real server, being refused by it, and losing it. */
class NatsConnectionTest extends NatsTest {
    private void refused(NatsSettings server, String reason) {
        assertThatThrownBy(() -> open("x", server))
                .isInstanceOf(BusException.class)
                .hasMessage("node x cannot connect to " + server.servers().getFirst() + ": " + reason);
    }

    @Test
    void nodes_askAndPublish_andAMissingOneIsKnownAtOnce() throws Exception {
        try (var server = NatsServer.start()) {
            var near = open("near", server.settings()).attach("a");
            var far = open("far away. 2", server.settings()).attach("b");
            far.answer(SPELL, NatsTest::spell);
            var received = new CompletableFuture<Count>();
            far.subscribe(COUNTS, (count, from) -> received.complete(count));
            assertThat(answer(near, far.address())).isEqualTo("number 7");
            near.publish(COUNTS, new Count(3));
            assertThat(received.get(60, TimeUnit.SECONDS)).isEqualTo(new Count(3));
            assertThatThrownBy(() -> answer(near, new Address("nowhere", "b")))
                    .isInstanceOf(BusException.class)
                    .hasMessage("near/a asked nowhere/b for spell: no node of that name is connected now");
            assertThat(next(losses)).contains("no node of that name is connected now");
        }
    }

    @Test
    void nothingThere_andUnknownHost() throws Exception {
        refused(
                NatsSettings.at("nats://127.0.0.1:" + NatsServer.freePort()),
                "nothing accepts connections there: is nats-server running, and does it listen on that address?");
        refused(
                NatsSettings.at("nats://no-such-host.invalid:4222"),
                "the host is not known: check the name in the address");
        assertThatThrownBy(() -> NatsSettings.at("base:4222"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("the address of the server is \"base:4222\", expected one like nats://HOST:4222");
    }

    @Test
    void userAndPassword() throws Exception {
        try (var server = NatsServer.start(List.of("--user", "ada", "--pass", "secret"))) {
            var at = server.settings();
            refused(at, "the server asks for a user and a password (a token or a key cannot be given)");
            refused(at.withUser("ada", "wrong"), "the server does not accept the user \"ada\" with that password");
            assertThat(open("x", at.withUser("ada", "secret")).node()).isEqualTo("x");
            assertThat(at.withUser("ada", "secret").toString()).doesNotContain("secret");
        }
    }

    @Test
    void tls() throws Exception {
        var trust = makeCertificate("dns:localhost,ip:127.0.0.1");
        try (var server = NatsServer.start(
                List.of("--tls", "--tlscert", folder + "/cert.pem", "--tlskey", folder + "/key.pem"))) {
            var plain = server.settings();
            refused(plain, "the server asks for TLS: use an address that begins with tls://");
            var encrypted = NatsSettings.at("tls://localhost:" + server.port()).withConnectLimit(LONG);
            assertThatThrownBy(() -> open("x", encrypted))
                    .isInstanceOf(BusException.class)
                    .hasMessageContaining("no encrypted connection: ");
            var near = open("near", encrypted.withTls(trust)).attach("a");
            var byAddress = NatsSettings.at("tls://127.0.0.1:" + server.port()).withConnectLimit(LONG);
            var far = open("far", byAddress.withTls(trust)).attach("b");
            far.answer(SPELL, NatsTest::spell);
            assertThat(answer(near, far.address())).isEqualTo("number 7");
        }
        try (var server = NatsServer.start()) {
            refused(
                    NatsSettings.at("tls://127.0.0.1:" + server.port()).withTls(trust),
                    "the server has no TLS: use an address that begins with nats://");
        }
    }

    /** The name in the certificate is checked before the password is sent; a name, a wildcard or an address. */
    @Test
    void certificateForAnotherHost_isRefused_withBothNames_andGetsNoPassword() throws Exception {
        var trust = makeCertificate("dns:elsewhere.example,ip:127.0.0.2");
        var options = List.of("--tls", "--tlscert", folder + "/cert.pem", "--tlskey", folder + "/key.pem");
        try (var server = NatsServer.start(options)) {
            for (var host : List.of("localhost", "127.0.0.1")) {
                refused(
                        NatsSettings.at("tls://" + host + ":" + server.port())
                                .withConnectLimit(LONG)
                                .withTls(trust),
                        "no encrypted connection: the certificate of the server is for elsewhere.example, 127.0.0.2,"
                                + " expected one for " + host + (host.equals("localhost") ? " or 127.0.0.1" : ""));
            }
        }
        var machine = SSLContext.getDefault();
        SSLContext.setDefault(trust);
        try (var server = NatsServer.start(options)) {
            refused(
                    NatsSettings.at("tls://127.0.0.1:" + server.port()).withConnectLimit(LONG),
                    "no encrypted connection: the certificate of the server is for elsewhere.example, 127.0.0.2,"
                            + " expected one for 127.0.0.1");
        } finally {
            SSLContext.setDefault(machine);
        }
        try (var impostor = new TlsImpostor(folder.resolve("store.p12"))) {
            assertThatThrownBy(() -> open(
                            "x",
                            NatsSettings.at("tls://localhost:" + impostor.port())
                                    .withConnectLimit(LONG)
                                    .withUser("ada", "top-secret")
                                    .withTls(trust)))
                    .hasMessageContaining("elsewhere.example");
            assertThat(impostor.received()).as("what the impostor received").isEmpty();
        }
    }

    @Test
    void serverThatAsksForACertificate_isToldInWords() throws Exception {
        var trust = makeCertificate("dns:localhost,ip:127.0.0.1");
        var cert = folder + "/cert.pem";
        try (var server = NatsServer.start(List.of(
                "--tls", "--tlscert", cert, "--tlskey", folder + "/key.pem", "--tlsverify", "--tlscacert", cert))) {
            refused(
                    NatsSettings.at("tls://localhost:" + server.port())
                            .withConnectLimit(LONG)
                            .withTls(trust),
                    "no encrypted connection: (bad_certificate) Received fatal alert: bad_certificate; the server asks for"
                            + " a certificate of this process: give one by NatsSettings.withTls");
        }
    }

    @Test
    void connectionThatBreaksWhileANodeIsOpened_isOneLine_andLeavesNoThread() throws Exception {
        for (var round = 0; round < 8; round++) {
            var lines = round % 4; // received before it breaks
            try (var socket = new ServerSocket(0, 5, InetAddress.getLoopbackAddress())) {
                Thread.ofVirtual().start(() -> playServer(socket, "2.9.10", lines));
                var node = "breaks" + round;
                assertThatThrownBy(() -> open(
                                node,
                                NatsSettings.at("nats://127.0.0.1:" + socket.getLocalPort())
                                        .withConnectLimit(LONG)))
                        .isInstanceOf(BusException.class)
                        .hasMessageStartingWith("node " + node + " cannot connect to nats://127.0.0.1:");
                for (var thread : Thread.getAllStackTraces().keySet()) {
                    if (thread.getName().startsWith("nats " + node)) {
                        thread.join(60_000);
                        assertThat(thread.isAlive())
                                .as(thread.getName() + List.of(thread.getStackTrace()))
                                .isFalse();
                    }
                }
            }
        }
    }

    /** The client only passes on what a handler throws, and reports nothing. */
    @Test
    void errorOfAHandler_isALoss() throws Exception {
        var lost = new LinkedBlockingQueue<String>();
        try (var server = NatsServer.start()) {
            var failing = new NatsEngine(server.settings());
            failing.start("failing", 1, new BusEngine.Listener() {
                @Override
                public void frame(byte[] frame) {
                    throw new OutOfMemoryError("Java heap space");
                }

                @Override
                public void unreachable(String node, long number, String why) {}

                @Override
                public void rejected(String node, String why) {}

                @Override
                public void gone(String node, long incarnation) {}

                @Override
                public void lost(long frames, String why) {
                    lost.add(frames + ": " + why);
                }

                @Override
                public void disconnected(String why) {}

                @Override
                public void connected() {}
            });
            failing.subscribe("counts");
            var other = open("other", server.settings()).attach("a");
            other.send(new Address("failing", "b"), SPELL, new Count(1));
            var expected = " bytes: java.lang.OutOfMemoryError: Java heap space";
            assertThat(next(lost))
                    .startsWith("1: node failing could not handle a frame of ")
                    .endsWith(expected);
            failing.close();
        }
    }

    @ParameterizedTest
    @CsvSource({
        "base.example, base.example, true",
        "Base.Example, base.example., true",
        "base.example, lab.example, false",
        "base.example, *.example, false",
        "base.lab.example, *.lab.example, true",
        "x.base.lab.example, *.lab.example, false",
        "lab.example, *.lab.example, false",
        "10.0.0.1, 10.0.0.1, true",
        "10.0.0.1, *.0.0.1, false",
        "[::1], 0:0:0:0:0:0:0:1, true",
        "::1, 0:0:0:0:0:0:0:2, false",
        "1.example, 1.0.0.1, false"
    })
    void nameInACertificate_isOfAHost(String host, String name, boolean expected) {
        boolean isAddress = !name.startsWith("*") && !name.contains("example");
        assertThat(new NamedServerPort.Name(isAddress, name).isOf(host)).isEqualTo(expected);
    }

    @Test
    void addressThatIsNotConfigured_mayHaveAConfiguredName() {
        var configured = List.of("base", "lab", "10.0.0.1");
        assertThat(NamedServerPort.expected("base", configured)).containsExactly("base");
        assertThat(NamedServerPort.expected("10.0.0.1", configured)).containsExactly("10.0.0.1");
        assertThat(NamedServerPort.expected("10.0.0.2", configured)).containsExactly("base", "lab", "10.0.0.2");
        assertThat(NamedServerPort.expected("other", configured)).containsExactly("other");
    }

    /** Has a certificate for another host, asks for a password, and keeps what it gets. */
    private static final class TlsImpostor implements AutoCloseable {
        private final ServerSocket socket = new ServerSocket(0, 5, InetAddress.getLoopbackAddress());
        private final CompletableFuture<String> received = new CompletableFuture<>();

        TlsImpostor(Path store) throws Exception {
            var keys = KeyStore.getInstance("PKCS12");
            try (var in = Files.newInputStream(store)) {
                keys.load(in, "changeit".toCharArray());
            }
            var managers = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
            managers.init(keys, "changeit".toCharArray());
            var context = SSLContext.getInstance("TLS");
            context.init(managers.getKeyManagers(), null, null);
            Thread.ofVirtual().start(() -> play(context));
        }

        int port() {
            return socket.getLocalPort();
        }

        /** What came until the client closed the connection. */
        String received() throws Exception {
            return received.get(60, TimeUnit.SECONDS);
        }

        private void play(SSLContext context) {
            var lines = new StringBuilder();
            try (var client = socket.accept()) {
                String info = "INFO {\"server_id\":\"x\",\"version\":\"2.9.10\",\"max_payload\":1048576,\"proto\":1,"
                        + "\"headers\":true,\"auth_required\":true,\"tls_required\":true}\r\n";
                client.getOutputStream().write(info.getBytes(StandardCharsets.US_ASCII));
                var encrypted = (SSLSocket) context.getSocketFactory().createSocket(client, null, port(), true);
                encrypted.setUseClientMode(false);
                var in = new BufferedReader(
                        new InputStreamReader(encrypted.getInputStream(), StandardCharsets.US_ASCII));
                for (String line = in.readLine(); line != null; line = in.readLine()) {
                    lines.append(line).append('\n');
                }
            } catch (IOException closed) {
                received.complete(lines.toString()); // by the client
                return;
            }
            received.complete(lines.toString());
        }

        @Override
        public void close() throws IOException {
            socket.close();
        }
    }

    /** @param names the subjectAltName, as keytool expects it */
    private SSLContext makeCertificate(String names) throws Exception {
        Path store = folder.resolve("store.p12");
        var keytool = new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "keytool")
                                .toString(),
                        "-genkeypair",
                        "-alias",
                        "server",
                        "-keyalg",
                        "EC",
                        "-dname",
                        "CN=localhost",
                        "-ext",
                        "san=" + names,
                        "-validity",
                        "30",
                        "-storetype",
                        "PKCS12",
                        "-keystore",
                        store.toString(),
                        "-storepass",
                        "changeit")
                .redirectErrorStream(true)
                .start();
        String log = new String(keytool.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        assertThat(keytool.waitFor()).as(log).isZero();
        var keys = KeyStore.getInstance("PKCS12");
        try (var in = Files.newInputStream(store)) {
            keys.load(in, "changeit".toCharArray());
        }
        writePem(
                "key.pem",
                "PRIVATE KEY",
                keys.getKey("server", "changeit".toCharArray()).getEncoded());
        writePem("cert.pem", "CERTIFICATE", keys.getCertificate("server").getEncoded());
        var trusted = KeyStore.getInstance("PKCS12");
        trusted.load(null, null);
        trusted.setCertificateEntry("server", keys.getCertificate("server"));
        var managers = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        managers.init(trusted);
        var context = SSLContext.getInstance("TLS");
        context.init(null, managers.getTrustManagers(), null);
        return context;
    }

    private void writePem(String file, String what, byte[] content) throws IOException {
        String lines = Base64.getMimeEncoder(64, new byte[] {'\n'}).encodeToString(content);
        Files.writeString(
                folder.resolve(file), "-----BEGIN " + what + "-----\n" + lines + "\n-----END " + what + "-----\n");
    }

    @Test
    void serverThatIsTooOld() throws Exception {
        try (var socket = new ServerSocket(0, 5, InetAddress.getLoopbackAddress())) {
            var server = Thread.ofVirtual().start(() -> playServer(socket, "1.4.1", Integer.MAX_VALUE - 1));
            String address = "nats://127.0.0.1:" + socket.getLocalPort();
            assertThatThrownBy(() -> open("x", NatsSettings.at(address)))
                    .isInstanceOf(BusException.class)
                    .hasMessage("node x cannot use the server at " + address
                            + ": it is nats-server 1.4.1, expected 2.2 or later");
            server.interrupt();
        }
    }

    /** @param most of the lines of the client, before the connection breaks */
    private static void playServer(ServerSocket socket, String version, int most) {
        try (var client = socket.accept()) {
            var out = client.getOutputStream();
            String info = "INFO {\"server_id\":\"x\",\"version\":\"" + version
                    + "\",\"max_payload\":1048576,\"proto\":1}\r\n";
            out.write(info.getBytes(StandardCharsets.US_ASCII));
            var in = new BufferedReader(new InputStreamReader(client.getInputStream(), StandardCharsets.US_ASCII));
            var received = 0;
            for (String line = in.readLine(); line != null && received <= most; line = in.readLine()) {
                if (line.startsWith("PING")) {
                    out.write("PONG\r\n".getBytes(StandardCharsets.US_ASCII));
                    received = 1;
                } else if (received > 0) {
                    received++;
                }
            }
        } catch (IOException closed) {
            return; // the client has seen enough
        }
    }

    @Test
    void nameThatIsTaken_isRefused_andOfTwoThatOpenAtOnce_oneGetsIt() throws Exception {
        try (var server = NatsServer.start()) {
            var at = server.settings();
            open("robot", at);
            assertThatThrownBy(() -> open("robot", at))
                    .isInstanceOf(BusException.class)
                    .hasMessageStartingWith("node robot cannot be opened: another process has that name on ");
            assertThat(open("robot", at.withApplication("other")).node()).isEqualTo("robot");
            for (int round = 0; round < 10; round++) {
                String node = "node" + round;
                var both = List.of(attempt(node, at), attempt(node, at));
                long opened = both.stream().filter(each -> each.join() != null).count();
                assertThat(opened).as("round %d", round).isEqualTo(1);
            }
        }
    }

    /** Completes with the bus, or with null if the name was taken. */
    private CompletableFuture<Bus> attempt(String node, NatsSettings at) {
        return CompletableFuture.supplyAsync(() -> {
            try {
                return open(node, at);
            } catch (BusException taken) {
                return null;
            }
        });
    }

    @Test
    void valueThatIsTooLarge_andPermissionThatIsMissing_areReportedInOneLine() throws Exception {
        String configuration = """
                max_payload: 4096
                authorization {
                  users = [
                    {user: all, password: p, permissions: {publish: "troupe.>", subscribe: "troupe.>"}}
                    {user: deaf, password: p, permissions: {publish: "troupe.>", subscribe: ["troupe.who.>", "troupe.n.>", "troupe.x.>", "troupe.g.>"]}}
                    {user: few, password: p, permissions: {publish: ["troupe.who.>", "troupe.x.>", "troupe.n.>"], subscribe: "troupe.>"}}
                  ]
                }
                """;
        try (var server = NatsServer.configured(folder, configuration)) {
            var at = server.settings();
            var all = open("all", at.withUser("all", "p")).attach("a");
            all.publish(TEXTS, new Text("x".repeat(5_000)));
            assertThat(next(losses)).contains("bytes, expected at most 4096");
            var echo = new Operation<>("echo", Text.class, Text.class, Operation.Kind.DATA);
            var request = all.ask(new Address("far", "b"), echo, new Text("x".repeat(5_000)), LONG);
            assertThatThrownBy(() -> request.get(LONG))
                    .isInstanceOfSatisfying(
                            BusException.class,
                            error -> assertThat(error.mayHaveRun()).isFalse())
                    .hasMessageContaining("all/a asked far/b for echo: ")
                    .hasMessageContaining("bytes, expected at most 4096");
            assertThat(next(losses)).contains("bytes, expected at most 4096");
            open("deaf", at.withUser("deaf", "p")).attach("a").subscribe(TEXTS, (text, from) -> {});
            assertThat(next(losses))
                    .contains("the server does not permit it to node deaf: ")
                    .contains("ubscription to \"troupe.t.texts\"");
            var few = open("few", at.withUser("few", "p")).attach("a");
            few.publish(TEXTS, new Text("x"));
            assertThat(next(losses))
                    .contains("the server does not permit it to node few: ")
                    .contains("troupe.t.texts")
                    .endsWith("the user needs publish and subscribe permission for \"troupe.>\"");
        }
    }

    @Test
    void serverThatIsKilled_isNoticed_nothingIsKeptForLater_andItConnectsAgain() throws Exception {
        try (var server = NatsServer.start()) {
            var at = server.settings();
            var near = open("near", at).attach("a");
            var far = open("far", at).attach("b");
            far.answer(SPELL, NatsTest::spell);
            var received = new LinkedBlockingQueue<Count>();
            far.subscribe(COUNTS, (count, from) -> received.add(count));
            assertThat(answer(near, far.address())).isEqualTo("number 7");
            server.kill();
            assertThat(List.of(next(events), next(events))).containsExactly("disconnected", "disconnected");
            near.publish(COUNTS, new Count(1));
            assertThat(next(losses)).contains("it is disconnected from " + server.address());
            assertThatThrownBy(() -> answer(near, far.address()))
                    .isInstanceOf(BusException.class)
                    .hasMessageContaining("it is disconnected from");
            server.startAgain();
            assertThat(List.of(next(events), next(events))).containsExactly("connected", "connected");
            near.publish(COUNTS, new Count(2));
            assertThat(received.poll(60, TimeUnit.SECONDS))
                    .as("%s %s", losses, events)
                    .isEqualTo(new Count(2));
            assertThat(answer(near, far.address())).isEqualTo("number 7");
        }
    }

    @Test
    void serverThatIsFrozen_isNoticed() throws Exception {
        try (var server = NatsServer.start()) {
            open("near", server.settings());
            server.signal("STOP");
            assertThat(next(events)).isEqualTo("disconnected");
            server.signal("CONT");
            assertThat(next(events)).isEqualTo("connected");
        }
    }
}
