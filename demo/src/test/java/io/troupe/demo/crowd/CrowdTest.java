package io.troupe.demo.crowd;

import static io.troupe.demo.ParsedSvg.number;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.demo.ParsedSvg;
import io.troupe.demo.crowd.CrowdReport.Row;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.LeasedRobots;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.State;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableException;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.worldfile.CrowdWorld;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunResult;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import java.util.function.ToDoubleFunction;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import javax.imageio.ImageIO;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.w3c.dom.Element;

/** Tables, runs in the real world with real threads, and the figure of crowds. */
@Timeout(300)
class CrowdTest {
    private static SubsumptionTable table(int robots, int colours, int services, double holdSeconds) {
        return CrowdTable.of(robots, CrowdWorld.colours(colours), services, holdSeconds, CornerStyle.FORWARD);
    }

    private static SubsumptionTable table(int robots, int colours, int services) {
        return table(robots, colours, services, CrowdTable.HOLD_SECONDS);
    }

    @ParameterizedTest
    @CsvSource({"1, 1, 1", "1, 8, 2", "1, 5, 7", "2, 3, 2", "7, 8, 3", "50, 8, 3", "50, 100, 100", "1000, 8, 20"})
    void table_ofAnySize_hasAStateForEachColourAndSomebodyInItWhoLooksForColours(
            int robots, int colours, int services) {
        SubsumptionTable table = table(robots, colours, services);

        assertThat(table.robots()).isEqualTo(robots);
        assertThat(table.holdSeconds()).isEqualTo(CrowdTable.HOLD_SECONDS);
        assertThat(table.states()).extracting(State::colour).isEqualTo(CrowdWorld.colours(colours));
        assertThat(table.states()).allMatch(State::canEnd);
        assertThat(table.services().size()).isLessThanOrEqualTo(services + (robots == 1 ? 1 : 0));
    }

    @Test
    void states_withRobotsEnough_haveAllServices_whichTheNextStateMovesOn_andALoneWallFollowerWanders() {
        assertThat(table(20, 6, 20).states())
                .hasSize(6)
                .allSatisfy(state -> assertThat(new HashSet<>(state.services())).hasSize(20));
        var states = table(9, 3, 3).states();
        assertThat(states.get(1).services())
                .hasSize(9)
                .zipSatisfy(
                        states.get(0).services(),
                        (next, service) -> assertThat(next).isNotEqualTo(service));

        assertThat(table(1, 2, 2).states())
                .extracting(state -> state.services().getFirst())
                .containsOnly(Service.SPACE_WANDERER);
    }

    private static SubsumptionTable read(int robots) {
        String states = "\nstate blue : * = spaceWanderer\nstate red : * = spaceWanderer";
        return SubsumptionTableReader.parse(
                "robots " + robots + states, Path.of("largest"), ServiceCatalogue.standard());
    }

    @Test
    void tableOfTheLargestCrowd_canBeAFile() {
        int most = CrowdWorld.MOST_ROBOTS;
        assertThat(read(most).robots()).isEqualTo(most);
        assertThatThrownBy(() -> read(most + 1))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessageContaining("a number of robots, 1 to " + most);
    }

    // ---- runs

    private static final int COLOURS = 8;

    private RunResult run(int robots, double holdSeconds, double seconds, Mode mode, String file) throws Exception {
        var settings = RecordedRun.Settings.defaults().withMode(mode).withSeconds(seconds);
        var scenario = CrowdWorld.scenario(robots, COLOURS);
        return new RecordedRun(scenario, table(robots, COLOURS, 3, holdSeconds), settings).run(out.resolve(file));
    }

    @Test
    void thousandRobots_thatAllSwitchInOneTick_haveOneServiceEachAtEveryTick() throws Exception {
        RunResult result = run(1000, 0, 1, Mode.PROMISE, "run.jsonl");

        int switches = result.states().size() - 1;
        assertThat(switches).isPositive();
        var last = result.states().getLast().state().services();
        assertThat(result.robots()).hasSize(1000).allSatisfy(robot -> {
            assertThat(robot.chargeFaults()).isZero();
            assertThat(robot.ticksWithoutCycle()).isZero();
            assertThat(robot.loops().values().stream().mapToLong(loops -> loops).sum())
                    .as("a loop for each reading, and one more for each switch")
                    .isEqualTo(10 + switches);
            assertThat(robot.serviceName()).isEqualTo(last.get(robot.index()).name());
        });
    }

    @Test
    void hold_keepsAState() throws Exception {
        var states = run(200, 2, 10, Mode.PROMISE, "run.jsonl").states();

        assertThat(states).hasSizeBetween(2, 5);
        for (int i = 1; i < states.size(); i++) {
            assertThat(states.get(i).timeMicros() - states.get(i - 1).timeMicros())
                    .isGreaterThanOrEqualTo(2_000_000);
        }
    }

    @Test
    void sameSeed_sameFile_inEveryMode() throws Exception {
        for (Mode mode : Mode.values()) {
            run(50, 1, 5, mode, mode + "1");
            run(50, 1, 5, mode, mode + "2");
            assertThat(out.resolve(mode + "2")).hasSameBinaryContentAs(out.resolve(mode + "1"));
        }
    }

