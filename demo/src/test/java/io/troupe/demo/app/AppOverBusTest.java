package io.troupe.demo.app;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.bus.nats.NatsBus;
import io.troupe.bus.nats.NatsSettings;
import io.troupe.demo.CommandLineBench;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.tools.NatsServerProcess;
import io.troupe.view.WallClockPacer;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Executors;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe app --bus}: an application that several processes run; here they are threads of one. */
@Timeout(value = 5, unit = TimeUnit.MINUTES)
class AppOverBusTest extends CommandLineBench {
    private static final Path FILE = Path.of("applications", "two-hosts.app");
    private static final String APP = "app applications/two-hosts.app ";

    /** A node, its report, and what it has printed. */
    private static final class Node {
        private final Semaphore changes;
        private final StringWriter text = new StringWriter() {
            @Override
            public void flush() { // of each line
                changes.release();
            }
        };
        private final AppReport report = new AppReport(new PrintWriter(text));
        private final AtomicBoolean stop = new AtomicBoolean();
        private final CompletableFuture<Boolean> ended;

        /** @param changes released when robots may have moved, and here when the node has printed or ended */
        Node(String name, String bus, int port, Semaphore changes) throws IOException {
            this.changes = changes;
            var plan = ApplicationReader.read(
                    FILE, ComponentKinds.standard(), Map.of("host", "127.0.0.1", "port", String.valueOf(port)));
            var run =
                    new AppOverBus(FILE, plan, settings -> NatsBus.open(name, NatsSettings.at(bus), settings), report);
            ended = CompletableFuture.supplyAsync(
                    () -> {
                        try {
                            run.run(1_000, stop::get);
                            return true;
                        } catch (InterruptedException e) {
                            throw new IllegalStateException(e);
                        }
                    },
                    task -> Thread.ofPlatform().daemon().name("node " + name).start(task));
            ended.whenComplete((done, error) -> changes.release());
        }

        /** Stops it, and returns what it has printed. */
        String stop() throws Exception {
            stop.set(true);
            ended.get(2, TimeUnit.MINUTES);
            return text.toString();
        }

        /** Waits until it has printed that. */
        void await(String part) throws InterruptedException {
            String printed = text.toString();
            while (!printed.contains(part)) {
                assertThat(ended).as(printed).isNotDone();
                changes.acquire();
                printed = text.toString();
            }
        }

        void awaitDistance(double metres) throws InterruptedException {
            double first1 = report.odometryM("robot1");
            double first2 = report.odometryM("robot2");
            while (report.odometryM("robot1") < first1 + metres || report.odometryM("robot2") < first2 + metres) {
                assertThat(ended).as(() -> text.toString()).isNotDone();
                changes.acquire();
            }
        }
    }

    @Test
    void shippedApplication_runsOnTwoNodes_andTheReservesDriveWhenOneIsLost() throws Exception {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.cfg"));
        try (var server = NatsServerProcess.start();
                var simulation = Simulation.open(scenario, WorldSettings.defaults());
                var tcp = TcpServer.open(PlayerPorts.find(6665).orElseThrow(), 0);
                var world = Executors.newSingleThreadExecutor()) {
            simulation.lockStep(false);
            var stop = new AtomicBoolean();
            var changes = new Semaphore(0);
            var moved = world.submit(() -> {
                var pacer = new WallClockPacer();
                while (!stop.get()) {
                    pacer.await(simulation.tick().timeMicros());
                    changes.release();
                }
            });
            try {
                var laptop = new Node("laptop", server.address(), tcp.port(), changes);
                laptop.await("laptop serves follower, wanderer for two-hosts");
                var base = new Node("base", server.address(), tcp.port(), changes);
                base.awaitDistance(0.2);
                assertThat(laptop.text.toString()).contains("started    follower", "started    wanderer");

                assertThat(laptop.stop()).contains("stopped    follower");
                base.await("connected  robot1 with reserve1");
                base.await("connected  robot2 with reserve2");
                base.awaitDistance(0.2);
                assertThat(base.stop())
                        .contains("connected  robot1 with follower: robot1/position -> follower/position")
                        .containsPattern("two-hosts over a bus, [0-9.]+ s")
                        .containsPattern("robot1 +[0-9.]+ m by odometry +[0-9]+ loops over the bus");
            } finally {
                stop.set(true);
                moved.get(1, TimeUnit.MINUTES);
            }
        }
    }

    @Test
    void nodeThatIsMissing_isStatus3_andOneLine() throws Exception {
        assumeTrue(NatsServerProcess.isInstalled(), NatsServerProcess.HOW_TO_GET + "; not tested");
        try (var server = NatsServerProcess.start()) {
            assertFails(
                    3,
                    APP + "--robots localhost:1 --name base --bus " + server.address(),
                    "troupe: \"two-hosts\" needs node \"laptop\" for follower, wanderer, and has not found it within 5 s");
        }
    }

    @Test
    void sameFile_runsInOneProcessToo_andIsTheOneOfTheGuide() throws IOException {
        assertThat(printed("app --world worlds/paper-arena.cfg --out DIR/o applications/two-hosts.app --seconds 2"))
                .contains("connected  robot1 with follower", "two-hosts on paper arena, 2.0 s simulated");
        String guide = Files.readString(Path.of("..", "docs", "guide", "09-components.md"));
        List<String> lines = Files.readAllLines(FILE).stream()
                .filter(line -> !line.startsWith("#") && !line.isBlank())
                .toList();
        assertThat(guide)
                .contains(lines.stream().map(line -> "    " + line + "\n").toList());
    }

    @Test
    void wrongOptions_areRefused() throws IOException {
        String bus = "--bus nats://localhost:1 ";
        assertRefused(APP + "--robots base:6665", "--robots is base:6665, but there is no bus: expected --bus as well");
        assertRefused(APP + "--name base", "--name is base, but there is no bus");
        assertRefused(APP + bus + "--name base", "--robots is missing, expected HOST:PORT");
        assertRefused(APP + bus + "--name base --robots base", "--robots is 'base', expected the address");
        assertRefused(APP + bus + "--name base --robots base:1 --realtime", "--realtime is given with --bus");
        assertRefused(APP + bus + "--name base --robots base:1 --world x.world", "--world is given with --bus");
        assertRefused(
                APP + bus + "--name labtop --robots base:1",
                "--name is labtop, which is no node with components of applications/two-hosts.app; did you mean"
                        + " \"laptop\"? expected one of base, laptop");
        file("one.app", "application one\n");
        assertRefused(
                "app DIR/one.app " + bus + "--name base --robots base:1",
                "DIR/one.app names no nodes, expected \"application one on NODE,NODE\" for --bus");
        assertThat(printed("app --help")).contains("--robots", "--bus-password-file");
    }
}
