package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.bus.Address;
import io.troupe.bus.BusException;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTimeoutException;
import io.troupe.bus.BusTopic;
import io.troupe.tools.NatsServerProcess;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The configuration of a hub and of a server on a robot, {@code docs/hosts}, with real servers. */
class NatsHostsTest extends NatsTest {
    private static final Duration SECOND = Duration.ofSeconds(1);
    private static final Path HOSTS = Path.of("../docs/hosts");
    private static final Map<String, String> USER = Map.of("TROUPE_USER", "robots", "TROUPE_PASSWORD", "secret");

    private final List<NatsServer> servers = new ArrayList<>();

    @AfterEach
    void closeServers() {
        servers.forEach(NatsServer::close);
    }

    /** A server with a file of the documentation, on another port. */
    private NatsServer start(Path file, Map<String, String> environment) throws IOException {
        var server = NatsServer.start(List.of("-c", file.toString()), environment);
        servers.add(server);
        return server;
    }

    @Test
    void configurations_areValid_andTheHubNeedsAUser() throws Exception {
        NatsServer.assumeInstalled();
        var all = Map.of("TROUPE_USER", "u", "TROUPE_PASSWORD", "p", "TROUPE_HUB", "nats-leaf://u:p@base:7422");
        assertThat(check("nats.conf", all)).contains("configuration file", "is valid");
        assertThat(check("leaf.conf", all)).contains("configuration file", "is valid");
        assertThat(check("nats.conf", Map.of())).contains("'TROUPE_USER'", "can not be found");
        var digits = Map.of("TROUPE_USER", "u", "TROUPE_PASSWORD", "\"1234\"");
        assertThat(check("nats.conf", digits)).contains("is valid");
    }

    private static String check(String file, Map<String, String> environment) throws IOException {
        var builder = new ProcessBuilder(
                        NatsServerProcess.program().orElseThrow().toString(),
                        "-t",
                        "-c",
                        HOSTS.resolve(file).toString())
                .redirectErrorStream(true);
        builder.environment().putAll(environment);
        return new String(builder.start().getInputStream().readAllBytes());
    }

    /** The server of {@code nats.conf} with the users of {@code permissions.conf}. */
    private NatsServer startWithPermissions() throws IOException {
        String text = Files.readString(HOSTS.resolve("nats.conf"));
        int begin = text.indexOf("\nauthorization {") + 1;
        int end = text.indexOf("\n}\n", begin) + 2;
        String changed = text.substring(0, begin) + "include \"permissions.conf\"" + text.substring(end);
        assertThat(text.substring(begin, end)).contains("$TROUPE_USER").doesNotContain("leafnodes");
        Files.copy(HOSTS.resolve("permissions.conf"), folder.resolve("permissions.conf"));
        var environment = new HashMap<>(USER);
        List.of("BASE", "ROBOT1", "DISPLAY")
                .forEach(user -> environment.put(user + "_PASSWORD", "of-" + user.toLowerCase(Locale.ROOT)));
        var file = Files.writeString(
                folder.resolve("nats.conf"),
                changed.replace("  port: 7422\n", "  port: " + NatsServer.freePort() + "\n"));
        return start(file, environment);
    }

    @Test
    void permissions_keepANodeToItsNameAndItsTopics() throws Exception {
        NatsServer.assumeInstalled();
        var at = startWithPermissions().settings();
        var base = open("base", at.withUser("base", "of-base")).attach("port");
        var robot = speller("robot1", at.withUser("robot1", "of-robot1"));
        var display = open("display", at.withUser("display", "of-display")).attach("port");
        assertThat(answer(base, robot.address())).isEqualTo("number 7");
        assertThatThrownBy(() -> open("robot2", at.withUser("robot1", "of-robot1")))
                .isInstanceOf(BusException.class)
                .hasMessageContaining("node robot2 cannot be opened")
                .hasMessageContaining("troupe.who.robot2");

        var topic = new BusTopic<>("robot1/state", Text.class);
        display.subscribe(topic, (text, from) -> events.add(from + ": " + text.value()));
        assertThatThrownBy(() -> answer(display, robot.address()))
                .as("answered by the server after its subscription")
                .isInstanceOf(BusException.class)
                .hasMessageContaining("the server does not permit it to node display");
        assertThat(next(losses)).contains("troupe.n.robot1");
        robot.publish(topic, new Text("moving"));
        assertThat(next(events)).isEqualTo("robot1/port: moving");

        display.publish(topic, new Text("stop"));
        assertThat(next(losses)).contains("the server does not permit it to node display", "troupe.t.robot1.state");
        robot.publish(new BusTopic<>("robot2/drive", Text.class), new Text("go"));
        assertThat(next(losses)).contains("the server does not permit it to node robot1", "troupe.t.robot2.drive");
    }

    @Test
    void nodesAtTheHubAndAtALeaf_askEachOther_andThoseAtTheLeafGoOnWithoutTheHub() throws Exception {
        NatsServer.assumeInstalled();
        int leafPort = NatsServer.freePort();
        String text = Files.readString(HOSTS.resolve("nats.conf"));
        assertThat(text).contains("  port: 7422\n");
        var file = Files.writeString(
                folder.resolve("nats.conf"), text.replace("  port: 7422\n", "  port: " + leafPort + "\n"));
        var hub = start(file, USER);
        var leaf = start(
                HOSTS.resolve("leaf.conf"),
                Map.of(
                        "TROUPE_USER",
                        "robots",
                        "TROUPE_PASSWORD",
                        "secret",
                        "TROUPE_HUB",
                        "nats-leaf://robots:secret@127.0.0.1:" + leafPort));

        var base = speller("base", settingsAt(hub));
        var robot = speller("robot", settingsAt(leaf));
        var arm = speller("arm", settingsAt(leaf));
        assertThat(answerAtLast(base, robot.address())).isEqualTo("number 7");
        assertThat(answerAtLast(robot, base.address())).isEqualTo("number 7");

        hub.kill();
        assertThat(answer(robot, arm.address())).isEqualTo("number 7");
        assertThat(answer(arm, robot.address())).isEqualTo("number 7");
        assertThatThrownBy(() -> askUntilTheHubIsMissed(robot))
                .hasMessageEndingWith("no node of that name is connected now");
    }

    private static NatsSettings settingsAt(NatsServer server) {
        return server.settings().withUser("robots", "secret");
    }

    /** A request that was sent before the leaf noticed the end of the hub has no answer. */
    private static void askUntilTheHubIsMissed(BusPort asker) throws Exception {
        while (true) {
            try {
                asker.ask(new Address("base", "port"), SPELL, new Count(7), SECOND)
                        .get(LONG);
            } catch (BusTimeoutException notYet) {
                assertThat(notYet).hasMessageContaining("no answer within");
            }
        }
    }
}