    @Test
    void crowd_logsItsPosesOnceASecond_andIsToldOfInSumsAndExtremes() throws Exception {
        RunResult result = run(50, 1, 3, Mode.PROMISE, "run.jsonl");

        assertThat(Files.readAllLines(out.resolve("run.jsonl")))
                .filteredOn(line -> line.contains("\"type\":\"pose\""))
                .hasSize(50 * 4);
        assertThat(result.summary())
                .contains("50 robots", "mean", "least", "most", "cycles of avoid > patrol1")
                .doesNotContain("robot 1 ");
        assertThat(result.states().getFirst().describe(result.table()))
                .endsWith("state 1: 16 avoid > patrol1, 17 spaceWanderer, 17 wallFollower");
    }

    @Test
    void picture_ofACrowd_hasAllBodies_eachWithAColourAndItsNumber() throws Exception {
        RunResult result = run(50, 1, 3, Mode.PROMISE, "run.jsonl");

        String svg = Pictures.trajectory(CrowdWorld.scenario(50, COLOURS).world(), result);

        var picture = ParsedSvg.parse(svg);
        assertThat(picture.elements("polygon", "stroke", "#444444"))
                .extracting(body -> body.getAttribute("fill"))
                .hasSize(50)
                .doesNotHaveDuplicates();
        assertThat(picture.elements("text", "font-weight", "bold"))
                .extracting(Element::getTextContent)
                .containsExactlyElementsOf(
                        IntStream.rangeClosed(1, 50).mapToObj(Integer::toString).toList());
        assertThat(svg).contains("50 robots, 3.0 s simulated");
    }

    /** Messages served per robot and tick by the actor space of broker, services and arbitrator. */
    private static double servedPerRobot(int robots) throws InterruptedException {
        int ticks = 10;
        var table = table(robots, COLOURS, 3);
        try (var simulation = Simulation.open(CrowdWorld.scenario(robots, COLOURS), WorldSettings.defaults());
                var space = ActorSpace.create(SpaceSettings.named("crowd").withClock(simulation.clock()))) {
            var settings = RobotServicesActor.Settings.defaults().withTable(table);
            var broker = Broker.open(space, BrokerSettings.defaults());
            var actors = broker.services();
            var type = RobotServices.class;
            actors.publish(space, type, RobotServices.SERVICE, List.of(), () -> new RobotServicesActor(settings));
            var need = Need.ofService("arbitrator", RobotServices.SERVICE);
            var services = actors.connect(
                            type, need, ConnectionSettings.defaults().withoutAnswerLimit())
                    .actor();
            Arbitrator.StateListener nobody = (state, seenBy) -> {};
            space.spawn(Arbitrator.class, () -> new Arbitrator(Mode.PROMISE, LeasedRobots.of(services), table, nobody))
                    .live();
            var begun = new CountDownLatch(1);
            space.onIdle(begun::countDown);
            begun.await();
            simulation.tick(); // reaches the initial state and an idle space
            long before = space.metrics().served();
            for (int tick = 0; tick < ticks; tick++) {
                simulation.tick();
            }
            return (double) (space.metrics().served() - before) / ticks / robots;
        }
    }

    @Test
    @Timeout(120)
    void messagesOfATick_growAsTheCrowdDoes() throws Exception {
        double few = servedPerRobot(50);
        assertThat(few).isPositive();
        assertThat(servedPerRobot(500)).isCloseTo(few, within(few / 10));
    }

    // ---- the figure

    private static final List<Row> MEDIANS =
            List.of(row(1, 90, 31, 52), row(10, 40, 12, 25), row(100, 30, 10, 15), row(1000, 20, 7, 11));
    private static final Path DOCUMENTED = Path.of("..", "docs", "figures", "crowd.svg");
    /**
     * Columns: robots, speed with its extremes, speed by the wall clock, microseconds in total, of the world and of the
     * services.
     */
    private static final Pattern ROW = Pattern.compile(" +([\\d,]+) +([\\d,.]+) +\\(([\\d,.]+) \\.\\. ([\\d,.]+)\\)"
            + " +[\\d,.]+ +([\\d,.]+) +([\\d,.]+) +([\\d,.]+) +[\\d,.]+ +\\d+");

    @TempDir
    private Path out;

    /** A row with arbitrary values in all columns that the figure does not use. */
    private static Row row(int robots, double micros, double worldMicros, double servicesMicros) {
        return new Row(
                robots, 5.25, 502, 503, 504, micros, micros / 2, micros * 2, worldMicros, servicesMicros, 505, 506);
    }

    private static ParsedSvg drawn() throws Exception {
        return ParsedSvg.parse(new CrowdFigure(MEDIANS, 8, 3).chart().svg());
    }

