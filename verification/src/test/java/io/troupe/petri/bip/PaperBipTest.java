package io.troupe.petri.bip;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.drawing.BipDrawing;
import io.troupe.tools.Thorough;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import java.util.regex.Pattern;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;
import javax.xml.parsers.DocumentBuilderFactory;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** The paper's two robots as BIP models: their states, their text and their drawing. */
class PaperBipTest {
    @TempDir
    private Path directory;

    private static Stream<BipModel> models() {
        return Stream.of(PaperBip.waiting(), PaperBip.notWaiting(), PaperBip.rulesAsPriorities());
    }

    @Test
    void waiting_noRobotEverHasTwoServices() {
        var states = BipStates.explore(PaperBip.waiting());

        assertThat(states.size()).isEqualTo(18);
        assertThat(states.edgeCount()).isEqualTo(41);
        assertThat(states.dead()).isEmpty();
        assertThat(states.neverFired()).isEmpty();
        assertThat(states.find(PaperBip.twoServices(1))).isEmpty();
        assertThat(states.find(PaperBip.twoServices(2))).isEmpty();
        assertThat(states.neverAgain(state -> state.isIn("arbitrator", "state3")))
                .isEmpty();
    }

    /** The mutation: without the waiting, the same search finds two services of one robot, and how that happens. */
    @Test
    void notWaiting_eachRobotHasTwoServicesInThirtyStates() {
        var states = BipStates.explore(PaperBip.notWaiting());

        assertThat(states.size()).isEqualTo(84);
        assertThat(states.edgeCount()).isEqualTo(272);
        assertThat(states.dead()).isEmpty();
        assertThat(states.neverFired()).isEmpty();
        assertThat(states.count(PaperBip.twoServices(1))).isEqualTo(30);
        assertThat(states.count(PaperBip.twoServices(2))).isEqualTo(30);
        assertThat(states.find(PaperBip.twoServices(1)).orElseThrow().trace())
                .extracting(Interaction::toString)
                .containsExactly("start1", "see2_by2", "stop1", "start2");
    }

    @Test
    void rulesAsPriorities_letOneServiceDriveEachRobotInEachState() {
        var states = BipStates.explore(PaperBip.rulesAsPriorities());

        assertThat(states.size()).isEqualTo(3);
        assertThat(states.edgeCount()).isEqualTo(14);
        assertThat(states.states())
                .allSatisfy(state -> assertThat(state.successors().stream()
                                .map(each -> each.interaction().toString())
                                .filter(each -> each.startsWith("drive")))
                        .hasSize(2));
        assertThat(states.neverFired())
                .containsExactly(
                        "drive1_wanderer1",
                        "drive1_follower2",
                        "drive2_follower1",
                        "drive2_wanderer2",
                        "drive3_follower1",
                        "drive3_follower2");
    }

    /** Without the priorities both services of a robot drive it. */
    @Test
    void rulesWithoutPriorities_letBothServicesDrive() {
        var rules = PaperBip.rulesAsPriorities();
        var model = BipModel.named("mutated");
        rules.components().forEach(model::component);
        rules.connectors().forEach(model::connector);

        assertThat(BipStates.explore(model.build()).edgeCount()).isEqualTo(20);
        assertThat(BipStates.explore(model.build()).neverFired()).isEmpty();
    }

    @Test
    void samples_ofTheJavadoc() throws IOException {
        var states = BipStates.explore(PaperBip.waiting());
        assertThat(states.find(PaperBip.twoServices(1))).isEmpty();

        var file = directory.resolve("paper.svg");
        Files.writeString(file, BipDrawing.of(PaperBip.waiting()).svg());
        assertThat(file).isNotEmptyFile();
    }

    // ---- text

    @Test
    void text_isThatOfTheGoldenFile() throws IOException {
        try (var golden = PaperBipTest.class.getResourceAsStream("two_robots.bip")) {
            assertThat(golden).isNotNull();
            assertThat(BipText.of(PaperBip.waiting()))
                    .isEqualTo(new String(golden.readAllBytes(), StandardCharsets.UTF_8));
        }
    }

    /** Reads the text again by a few patterns: each port of a connector is exported by the type of its component. */
    @ParameterizedTest
    @MethodSource("models")
    void text_hasAPortForEachConnectorEnd(BipModel model) throws IOException {
        Files.writeString(directory.resolve(model.name() + ".bip"), BipText.of(model));
        var text = Files.readString(directory.resolve(model.name() + ".bip")).replaceAll(",\\n *", ", ");
        var ends = Pattern.compile("connector (?!type)\\w+ \\w+\\(([^)]*)\\)")
                .matcher(text)
                .results()
                .flatMap(found -> Stream.of(found.group(1).split(", ")))
                .toList();

        assertThat(ends)
                .hasSize(model.connectors().stream()
                        .mapToInt(each -> each.ends().size())
                        .sum());
        assertThat(ends).allSatisfy(end -> {
            var parts = end.split("\\.");
            var component =
                    Pattern.compile("component (\\w+) " + parts[0] + "\\(\\)").matcher(text);
            assertThat(component.find()).as(end).isTrue();
            var type = text.substring(text.indexOf("atom type " + component.group(1) + "()"));
            var ports = type.substring(type.indexOf("export port"), type.indexOf("place "));
            assertThat(ports).contains(" " + parts[1] + "()");
        });
    }

