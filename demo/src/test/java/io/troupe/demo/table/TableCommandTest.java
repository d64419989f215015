package io.troupe.demo.table;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.NamedColours;
import io.troupe.demo.CommandLineBench;
import io.troupe.demo.ParsedSvg;
import io.troupe.demo.RecordedDrive;
import io.troupe.services.subsumption.Assignment;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceCatalogue;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.services.subsumption.SubsumptionTableReader;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.w3c.dom.Element;

/** {@code troupe table}, and the tables in {@code demo/tables}, which drive the robots of the paper's arena. */
@Timeout(300)
class TableCommandTest extends CommandLineBench {
    private static long arrows(String svg) {
        return svg.lines().filter(line -> line.contains("class=\"arrow\"")).count();
    }

    @Test
    void withoutFile_theTableOfThePaperIsShown_inPicturesThatCanBeRead() throws Exception {
        assertThat(printed("table --out DIR")).startsWith("""
                2 robots, 3 states, 2 services; it begins with state 1
                ignored: black (walls and robot 2), orange (robot 1)

                state  colour  robot 1        robot 2
                1      blue    wallFollower   spaceWanderer
                2      red     spaceWanderer  wallFollower
                3      green   spaceWanderer  spaceWanderer

                wrote states and rules, as .dot and .svg, in\
                """);
        assertThat(arrows(written("states.svg"))).isEqualTo(1 + 6);
        assertThat(written("states.svg"))
                .contains(">robot 1: wallFollower</text>", "fill=\"#0000ff\"", ">green</text>");
        assertThat(written("states.dot"))
                .contains("s1 -> s2 [label=\"red\"", "s3 -> s1 [label=\"blue\"", "start -> s1");
        assertThat(Path.of("..", "docs", "figures", "states.svg")).hasContent(written("states.svg"));
        assertThat(Path.of("..", "docs", "figures", "rules.svg")).hasContent(written("rules.svg"));
        for (String name : List.of("states.svg", "rules.svg")) {
            String text = written(name);
            assertThat(text).doesNotContain("marker", "#00ff00");
            assertThat(text.split("class=\"head\"", -1)).as("triangles").hasSize(1 + 1 + 6);
            var svg = ParsedSvg.parse(text);
            assertThat(svg.elements("title")).hasSize(1);
            assertThat(svg.title()).isNotEmpty();
            double lowest = Math.max(lowest(svg.elements("rect")), lowest(svg.elements("text")));
            assertThat(ParsedSvg.number(svg.root(), "height")).isBetween(lowest, lowest + 40);
        }
    }

    private static double lowest(List<Element> elements) {
        return elements.stream()
                .filter(each -> !each.getAttribute("y").isEmpty())
                .mapToDouble(each -> ParsedSvg.number(each, "y")
                        + (each.getTagName().equals("rect") ? ParsedSvg.number(each, "height") : 0))
                .max()
                .orElseThrow();
    }

    /** Rules [1] to [4] of section 3.3, with the priorities of Table 4: blue lets robot 1 follow walls, red robot 2. */
    @Test
    void rulesOfThePaper_haveThePrioritiesOfTable4() {
        var diagram = Diagram.ofRules(SubsumptionTable.ofThePaper());
        assertThat(diagram.nodes())
                .extracting(Diagram.Node::lines)
                .containsExactly(
                        List.of("robot 1: WF > SW", "robot 2: SW > WF"),
                        List.of("robot 1: SW > WF", "robot 2: WF > SW"),
                        List.of("robot 1: SW > WF", "robot 2: SW > WF"));
        assertThat(diagram.nodes()).extracting(Diagram.Node::enters).containsExactly("A & B", "A & C", "A & D");
        assertThat(diagram.notes())
                .containsExactly(
                        "A: robot.colour ≠ black & robot.colour ≠ orange & robot.colour ≠ state.colour",
                        "B: robot 1.colour = blue or robot 2.colour = blue",
                        "C: robot 1.colour = red or robot 2.colour = red",
                        "D: robot 1.colour = green or robot 2.colour = green",
                        "WF wallFollower, SW spaceWanderer");
    }

    @Test
    void layersHoldAndPriority_areInTheRules() throws Exception {
        assertThat(printed("table tables/four-services.table --out DIR"))
                .contains("a state lasts 2 s or more", "state  colour  priority  robot 1", "dodge > west");
        assertThat(written("rules.svg"))
                .contains(
                        "robot 2: dodge &gt; east &gt; {WF, SW, west}",
                        "state 3, priority 1",
                        "has a higher priority than state.colour)");
    }

