package io.troupe.demo.hosts;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceOffer;
import io.troupe.broker.ServiceRecord;
import io.troupe.broker.Sharing;
import io.troupe.bus.Address;
import io.troupe.bus.BusSettings;
import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.demo.CommandLineBench;
import io.troupe.tools.NatsServerProcess;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe services}, and how a server that refuses is reported on the command line. */
@Timeout(300)
class ServicesCommandTest extends CommandLineBench {
    private static final int FAILED = 1;
    private static final Duration LONG = Duration.ofSeconds(60);

    /** An actor. */
    public interface Greeter {
        Promise<String> greet(String name);
    }

    private static void assumeInstalled() {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
    }

    @Test
    void table_hasAlignedColumns_andShowsWhoDoesNotAnswer() {
        var wanderer = new ServiceRecord(
                "robotServices",
                List.of("wallFollower", "spaceWanderer"),
                new Address("host-a", "robotServices"),
                Health.WELL);
        var camera = new ServiceRecord("eye", List.of(), new Address("b", "eye"), Health.SUSPECT);
        var offers = List.of(
                new ServiceOffer(camera, 1, 0, Duration.ofMillis(2340), null),
                new ServiceOffer(wanderer, 0, 12, Duration.ofMillis(60), Duration.ofNanos(1_260_000)));
        assertThat(ServicesCommand.table(offers))
                .containsExactly(
                        "service        capabilities                 node    state    round trip  life  rank  age",
                        "eye            -                            b       suspect  no answer   0     1     2.3 s",
                        "robotServices  wallFollower, spaceWanderer  host-a  running  1.3 ms      12    0     0.1 s");
    }

    @Test
    void offersOfAnotherNode_areShown_asATableAndAsJson_andNoneIsOneLine() throws Exception {
        assumeInstalled();
        try (var server = NatsServerProcess.start()) {
            String line = "services --bus " + server.address();
            assertThat(printed(line))
                    .isEqualToIgnoringNewLines(
                            "no service is offered on " + server.address() + " (application troupe)");
            assertThat(printed(line + " --json")).isEqualToIgnoringNewLines("[]");
            var limited = NatsSettings.at(server.address()).withConnectLimit(LONG);
            try (var space = ActorSpace.create(SpaceSettings.named("host"));
                    var bus = NatsBus.open("host-a", limited, BusSettings.on(space))) {
                var broker = Broker.over(
                        bus,
                        space,
                        BrokerSettings.defaults(),
                        Sharing.defaults().withRank(3));
                var services = broker.services();
                services.publish(
                        space, Greeter.class, "greeter", List.of("english"), () -> name -> Promise.of("hello " + name));
                broker.require(Need.ofService("test", "greeter")).get(LONG);
                assertThat(printed(line).lines())
                        .hasSize(2)
                        .element(1)
                        .asString()
                        .matches("greeter +english +host-a +running +[0-9.]+ ms +1 +3 +[0-9.]+ s");
                assertThat(printed(line + " --json"))
                        .startsWith("[{\"service\":\"greeter\",\"capabilities\":[\"english\"],\"node\":\"host-a\","
                                + "\"name\":\"greeter\",\"state\":\"running\",\"health\":\"well\",\"roundTripMillis\":")
                        .contains("\"life\":1,\"rank\":3,\"ageSeconds\":");
                assertFails(
                        FAILED,
                        line + " --name host-a",
                        "node host-a cannot be opened: another process has that name on " + server.address());
                broker.closeAsync().get(LONG);
            }
        }
    }

    // ---- a server that refuses: one line, exit status 1

    @Test
    void noServer_andUnknownHost() throws IOException {
        int port;
        try (var socket = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            port = socket.getLocalPort();
        }
        assertFails(
                FAILED,
                "services --name x --bus nats://127.0.0.1:" + port,
                "troupe: node x cannot connect to nats://127.0.0.1:" + port + ": nothing accepts connections there");
        assertFails(
                FAILED,
                "services --bus nats://no-such-host.invalid",
                "the host is not known: check the name in the address");
        assertRefused("services", "--bus is missing, expected an address like nats://HOST:4222");
    }

    @Test
    void wrongPassword_andNoTls() throws Exception {
        assumeInstalled();
        file("password", "wrong\n");
        try (var server = NatsServerProcess.start("--user", "ada", "--pass", "secret")) {
            String line = "services --bus " + server.address();
            assertFails(FAILED, line, "the server asks for a user and a password (a token or a key cannot be given)");
            assertFails(
                    FAILED,
                    line + " --bus-user ada --bus-password-file DIR/password",
                    "the server does not accept the user \"ada\" with that password");
            assertFails(
                    FAILED,
                    line.replace("nats:", "tls:"),
                    "the server has no TLS: use an address that begins with nats://");
        }
    }

    @Test
    void serverThatIsTooOld() throws Exception {
        try (var socket = new ServerSocket(0, 5, InetAddress.getLoopbackAddress())) {
            Thread.ofVirtual().start(() -> playOldServer(socket));
            String address = "nats://127.0.0.1:" + socket.getLocalPort();
            assertFails(
                    FAILED,
                    "services --name x --bus " + address,
                    "troupe: node x cannot use the server at " + address
                            + ": it is nats-server 1.4.1, expected 2.2 or later");
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
}
