package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.bus.Address;
import io.troupe.bus.Bus;
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
import javax.net.ssl.SSLContext;
import javax.net.ssl.TrustManagerFactory;
import org.junit.jupiter.api.Test;

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
            refused(at, "the server asks for a user and a password");
            refused(at.withUser("ada", "wrong"), "the server does not accept the user \"ada\" with that password");
            assertThat(open("x", at.withUser("ada", "secret")).node()).isEqualTo("x");
            assertThat(at.withUser("ada", "secret").toString()).doesNotContain("secret");
        }
    }

    @Test
    void tls() throws Exception {
        var trust = makeCertificate();
        try (var server = NatsServer.start(
                List.of("--tls", "--tlscert", folder + "/cert.pem", "--tlskey", folder + "/key.pem"))) {
            var plain = server.settings();
            refused(plain, "the server asks for TLS: use an address that begins with tls://");
            var encrypted = NatsSettings.at("tls://localhost:" + server.port()).withConnectLimit(LONG);
            assertThatThrownBy(() -> open("x", encrypted))
                    .isInstanceOf(BusException.class)
                    .hasMessageContaining("no encrypted connection: ");
            var near = open("near", encrypted.withTls(trust)).attach("a");
            var far = open("far", encrypted.withTls(trust)).attach("b");
            far.answer(SPELL, NatsTest::spell);
            assertThat(answer(near, far.address())).isEqualTo("number 7");
        }
        try (var server = NatsServer.start()) {
            refused(
                    NatsSettings.at("tls://127.0.0.1:" + server.port()).withTls(trust),
                    "the server has no TLS: use an address that begins with nats://");
        }
    }

    private SSLContext makeCertificate() throws Exception {
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
                        "san=dns:localhost,ip:127.0.0.1",
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
            var server = Thread.ofVirtual().start(() -> playOldServer(socket));
            String address = "nats://127.0.0.1:" + socket.getLocalPort();
            assertThatThrownBy(() -> open("x", NatsSettings.at(address)))
                    .isInstanceOf(BusException.class)
                    .hasMessage("node x cannot use the server at " + address
                            + ": it is nats-server 1.4.1, expected 2.2 or later");
            server.interrupt();
        }
    }

    private static void playOldServer(ServerSocket socket) {
        try (var client = socket.accept()) {
            var out = client.getOutputStream();
            String info = "INFO {\"server_id\":\"x\",\"version\":\"1.4.1\",\"max_payload\":1048576,\"proto\":1}\r\n";
            out.write(info.getBytes(StandardCharsets.US_ASCII));
            var in = new BufferedReader(new InputStreamReader(client.getInputStream(), StandardCharsets.US_ASCII));
            for (String line = in.readLine(); line != null; line = in.readLine()) {
                if (line.startsWith("PING")) {
                    out.write("PONG\r\n".getBytes(StandardCharsets.US_ASCII));
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
                            error -> assertThat(error.mayHaveBeenHandled()).isFalse())
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