    @Test
    void manyStates_haveOneArrowEach_fromABar_andManyRobotsAreGrouped() throws Exception {
        String states = IntStream.range(0, 18)
                .mapToObj("state #0000%02X : * = spaceWanderer\n"::formatted)
                .collect(Collectors.joining());
        file("many.table", """
                robots 50
                allow final
                state red : * = wallFollower, 1..2 = spaceWanderer, 9 = spaceWanderer
                state blue : * = wallFollower
                """ + states);
        assertThat(printed("table DIR/many.table --out DIR"))
                .contains("1      red      robots 1..2, 9: spaceWanderer; robots 3..8, 10..50: wallFollower");
        String svg = written("states.svg");
        assertThat(arrows(svg)).isEqualTo(1 + 20);
        assertThat(svg).contains(">any other state in</text>", ">state 2, never ends</text>", "stroke-dasharray");
        ParsedSvg.parse(svg);
        assertThat(written("states.dot").split("any -> ", -1)).hasSize(21);
    }

    @Test
    void names_areEscaped_andStatesThatNeverEndHaveNoArrowsAway() throws Exception {
        var odd = new Service("a<\"b\\&c", true, () -> senses -> Optional.empty());
        var table = SubsumptionTable.forRobots(1)
                .state(NamedColours.BLUE, Assignment.everyRobot(odd))
                .build();
        String svg = DiagramSvg.draw(Diagram.ofStates(table));
        assertThat(ParsedSvg.parse(svg).texts().get(1)).isEqualTo("robot 1: a<\"b\\&c");
        assertThat(Diagram.ofStates(table).dot()).contains("robot 1: a<\\\"b\\\\&amp;c");

        var neverEnding = SubsumptionTable.forRobots(1)
                .allowFinal()
                .state(NamedColours.BLUE, Service.SPACE_WANDERER)
                .state(NamedColours.RED, Service.WALL_FOLLOWER)
                .build();
        assertThat(Diagram.ofStates(neverEnding).arrows()).containsExactly(new Diagram.Arrow(0, 1));
    }

    // ---- shipped tables

    private static final Path TABLES = Path.of("tables");
    private static final Path WORLD = Path.of("worlds", "paper-arena.world");

    private static SubsumptionTable read(String text) {
        return SubsumptionTableReader.parse(text, Path.of("text"), ServiceCatalogue.standard());
    }

    private final RecordedDrive recorded = new RecordedDrive();

    private Snapshot drive(SubsumptionTable table, int seconds) throws InterruptedException {
        return recorded.drive(Mode.PROMISE, ScenarioReader.read(WORLD), table, seconds);
    }

    @Test
    void paperTable_isTheTableOfThePaper_andRuns() throws Exception {
        SubsumptionTable table = SubsumptionTableReader.read(TABLES.resolve("paper.table"));
        assertThat(table).isEqualTo(SubsumptionTable.ofThePaper());
        drive(table, 120);
        assertThat(recorded.states).contains(1, 2, 3);
        assertThat(recorded.cycles).containsOnlyKeys("wallFollower", "spaceWanderer");
    }

    @Test
    void fourServices_allDrive_andEveryStateIsVisited() throws Exception {
        drive(SubsumptionTableReader.read(TABLES.resolve("four-services.table")), 300);
        assertThat(recorded.states).contains(1, 2, 3);
        assertThat(recorded.cycles).containsOnlyKeys("wallFollower", "spaceWanderer", "dodge > west", "dodge > east");
        assertThat(recorded.cycles.values()).allMatch(count -> count > 20);
    }

    @Test
    void goalsOfATable_areReached_roundAnInnerWall() throws Exception {
        var end = drive(read("""
                robots 2
                allow final
                service there = goToGoal(-1.4, 2.1; within 0.1)
                service round = goToGoal(3.3, -1; -0.2, -4; within 0.1)
                state blue : avoid > round, avoid > there
                """), 90);
        assertThat(distance(end.robots().get(0).pose(), 0.0, -3.0)).isLessThan(0.2);
        assertThat(distance(end.robots().get(1).pose(), 4.4, -2.6)).isLessThan(0.2);
        assertThat(recorded.states).containsExactly(1);
    }

    private static double distance(Pose pose, double x, double y) {
        return Math.hypot(pose.x() - x, pose.y() - y);
    }

    @Test
    void everyTable_isRead() throws Exception {
        try (var files = Files.list(TABLES)) {
            List<Path> tables =
                    files.filter(file -> file.toString().endsWith(".table")).toList();
            assertThat(tables).hasSizeGreaterThanOrEqualTo(2);
            for (Path file : tables) {
                assertThat(SubsumptionTableReader.read(file).states()).isNotEmpty();
            }
        }
    }
}