    @Test
    void text_writesTriggersAndPriorities() {
        var type = AtomType.starting("Signal", "here").on("go", "here", "here");
        var text = BipText.of(BipModel.named("small")
                .component("a", type)
                .component("b", type)
                .connector("x", "a.go'", "b.go")
                .connector("y", "b.go")
                .priority("x", "y")
                .build());

        assertThat(text).isEqualTo("""
                package small
                  port type Signal_()

                  connector type Broadcast_ts(Signal_ p1, Signal_ p2)
                    define p1' p2
                  end

                  connector type Rendezvous1(Signal_ p1)
                    define p1
                  end

                  atom type Signal()
                    export port Signal_ go()
                    place here
                    initial to here
                    on go from here to here
                  end

                  compound type Top()
                    component Signal a()
                    component Signal b()
                    connector Broadcast_ts x(a.go', b.go)
                    connector Rendezvous1 y(b.go)
                    priority rule1 x:* < y:*
                  end
                end
                """.replace("a.go'", "a.go"));
    }

    // ---- drawing

    @ParameterizedTest
    @MethodSource("models")
    void drawing_hasEachPart_andABulletForEachEnd(BipModel model) throws Exception {
        var file = directory.resolve("model.svg");
        Files.writeString(file, BipDrawing.of(model).svg());
        var svg = Files.readString(file);
        DocumentBuilderFactory.newInstance().newDocumentBuilder().parse(file.toFile()); // it is well-formed

        assertThat(count(svg, "class=\"component\""))
                .isEqualTo(model.components().size());
        assertThat(count(svg, "class=\"connector\""))
                .isEqualTo(model.connectors().size());
        assertThat(count(svg, "class=\"port\""))
                .isEqualTo(model.components().values().stream()
                        .mapToInt(each -> each.ports().size())
                        .sum());
        assertThat(count(svg, "class=\"synchron\""))
                .isEqualTo(model.connectors().stream()
                        .mapToInt(each -> each.ends().size())
                        .sum());
        assertThat(count(svg, "class=\"priority\""))
                .isEqualTo(model.priorities().size());
        assertThat(svg).isEqualTo(BipDrawing.of(model).svg());
    }

    /** On a page of 830 px. */
    @Test
    void drawing_ofThePapersRobots_hasLettersThatCanBeRead() {
        var svg = BipDrawing.of(PaperBip.waiting()).svg();
        var smallest = numbers(svg, "font-size=\"([0-9.]+)\"").min().orElseThrow();
        var width = numbers(svg, "<svg [^>]*width=\"([0-9.]+)\"").findFirst().orElseThrow();
        assertThat(smallest * 830 / width).isGreaterThan(8.5);
    }

    @Test
    void drawing_hasTwoColumns_ifTheConnectorsJoinTwoSides() {
        var type = AtomType.starting("Lamp", "off").on("press", "off", "off");
        var chain = BipModel.named("chain")
                .component("a", type)
                .component("b", type)
                .component("c", type)
                .connector("ab", "a.press", "b.press")
                .connector("bc", "b.press", "c.press");
        var two = columns(chain.build());
        assertThat(List.of(two.get(0), two.get(2)))
                .as("a and c are on the left of b")
                .allMatch(x -> x < two.get(1));

        var ring = chain.connector("ca", "c.press", "a.press").build();
        assertThat(columns(ring))
                .as("three in a ring have no two sides, and are drawn")
                .hasSize(3);
    }

    @Test
    void drawing_ofAnyModel_hasAllItsComponents() {
        for (var seed = 0; seed < Thorough.times(50, 2_000); seed++) {
            var model = randomModel(new Random(seed));
            assertThat(columns(model))
                    .as("seed " + seed)
                    .hasSameSizeAs(model.components().keySet());
        }
    }

    private static BipModel randomModel(Random random) {
        var ports = List.of("press", "hold", "free");
        var type = AtomType.starting("Lamp", "off")
                .on("press", "off", "off")
                .on("hold", "off", "lit")
                .on("free", "lit", "off");
        var model = BipModel.named("any");
        List<String> names =
                new ArrayList<>(List.of("a", "b", "c", "d", "e", "f").subList(0, 2 + random.nextInt(5)));
        for (var name : names) {
            model.component(name, type);
        }
        for (var i = random.nextInt(8); i >= 0; i--) {
            Collections.shuffle(names, random);
            var ends = names.stream()
                    .limit(1 + random.nextInt(3))
                    .map(name -> name + "." + ports.get(random.nextInt(3)))
                    .toArray(String[]::new);
            model.connector("x" + i, ends);
        }
        return model.build();
    }

    /** Where the boxes of the components begin, from left to right, in the order of the components. */
    private static List<Double> columns(BipModel model) {
        return numbers(BipDrawing.of(model).svg(), "class=\"component\"[^\\n]*\\n<rect x=\"([0-9.]+)\"")
                .boxed()
                .toList();
    }

    private static DoubleStream numbers(String svg, String pattern) {
        return Pattern.compile(pattern).matcher(svg).results().mapToDouble(found -> Double.parseDouble(found.group(1)));
    }

    @Test
    void drawing_hasATriangleForATrigger() {
        var type = AtomType.starting("Lamp", "off").on("press", "off", "off");
        var svg = BipDrawing.of(BipModel.named("cast")
                        .component("a", type)
                        .component("b", type)
                        .component("c", type)
                        .connector("x", "a.press'", "b.press", "c.press")
                        .build())
                .svg();

        assertThat(List.of(count(svg, "class=\"trigger\""), count(svg, "class=\"synchron\"")))
                .containsExactly(1, 2);
    }

    private static int count(String text, String part) {
        return text.split(Pattern.quote(part), -1).length - 1;
    }
}
