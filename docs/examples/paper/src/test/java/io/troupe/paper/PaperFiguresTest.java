package io.troupe.paper;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.LeasedRobots;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.SubsumptionRun;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PrintStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.FutureTask;
import java.util.function.Consumer;
import java.util.function.Predicate;
import java.util.regex.Pattern;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/**
 * The paper's connection with a robot gets data, and its main code drives the robots of its arena with the same result
 * as our modes. The tests read what the programs print.
 */
@Timeout(120)
class PaperFiguresTest {
    private static final int TICKS = 3_000;
    private static final Pattern WALL_CLOCK = Pattern.compile("(received color) \\d{13}");

    private final PrintStream standardOutput = System.out;
    private final PrintStream standardError = System.err;
    private final ByteArrayOutputStream errors = new ByteArrayOutputStream();
    private final ByteArrayOutputStream printed = new ByteArrayOutputStream();
    private final List<String> ours = new ArrayList<>();

    @BeforeEach
    void readWhatIsPrinted() {
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8));
    }

    @AfterEach
    void restore() {
        System.setOut(standardOutput);
        System.setErr(standardError);
    }

    private String takePrinted() {
        String text =
                WALL_CLOCK.matcher(printed.toString(StandardCharsets.UTF_8)).replaceAll("$1 MILLIS");
        printed.reset();
        return text;
    }

    private static Simulation open() {
        return Simulation.open(PaperRobots.Arena.scenario(), WorldSettings.defaults());
    }

    private static void tick(Simulation simulation, int times) {
        for (int tick = 0; tick < times; tick++) {
            simulation.tick();
        }
    }

    /** Prefixes each line that is printed with the simulated time. */
    private void stamp(Clock clock) {
        System.setOut(new PrintStream(printed, true, StandardCharsets.UTF_8) {
            @Override
            public void println(String line) {
                super.println(stamped(clock, line));
            }

            @Override
            public void println(int number) {
                super.println(stamped(clock, "" + number));
            }
        });
    }

    private static String stamped(Clock clock, String line) {
        return clock.nanos() / 1_000_000 + " ms " + line;
    }

    /** The lines about states, and with {@code colours} the last line before each that has a colour. */
    private static List<String> changes(String text, Predicate<String> isColour) {
        List<String> changes = new ArrayList<>();
        String colour = "";
        for (String line : text.lines().toList()) {
            if (line.matches("\\d+ ms State \\d")) {
                if (!colour.isEmpty()) {
                    changes.add(colour);
                }
                changes.add(line);
            } else if (isColour.test(line)) {
                colour = line;
            }
        }
        return changes;
    }

    private void assertSameThroughAllThreeStates(List<String> ofThePaper) {
        assertThat(ofThePaper)
                .hasSizeGreaterThan(6)
                .anyMatch(line -> line.endsWith("State 2"))
                .anyMatch(line -> line.endsWith("State 3"))
                .isEqualTo(ours);
        assertThat(ofThePaper.getFirst()).isEqualTo("0 ms State 1");
    }

    // ---- Figure 7

    /** The program solves the paper's first challenge: data are ready before a service starts. */
    @Test
    @Timeout(60)
    void connectionOfFigure7_getsSensorData() {
        Figure7.main(new String[0]);
        assertThat(takePrinted().lines())
                .hasSize(3)
                .satisfiesExactly(
                        sonar -> assertThat(sonar.split(",")).hasSize(16),
                        position -> assertThat(position).isEqualTo("position ready: 0.0, 0.0, 0.0"),
                        blobs -> assertThat(blobs).isEqualTo("blobfinder ready: 0 blobs")); // nothing within its 2 m
    }

    @Test
    @Timeout(60)
    void connectionOfFigure7_withoutAServer_printsWhatThePaperPrints_andEndsTheProgram()
            throws IOException, InterruptedException {
        int port;
        try (var free = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            port = free.getLocalPort();
        }
        var ended = start(Figure7.class, "127.0.0.1:" + port);
        assertThat(ended.errors().lines()).hasSize(2).first().isEqualTo("robot1: > Error connecting to Player: ");
        assertThat(ended.errors())
                .contains("    [ io.troupe.player.PlayerException: [PlayerClient]: Error in PlayerClient init: ")
                .contains("127.0.0.1:" + port);
        assertThat(ended.status()).isEqualTo(1);
    }

    // ---- Figures 14, 17 and 20

    @Test
    void demo1OfFigure14_goesThroughAllThreeStates_asTheSynchronousModeDoes() throws Exception {
        try (var simulation = open()) {
            stamp(simulation.clock());
            var demo = new Demo1("localhost", 6665, TICKS / 10.0 - 1); // connected before time begins
            var main = new FutureTask<>(demo::run, null);
            Thread.ofPlatform().name("Demo1").start(main);
            tick(simulation, TICKS);
            main.get();
        }
        var ofThePaper = changes(takePrinted(), line -> false);
        try (var simulation = open()) {
            Arbitrator.StateListener listener =
                    (state, seenBy) -> ours.add(stamped(simulation.clock(), "State " + state.number()));
            var robots = RobotServicesActor.Settings.defaults();
            var settings = SubsumptionRun.Settings.defaults()
                    .withMode(Mode.SYNC)
                    .withRobots(robots)
                    .withClock(simulation.clock())
                    .withListener(listener);
            try (var run = SubsumptionRun.start(settings)) {
                tick(simulation, TICKS);
                run.check();
            }
        }
        assertSameThroughAllThreeStates(ofThePaper);
    }

    /** Starts main code on a space, which follows the clock of the simulated world. */
    private void drive(Consumer<ActorSpace> application) {
        var problems = new ArrayList<Throwable>();
        try (var simulation = open();
                var space = ActorSpace.create(SpaceSettings.named("robots")
                        .withClock(simulation.clock())
                        .withoutThread()
                        .withOnError((where, error) -> problems.add(error)))) {
            stamp(simulation.clock());
            simulation.whileWaiting(space::runQueued);
            application.accept(space);
            space.runQueued();
            tick(simulation, TICKS);
        }
        assertThat(problems).isEmpty();
    }

    /** Our arbitrator and robot services, which connect anew for each service, as the paper's do. */
    private Consumer<ActorSpace> arbitrator(Mode mode, String colourPrefix) {
        return space -> {
            var table = SubsumptionTable.ofThePaper();
            var settings = RobotServicesActor.Settings.defaults().withReconnection(true);
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServicesActor(settings));
            Arbitrator.StateListener listener = (state, seenBy) -> {
                if (seenBy != null) {
                    ours.add(stamped(space.clock(), colourPrefix + state.colour()));
                }
                ours.add(stamped(space.clock(), "State " + state.number()));
            };
            space.spawn(Arbitrator.class, () -> new Arbitrator(mode, LeasedRobots.of(services), table, listener))
                    .live();
        };
    }

    @Test
    void demo2OfFigure17_goesThroughAllThreeStates_asTheArbitratorDoes() {
        drive(space -> Demo2.start(space, "localhost", 6665));
        String text = takePrinted();
        drive(arbitrator(Mode.CALLBACK, ""));
        assertSameThroughAllThreeStates(changes(text, line -> line.matches("\\d+ ms \\d+")));
        assertThat(text.lines().filter(line -> line.endsWith("ms 16753920")))
                .as("orange, the colour of the other robot, is sent and changes nothing")
                .hasSizeGreaterThan(10);
    }

    @Test
    void demo3OfFigure20_goesThroughAllThreeStates_asTheArbitratorDoes() {
        drive(space -> Demo3.start(space, "localhost", 6665));
        String text = takePrinted();
        drive(arbitrator(Mode.PROMISE, "color"));
        assertSameThroughAllThreeStates(changes(text, line -> line.contains(" ms color")));
        assertThat(text.lines())
                .as("each colour is sent once, and each changes the state")
                .hasSameSizeAs(ours);
    }

    // ---- the programs as they are started

    @ParameterizedTest
    @CsvSource({"14, 0", "17, received color MILLIS", "20, color65280"})
    void programs_printTheSameInEachRun_andEnd(int figure, String line) {
        String first = printedBy(figure, "--seconds", "120");
        assertThat(first.lines()).startsWith("State 1").contains(line, "State 3");
        for (int i = 0; i < 3; i++) {
            assertThat(printedBy(figure, "--seconds", "120")).isEqualTo(first);
        }
    }

    /** What a program prints, which ends without an error. */
    private String printedBy(int figure, String... arguments) {
        System.setErr(new PrintStream(errors, true, StandardCharsets.UTF_8));
        switch (figure) {
            case 14 -> Demo1.main(arguments);
            case 17 -> Demo2.main(arguments);
            default -> Demo3.main(arguments);
        }
        assertThat(errors.toString(StandardCharsets.UTF_8)).isEmpty();
        return takePrinted();
    }

    @ParameterizedTest
    @CsvSource({"14", "17", "20"})
    void programs_driveTheRobotsOfAServer(int figure) {
        String here = printedBy(figure, "--seconds", "120");
        try (var simulation = open();
                var server = TcpServer.open(PlayerPorts.find(6665).orElseThrow(), 0);
                var runner =
                        SimulationRunner.start(simulation, figure == 14 ? 1 : 3, each -> {}, new Pace.OfAnswers())) {
            String there = printedBy(figure, "127.0.0.1:" + server.port(), "--seconds", "120");
            assertThat(there).startsWith(here.substring(0, here.lastIndexOf("State")));
            assertThat(runner.isRunning()).isTrue();
        }
    }

    @Test
    void wrongArgument_isNamed_withWhatIsExpected() throws IOException, InterruptedException {
        var ended = start(Demo3.class, "--second", "10");
        assertThat(ended).isEqualTo(new Ended(2, "an argument is '--second', expected [HOST:PORT] [--seconds N]\n"));
        assertThat(start(Demo3.class, "--seconds", "no").errors())
                .isEqualTo("--seconds is 'no', expected a number above 0\n");
    }

    private record Ended(int status, String errors) {}

    /** Runs a program in another JVM. */
    private static Ended start(Class<?> program, String... arguments) throws IOException, InterruptedException {
        var java = Path.of(System.getProperty("java.home"), "bin", "java").toString();
        var command = new ArrayList<>(List.of(java, "-cp", System.getProperty("java.class.path"), program.getName()));
        command.addAll(List.of(arguments));
        var process = new ProcessBuilder(command).start();
        String errors = new String(process.getErrorStream().readAllBytes(), StandardCharsets.UTF_8);
        return new Ended(process.waitFor(), errors.replace("\r\n", "\n"));
    }
}
