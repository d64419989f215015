package io.troupe.demo.app;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.MissingServiceException;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.demo.CommandLineBench;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationEvent;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.application.ApplicationSettings;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.sim.Simulation;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import io.troupe.view.RunLog;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe app}, and a component that is a process in another language. */
@Timeout(120)
class AppCommandTest extends CommandLineBench {
    private static final String APP = "app --world worlds/paper-arena.cfg --out DIR/out ";

    @Test
    @Timeout(60)
    void shippedApplication_findsStartsConnectsReplacesAndSums_andWritesPictureAndLog() throws IOException {
        assertThat(printed(APP + "applications/two-robots.app --seconds 32"))
                .contains(
                        "0.0 s  offered    wanderer (service spaceWanderer; drives, wanders)",
                        "0.0 s  started    follower (service wallFollower; drives, followsWalls)",
                        "0.0 s  connected  robot2 with wanderer: robot2/position -> wanderer/position, robot2/sonar ->"
                                + " wanderer/sonar, wanderer/velocity -> robot2/velocity",
                        "30.0 s  replaced   follower by relief",
                        "32.0 s  stopped    robots",
                        "two-robots on paper arena, 32.0 s simulated")
                .containsPattern("robot 1 +[0-9.]+ m +320 loops over the bus  0 contacts")
                .containsPattern("robot 2 +[0-9.]+ m +320 loops over the bus  0 contacts")
                .doesNotContain("told", "problem", "lost")
                .endsWith(local("wrote DIR/out/trajectory.svg and DIR/out/run.jsonl\n"));
        assertThat(written("out/trajectory.svg"))
                .containsPattern("<title>paper arena: 2 robots drive [0-9.]+ m in 32 s</title>")
                .doesNotContain("Tag s2");
        assertThat(written("out/run.jsonl").lines())
                .startsWith("{\"t\":0.0,\"type\":\"header\",\"format\":\"troupe-run\",\"version\":1,\"program\":\""
                        + RunLog.PROGRAM
                        + "\",\"world\":\"paper arena\",\"robots\":2,\"seconds\":32.0,\"interval\":0.1}")
                .filteredOn(line -> line.contains("\"pose\""))
                .hasSize(2 * 321)
                .allSatisfy(line -> assertThat(line).contains("\"service\":\"none\""));
        assertThat(written("out/run.jsonl"))
                .contains("\"type\":\"summary\",\"switches\":0")
                .doesNotContain("\"charge\"");
        assertThat(printed("export DIR/out/run.jsonl --world worlds/paper-arena.cfg --csv DIR/tables"))
                .contains("321 readings");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    @Timeout(60)
    void shippedApplication_tellsWhichColoursComeIntoSightOfItsCamera() {
        assertThat(printed(APP + "applications/two-robots.app --seconds 120"))
                .containsPattern(
                        "(?s)[0-9.]+ s  seen       finder sees green\\R.*[0-9.]+ s  seen       finder sees red\\R")
                .doesNotContain("sees black", "sees orange"); // walls and the other robot
    }

    @Test
    @Timeout(60)
    void missingService_isStatus3_andOneLine_afterEverythingHasBeenStopped() throws IOException {
        String shipped = Files.readString(Path.of("applications", "two-robots.app"));
        file("my.app", shipped.replace("needs service wallFollower", "needs service wallFolower"));
        assertThat(troupe(APP + "DIR/my.app")).isEqualTo(3);
        assertThat(err.toString().lines())
                .singleElement()
                .asString()
                .startsWith("troupe: ")
                .contains("\"robot1\"", "\"wallFolower\"", "did you mean \"wallFollower\"?")
                .contains("registered: player", "spaceWanderer");
        assertThat(out.toString()).contains("started    robots", "stopped    robots");
        assertThat(written("out/run.jsonl")).endsWith("\"cutShort\":\"failed\"}\n");
    }

    @Test
    @Timeout(60)
    void mistakes_areStatus2_andToldWithTheirPlace_andARobotThatTwoDriveStatus1() throws IOException {
        file("my.app", "application a\ncomponent r is plyer\n");
        String kind = "there is no kind of component \"plyer\"; did you mean \"player\"?";
        assertRefused(APP + "DIR/my.app", "troupe: DIR/my.app:2:16: " + kind);
        assertMissing("out");
        assertRefused(APP, "FILE is missing");
        assertRefused(APP + "x.app --seconds 0", "--seconds is 0.0, expected");
        String expected = ", expected the file of a declaration (see troupe app --help)";
        String places = ", expected the file of a declaration; looked in ";
        assertRefused(APP + "no-such.app", places);
        assertThat(err.toString()).startsWith("troupe: no-such.app: no such file" + places);
        assertRefused(APP + "applications", expected);
        assertThat(err.toString().strip()).isEqualTo("troupe: applications: a directory" + expected);

        file("my.app", """
                application quarrel
                component robots is player port=${port}
                component a is wallFollower
                component b is spaceWanderer
                quarrel needs service player
                robot1 needs service wallFollower
                robot1 needs service spaceWanderer
                """);
        assertFails(1, APP + "DIR/my.app", "troupe: robot1/velocity would be fed twice");
    }

    @Test
    @Timeout(60)
    void list_namesTheKindsAndWhatCanBeSaidOfThem_andAComponentMayHaveAnyName() throws IOException {
        assertThat(printed(APP + "--list"))
                .contains("player", "wallFollower", "spaceWanderer", "colourFinder", "process", "robots=", "run=");

        file("my.app", """
                application a
                component report        is wallFollower
                component a.application is spaceWanderer
                a needs service wallFollower
                """);
        printed(APP + "DIR/my.app --seconds 0.2");
    }

    // ---- a process, started by the broker, that connects over TCP by the Player protocol

    private static final Path FILE = Path.of("applications", "python.app");
    private static final Pattern PROCESS = Pattern.compile("process ([0-9]+): .*");

    private final List<Long> processes = new CopyOnWriteArrayList<>();
    private final List<String> events = new CopyOnWriteArrayList<>();

    private final ComponentObserver observer = new ComponentObserver() {
        @Override
        public void dropped(Address component, ApplicationData<?> lost, long total) {
            events.add("dropped " + lost);
        }

        @Override
        public void problem(Address component, String what, Throwable why) {
            events.add("problem: " + component.name() + " " + what + ": " + why.getMessage());
        }

        @Override
        public void info(Address component, String what) {
            var process = PROCESS.matcher(what);
            if (process.matches()) {
                processes.add(Long.valueOf(process.group(1)));
            }
        }
    };

    /** What a test does with a running application. */
    private interface Script {
        void run(Simulation simulation, ActorSpace space, Application application) throws Exception;
    }

    private void run(BrokerSettings brokerSettings, Script script) throws Exception {
        boolean found;
        try {
            found = new ProcessBuilder("python3", "--version").start().waitFor() == 0;
        } catch (IOException notThere) {
            found = false;
        }
        assumeTrue(found, "there is no python3 on this machine");
        var scenario = ScenarioReader.read(Path.of("worlds", "paper-arena.cfg"));
        try (var simulation = Simulation.open(scenario, AppRun.WORLD);
                var tcp = TcpServer.open(PlayerPorts.find(6665).orElseThrow(), 0);
                var space = ActorSpace.create(SpaceSettings.named("application").withClock(simulation.clock()))) {
            script.run(simulation, space, start(space, tcp.port(), brokerSettings));
        }
    }

    private static void tick(Simulation simulation, int times) {
        for (int tick = 0; tick < times; tick++) {
            simulation.tick();
        }
    }

    private static Pose pose(Simulation simulation, int robot) {
        return simulation.latest().robots().get(robot).pose();
    }

    private void note(ApplicationEvent event) {
        if (event instanceof ApplicationEvent.Lost lost) {
            events.add("lost: " + lost.why().getMessage());
        }
    }

    private void note(BrokerEvent event) {
        if (event instanceof BrokerEvent.Failed failed) {
            var provider = failed.provider();
            events.add("failed: " + provider.provider().name() + " " + provider.health());
        }
    }

    private Application start(ActorSpace space, int tcpPort, BrokerSettings brokerSettings) throws Exception {
        // with a second connection to the script's robot, so that the server does not stop the robot when the script's
        // connection closes
        String text = ApplicationReader.text(FILE).replace("robots=1\n", "robots=1,2\n");
        var plan = ApplicationReader.parse(
                text, FILE, ComponentKinds.standard(), Map.of("port", "6665", "tcp", String.valueOf(tcpPort)));
        var application = new CompletableFuture<Application>();
        space.execute(() -> application.complete(Application.start(
                plan,
                Bus.inProcess("here", BusSettings.on(space)),
                ApplicationSettings.defaults()
                        .withBroker(brokerSettings.withObserver(this::note))
                        .withComponentObserver(observer)
                        .withObserver(this::note))));
        Application begun = application.get(60, TimeUnit.SECONDS);
        begun.started().get(Duration.ofSeconds(60));
        return begun;
    }

    @Test
    void robotInTheCareOfAPythonScript_moves_andItsUserHearsWhenTheProcessIsKilled() throws Exception {
        run(BrokerSettings.defaults().withoutRestart(), (simulation, space, application) -> {
            var before = List.of(pose(simulation, 0), pose(simulation, 1));
            tick(simulation, 100);
            for (int robot = 0; robot < 2; robot++) {
                var from = before.get(robot);
                var to = pose(simulation, robot);
                assertThat(StrictMath.hypot(to.x() - from.x(), to.y() - from.y()))
                        .as("metres that robot %d has come", robot + 1)
                        .isGreaterThan(0.5);
            }
            var process = ProcessHandle.of(processes.getFirst()).orElseThrow();
            process.destroyForcibly();
            process.onExit().get(60, TimeUnit.SECONDS);
            while (events.stream().noneMatch(event -> event.startsWith("problem: snake has failed"))) {
                Thread.onSpinWait(); // simulated time passes faster than the machine reports the exit of a process
            }
            tick(simulation, 6);
            var stopped = pose(simulation, 1);
            tick(simulation, 1);
            assertThat(pose(simulation, 1)).isEqualTo(stopped);
            for (int tick = 0; tick < 300 && !application.ended().isDone(); tick++) {
                simulation.tick();
            }
            assertThat(application.ended().error())
                    .isInstanceOf(MissingServiceException.class)
                    .hasMessageContainingAll("two-languages", "pythonWanderer");
            assertThat(events).contains("failed: snake FAILED");
            assertThat(events)
                    .anySatisfy(event -> assertThat(event)
                            .startsWith("lost: \"two-languages\" needs the service \"pythonWanderer\"")
                            .contains("wanderer.py"));
            assertThat(processes).hasSize(1);
        });
        assertThat(ProcessHandle.of(processes.getFirst()).filter(ProcessHandle::isAlive))
                .isEmpty();
    }

    @Test
    void twoRuns_areTheSame_asTheScriptIsInLockStep() throws Exception {
        var ends = new ArrayList<String>();
        for (int i = 0; i < 2; i++) {
            run(BrokerSettings.defaults(), (simulation, space, application) -> {
                tick(simulation, 100);
                ends.add(pose(simulation, 0) + " " + pose(simulation, 1));
                application.close();
                assertThat(application.ended().isDone()).isTrue();
            });
        }
        assertThat(ends).hasSize(2);
        assertThat(ends.get(0)).isEqualTo(ends.get(1));
    }
}
