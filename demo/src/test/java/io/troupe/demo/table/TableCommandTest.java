package io.troupe.demo.table;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.NamedColours;
import io.troupe.services.subsumption.Assignment;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.io.ByteArrayInputStream;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.stream.IntStream;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.w3c.dom.Document;
import picocli.CommandLine;

class TableCommandTest {
    @TempDir
    private Path directory;

    private String table(String... arguments) {
        var out = new StringWriter();
        var all = new java.util.ArrayList<>(List.of(arguments));
        all.addAll(List.of("--out", directory.resolve("made").toString()));
        int status =
                new CommandLine(new TableCommand()).setOut(new PrintWriter(out)).execute(all.toArray(String[]::new));
        assertThat(status).isZero();
        return out.toString();
    }

    private String file(String name) throws Exception {
        return Files.readString(directory.resolve("made").resolve(name));
    }

    private static Document xml(String svg) throws Exception {
        return DocumentBuilderFactory.newInstance()
                .newDocumentBuilder()
                .parse(new ByteArrayInputStream(svg.getBytes(StandardCharsets.UTF_8)));
    }

    private static long arrows(String svg) {
        return svg.lines().filter(line -> line.contains("class=\"arrow\"")).count();
    }

    @Test
    void withoutFile_theTableOfThePaperIsShown() throws Exception {
        assertThat(table()).startsWith("""
                2 robots, 3 states, 2 services; it begins with state 1
                ignored: black (walls and robot 2), orange (robot 1)

                state  colour  robot 1        robot 2
                1      blue    wallFollower   spaceWanderer
                2      red     spaceWanderer  wallFollower
                3      green   spaceWanderer  spaceWanderer

                wrote states and rules, as .dot and .svg, in\
                """);
        assertThat(arrows(file("states.svg"))).isEqualTo(1 + 6);
        assertThat(file("states.svg")).contains(">robot 1: wallFollower</text>", "fill=\"#0000ff\"", ">green</text>");
        assertThat(file("states.dot")).contains("s1 -> s2 [label=\"red\"", "s3 -> s1 [label=\"blue\"", "start -> s1");
        for (String name : List.of("states.svg", "rules.svg")) {
            assertThat(xml(file(name)).getElementsByTagName("title").getLength())
                    .isEqualTo(1);
        }
    }

    @Test
    void pictures_haveTrianglesForMarkers_noGlaringGreen_andNoEmptyStripBelow() throws Exception {
        table();
        for (String name : List.of("states.svg", "rules.svg")) {
            String svg = file(name);
            var root = xml(svg).getDocumentElement();
            assertThat(root.getAttribute("role")).isEqualTo("img");
            assertThat(root.getAttribute("aria-label"))
                    .isEqualTo(root.getElementsByTagName("title").item(0).getTextContent());
            assertThat(svg).doesNotContain("marker", "#00ff00");
            assertThat(svg.split("class=\"head\"", -1)).hasSize(1 + 1 + 6);
            double lowest = 0;
            for (String element : new String[] {"rect", "text"}) {
                var found = root.getElementsByTagName(element);
                for (int i = 0; i < found.getLength(); i++) {
                    var each = (org.w3c.dom.Element) found.item(i);
                    if (!each.getAttribute("y").isEmpty()) {
                        double height = element.equals("rect") ? Double.parseDouble(each.getAttribute("height")) : 0;
                        lowest = Math.max(lowest, Double.parseDouble(each.getAttribute("y")) + height);
                    }
                }
            }
            assertThat(Double.parseDouble(root.getAttribute("height"))).isBetween(lowest, lowest + 40);
        }
    }

    @Test
    void pictureInTheDocumentation_isThatOfThePapersTable() throws Exception {
        assertThat(Path.of("..", "docs", "figures", "states.svg"))
                .hasContent(DiagramSvg.draw(Diagram.ofStates(SubsumptionTable.ofThePaper())));
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
        assertThat(table(Path.of("tables", "four-services.table").toString()))
                .contains("a state lasts 2 s or more", "state  colour  priority  robot 1", "dodge > west");
        assertThat(file("rules.svg"))
                .contains(
                        "robot 2: dodge &gt; east &gt; {WF, SW, west}",
                        "state 3, priority 1",
                        "has a higher priority than state.colour)");
    }

    @Test
    void manyStates_haveOneArrowEach_fromABar_andManyRobotsAreGrouped() throws Exception {
        Path file = Files.writeString(
                directory.resolve("many.table"),
                "robots 50\nallow final\nstate red : * = wallFollower, 1..2 = spaceWanderer, 9 = spaceWanderer\n"
                        + "state blue : * = wallFollower\n"
                        + String.join(
                                "",
                                IntStream.range(0, 18)
                                        .mapToObj("state #0000%02X : * = spaceWanderer\n"::formatted)
                                        .toList()));
        assertThat(table(file.toString()))
                .contains("1      red      robots 1..2, 9: spaceWanderer; robots 3..8, 10..50: wallFollower");
        String svg = file("states.svg");
        assertThat(arrows(svg)).isEqualTo(1 + 20);
        assertThat(svg).contains(">any other state in</text>", ">state 2, never ends</text>", "stroke-dasharray");
        xml(svg);
        assertThat(file("states.dot").split("any -> ", -1)).hasSize(21);
    }

    @Test
    void statesThatNeverEnd_haveNoArrowsAway() {
        var table = SubsumptionTable.forRobots(1)
                .allowFinal()
                .when(NamedColours.BLUE, Service.SPACE_WANDERER)
                .when(NamedColours.RED, Service.WALL_FOLLOWER)
                .build();
        assertThat(Diagram.ofStates(table).arrows()).containsExactly(new Diagram.Arrow(0, 1));
    }

    @Test
    void names_areEscaped() throws Exception {
        var odd = new Service("a<\"b\\&c", true, () -> senses -> Optional.empty());
        var table = SubsumptionTable.forRobots(1)
                .when(NamedColours.BLUE, Assignment.everyRobot(odd))
                .build();
        String svg = DiagramSvg.draw(Diagram.ofStates(table));
        assertThat(xml(svg).getElementsByTagName("text").item(1).getTextContent())
                .isEqualTo("robot 1: a<\"b\\&c");
        assertThat(Diagram.ofStates(table).dot()).contains("robot 1: a<\\\"b\\\\&amp;c");
    }
}