    @Test
    void figure_saysWhatItShows_withUnitsAndWithoutPowersOfTen() throws Exception {
        var svg = drawn();

        String title = "1,000 robots run at 5.3 times real time on one core";
        assertThat(svg.title()).isEqualTo(title);
        assertThat(svg.texts())
                .contains(title, "µs for one robot and tick", "number of robots")
                .contains("1", "10", "100", "1,000", "10,000", "100,000")
                .contains("whole program", "world: physics, rays", "services and Player")
                .anyMatch(text -> text.startsWith("budget for real time"))
                .anyMatch(text -> text.contains("8 colours, 3 services"))
                .noneMatch(text -> text.matches("\\d+E\\d+"));
    }

    @Test
    void budget_isDashed_andWhereATickOf100MillisecondsIsUsedUp() throws Exception {
        var svg = drawn();

        assertThat(svg.elements("line"))
                .filteredOn(line -> !line.getAttribute("stroke-dasharray").isEmpty())
                .singleElement()
                .satisfies(dashed -> {
                    assertThat(number(dashed, "y1")).isCloseTo(yOf(svg, 100_000), within(0.2));
                    assertThat(number(dashed, "y2")).isCloseTo(yOf(svg, 100), within(0.2));
                });
    }

    /** The y coordinate of a decade, from its label, which is 4 px below its line. */
    private static double yOf(ParsedSvg svg, int micros) {
        return svg.elements("text", "text-anchor", "end").stream()
                .filter(text -> text.getTextContent().replace(",", "").equals(String.valueOf(micros)))
                .mapToDouble(text -> number(text, "y") - 4)
                .findFirst()
                .orElseThrow();
    }

    @Test
    void dotsAndQuartiles_lieWhereTheNumbersAre() throws Exception {
        var svg = drawn();

        double decadePx = yOf(svg, 10) - yOf(svg, 100);
        Map<String, ToDoubleFunction<Row>> lines =
                Map.of("#222222", Row::micros, "#1b9e9e", Row::worldMicros, "#7b3fa0", Row::servicesMicros);
        lines.forEach((colour, micros) -> {
            var dots = svg.elements("circle", "fill", colour);
            double leftPx = number(dots.getFirst(), "cx"); // of one robot
            double thousandfoldPx = number(dots.getLast(), "cx") - leftPx;
            assertThat(dots).as(colour).zipSatisfy(MEDIANS, (dot, row) -> {
                assertThat(yOf(svg, 10) - number(dot, "cy"))
                        .isCloseTo(decadePx * Math.log10(micros.applyAsDouble(row) / 10), within(0.2));
                assertThat(number(dot, "cx") - leftPx)
                        .isCloseTo(thousandfoldPx * Math.log10(row.robots()) / 3, within(0.2));
            });
        });
        assertThat(svg.elements("line", "stroke-width", "1.2"))
                .filteredOn(line -> line.getAttribute("x1").equals(line.getAttribute("x2")))
                .hasSize(MEDIANS.size())
                .allSatisfy(bar -> assertThat(number(bar, "y1") - number(bar, "y2"))
                        .as("from half the median to twice the median")
                        .isCloseTo(decadePx * Math.log10(4), within(0.2)));
    }

    @Test
    void files_areTheSamePictureTwice() throws Exception {
        new CrowdFigure(MEDIANS, 8, 3).write(out);

        var svg = ParsedSvg.parse(Files.readString(out.resolve("crowd.svg")));
        var picture = ImageIO.read(out.resolve("crowd.png").toFile());
        assertThat(picture.getWidth()).isEqualTo(2 * (int) number(svg.root(), "width"));
        // a dot of the world line at 100 robots, where no quartiles are drawn
        var dot = svg.elements("circle").get(6);
        int pixel = picture.getRGB((int) (2 * number(dot, "cx")), (int) (2 * number(dot, "cy")));
        assertThat(String.format("#%06x", pixel & 0xffffff)).isEqualTo(dot.getAttribute("fill"));
    }

    /** {@code -Dfigures=write} writes the documented figure. */
    @Test
    void pictureInTheDocumentation_isThatOfTheTableThere() throws IOException {
        List<Row> rows = Files.readAllLines(Path.of("..", "docs", "benchmarks.md")).stream()
                .map(ROW::matcher)
                .filter(Matcher::matches)
                .map(CrowdTest::documented)
                .toList();
        assertThat(rows).hasSize(7);

        String svg = new CrowdFigure(rows, 8, 3).chart().svg();
        if ("write".equals(System.getProperty("figures"))) {
            Files.writeString(DOCUMENTED, svg);
        }
        assertThat(DOCUMENTED).hasContent(svg);
    }

    /**
     * A row of the documented table. Of three rounds, the quartiles are halfway between the median and the extremes;
     * the table has the extremes of the speed.
     */
    private static Row documented(Matcher row) {
        double[] numbers = new double[8];
        for (int i = 1; i <= 7; i++) {
            numbers[i] = Double.parseDouble(row.group(i).replace(",", ""));
        }
        int robots = (int) numbers[1];
        double micros = numbers[5];
        double low = (micros + 100_000 / numbers[4] / robots) / 2;
        double high = (micros + 100_000 / numbers[3] / robots) / 2;
        double speed = numbers[2];
        return new Row(robots, speed, numbers[3], numbers[4], 0, micros, low, high, numbers[6], numbers[7], 0, 0);
    }
}
