package io.troupe.services.subsumption;

import static io.troupe.services.behaviour.TestSenses.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowableOfType;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.subsumption.ServiceCatalogue.Kind;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Optional;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

/** Tables, services and kinds as text, read and written. */
class SubsumptionTableReaderTest {
    private static final String BLUE = "robots 2\nstate blue : wallFollower, spaceWanderer\n";

    private static SubsumptionTable read(String text) {
        return SubsumptionTableReader.parse(text, Path.of("my.table"), ServiceCatalogue.standard());
    }

    private static Service service(String declaration) {
        return SubsumptionTableReader.service(declaration, ServiceCatalogue.standard());
    }

    private static Optional<Velocity> step(SubsumptionTable table) {
        var behaviour = table.first().services().getFirst().behaviour().get();
        return behaviour.step(new Senses(0, ring(), new RobotPose(0, 0, 0)));
    }

    @Test
    void comment_beginsAtTheStartOrAfterABlank_andNoColourDoes() {
        var table = read("""
                #FF0000 is a comment here
                robots 1
                  # and here
                allow final
                state #FF0000 : spaceWanderer # and here, with #00FF00
                """);
        assertThat(table.states()).extracting(State::colour).containsExactly(NamedColours.RED);
        assertThatThrownBy(() -> read("robots 1\nstate red : spaceWanderer# no comment"))
                .hasMessageContaining("2:26: '#', expected");
    }

    @Test
    void table4_asText_isTheTableOfThePaper_andIsWrittenPlainly() {
        assertThat(read("""
                # Table 4
                robots 2
                ignore black : walls and robot 2
                ignore orange : robot 1 # not robot 2
                state blue : wallFollower, spaceWanderer
                state red : spaceWanderer,wallFollower
                state #00FF00 : spaceWanderer , spaceWanderer
                """)).isEqualTo(SubsumptionTable.ofThePaper());
        assertThat(SubsumptionTableWriter.write(SubsumptionTable.ofThePaper())).isEqualTo("""
                robots 2
                ignore black : walls and robot 2
                ignore orange : robot 1
                state blue : wallFollower, spaceWanderer
                state red : spaceWanderer, wallFollower
                state green : spaceWanderer, spaceWanderer
                """);
    }

    @Test
    void wallFollowerWithArguments_isThatOfTheOtherCornerStyle() {
        var table = read(
                "robots 1\nservice wallFollower = wallFollower(corners backward) colours\nstate red : wallFollower");
        Service expected = Service.wallFollower(CornerStyle.BACKWARD);
        assertThat(table.first().services().getFirst().behaviour()).isEqualTo(expected.behaviour());
        assertThat(table.first().canEnd()).isTrue();
    }

    @Test
    void layersAndArguments_makeTheServiceThatDrives() {
        var table = read("""
                robots 1
                state violet priority -3 : avoid > patrol   # before its parts, which the order of lines allows
                colour violet #8A2BE2
                service patrol = goToGoal(3, 0; 3, 4; speed 0.2) colours
                hold 500 ms
                """);
        assertThat(table.first().colour()).isEqualTo(0x8A2BE2);
        assertThat(table.priority(0x8A2BE2)).isEqualTo(-3);
        assertThat(table.holdSeconds()).isEqualTo(0.5);
        Service service = table.first().services().getFirst();
        assertThat(service.name()).isEqualTo("avoid > patrol");
        assertThat(service.layers()).extracting(Service::name).containsExactly("avoid", "patrol");
        assertThat(step(table)).hasValue(new Velocity(0.2, 0));
    }

    @Test
    void ranges_giveFiftyRobotsTheirServices_inOneLine() {
        var table = read("robots 50\nstate grey : 3..5 = wallFollower, * = spaceWanderer, 50 = avoid");
        var services = table.first().services();
        assertThat(services).hasSize(50);
        assertThat(services.subList(0, 2)).containsOnly(Service.SPACE_WANDERER);
        assertThat(services.subList(2, 5)).containsOnly(Service.WALL_FOLLOWER);
        assertThat(services.subList(5, 49)).containsOnly(Service.SPACE_WANDERER);
        assertThat(services.get(49).name()).isEqualTo("avoid");
    }

    @Test
    void manyRobots_areWrittenInRanges() {
        var assignment = Assignment.everyRobot(Service.SPACE_WANDERER)
                .robots(3, 5, Service.WALL_FOLLOWER)
                .robot(50, Service.WALL_FOLLOWER);
        var table = SubsumptionTable.forRobots(50).state(0xFFFF00, assignment).build();
        assertThat(SubsumptionTableWriter.write(table))
                .isEqualTo("robots 50\nstate yellow : * = spaceWanderer, 3..5 = wallFollower, 50 = wallFollower\n");
    }

    @Test
    void kindsOfOnesOwn_areServices_andBareCodeCannotBeWritten() {
        var spin = new Kind("spin", true, false, arguments -> {
            double rate = arguments.number("rate", 1);
            return () -> senses -> Optional.of(new Velocity(0, rate));
        });
        var catalogue = ServiceCatalogue.standard().with(spin);
        var table = SubsumptionTableReader.parse(
                "robots 1\nservice slow = spin(rate 0.25)\nstate red : slow", Path.of("own"), catalogue);
        assertThat(step(table)).hasValue(new Velocity(0, 0.25));
        assertThatThrownBy(() -> catalogue.with(spin)).hasMessageContaining("spin already");
        var own = new Service("own", true, () -> senses -> Optional.empty());
        var unwritten =
                SubsumptionTable.forRobots(1).state(NamedColours.RED, own).build();
        assertThatThrownBy(() -> SubsumptionTableWriter.write(unwritten))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("the service own cannot be written");
    }

    @Test
    void file_isReadAsUtf8_withAnyLineEnds(@TempDir Path folder) throws Exception {
        Path file = Files.writeString(folder.resolve("a.table"), "\uFEFF" + BLUE.replace("\n", "\r\n"));
        assertThat(SubsumptionTableReader.read(file)).isEqualTo(read(BLUE));
        Path broken = Files.write(folder.resolve("b.table"), new byte[] {'#', '\n', 'r', 'o', (byte) 0xFF});
        assertThatThrownBy(() -> SubsumptionTableReader.read(broken))
                .hasMessageStartingWith(broken + ":2:1: there is no statement 'ro'");
        assertThatThrownBy(() -> SubsumptionTableReader.read(folder.resolve("none")))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessage(folder.resolve("none") + ": no such file, expected the text of a table");
        assertThatThrownBy(() -> SubsumptionTableReader.read(folder))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessage(folder + " is a directory, expected a file with the text of a table");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "robot 2 | 1:1: there is no statement 'robot', expected one of: robots, ignore, colour, service, hold, allow, state (did you mean 'robots'?)",
                "; | 1:1: ';', expected a statement, one of robots, ignore, colour, service, hold, allow, state",
                "robots two | 1:8: 'two', expected a number of robots, 1 to 20000",
                "robots 0 | 1:8: '0', expected a number of robots, 1 to 20000",
                "robots 99999999999 | 1:8: '99999999999', expected a number of robots, 1 to 20000",
                "robots 2 3 | 1:10: '3', expected the end of the line",
                "robots 2/robots 2 | 2:1: 'robots' is given twice, expected it once",
                "hold 2 s | 1:1: the table does not name the number of its robots, expected 'robots N'",
                "robots 1/hold 2 | 2:7: the line ends, expected 's' or 'ms' after the number",
                "robots 1/hold -2 s | 2:6: a state is held for -2.0 s, expected 0 or more",
                "robots 1/hold long | 2:6: 'long', expected how long a state lasts, such as '2 s'",
                "robots 1/hold 1e999 s | 2:6: '1e999', expected how long a state lasts, such as '2 s'",
                "robots 1/hold 1 s/hold 2 s | 3:1: 'hold' is given twice, expected it once",
                "robots 1/allow endless | 2:7: 'endless', expected 'final' after 'allow'",
                "robots 1/colour blu | 2:8: the colour 'blu' has no value, expected #RRGGBB after it, or a known name: blue, red, green, orange, black, yellow, cyan, magenta, white, grey, gray, purple, violet, brown, pink, gold, navy, turquoise, maroon, indigo, olive, teal, silver (did you mean 'blue'?)",
                "robots 1/colour sky 12 | 2:12: '12', expected a colour as #RRGGBB",
                "robots 1/colour sky #12 | 2:8: the colour 'sky' has no value, expected #RRGGBB after it, or a known name: blue, red, green, orange, black, yellow, cyan, magenta, white, grey, gray, purple, violet, brown, pink, gold, navy, turquoise, maroon, indigo, olive, teal, silver",
                "robots 1/colour a #000001/colour a #000002 | 3:8: the colour a is declared already",
                "robots 1/colour a #000001/colour b #000001 | 3:8: the colour #000001 is called a already, and not b",
                "robots 1/ignore red/ignore red | 3:8: red is ignored already",
                "robots 1/state rd : avoid | 2:7: there is no colour 'rd', expected 'colour rd #RRGGBB', or one of: blue, red, green, orange, black, yellow, cyan, magenta, white, grey, gray, purple, violet, brown, pink, gold, navy, turquoise, maroon, indigo, olive, teal, silver (did you mean 'red'?)",
                "robots 1/state red avoid | 2:11: 'avoid', expected ':' before the services",
                "robots 1/state red priority high : avoid | 2:20: 'high', expected a whole number",
                "robots 1/state red : wander | 2:13: there is no service called 'wander', expected one of: wallFollower, spaceWanderer, goToGoal, avoid",
                "robots 1/state red : wallfollower | 2:13: there is no service called 'wallfollower', expected one of: wallFollower, spaceWanderer, goToGoal, avoid (did you mean 'wallFollower'?)",
                "robots 1/state red : goToGoal | 2:13: goToGoal: a way of 0 goals, expected 1 or more",
                "robots 1/state red : avoid(near 1) | 2:18: arguments of avoid, expected them where it gets a name: 'service NAME = KIND(..)'",
                "robots 1/state red : spaceWanderer #decade | 2:27: the colour #decade (in a comment a blank follows the '#'), expected ',', '>' or the end of the line",
                "robots 1/state #12345 : avoid | 2:6: the line ends at the comment '#12345' (a colour is #RRGGBB), expected a colour",
                "robots 1/state # no colour | 2:6: the line ends, expected a colour",
                "robots 2/state red : spaceWanderer | 2:26: the line ends, expected ',' and the service of robot 2 of 2",
                "robots 1/state red : spaceWanderer, avoid | 2:28: 'avoid' is for robot 2, expected services for 1 robots",
                "robots 2/state red : spaceWanderer, 2 = avoid | 2:28: '2', expected the service of robot 2, as for those before it",
                "robots 3/state red : 1..2 = avoid, 2..3 = spaceWanderer | 2:27: robot 2 is given avoid and spaceWanderer without an order, expected one service, or layers (the upper one first) made with over(..) or '>'",
                "robots 3/state red : * = avoid, * = spaceWanderer | 2:24: all other robots are given avoid and spaceWanderer without an order, expected one service, or layers (the upper one first) made with over(..) or '>'",
                "robots 3/state red : 2..1 = avoid | 2:13: robots 2..1, expected numbers from 1, the smaller one first",
                "robots 3/state red : 1 = avoid, 4 = avoid | 2:24: '4', expected '*' or the number of a robot, 1 to 3",
                "robots 3/state red : 1 = avoid, 3 = avoid | 2:7: robot 2 has no service, expected one for each robot",
                "robots 3/state red : * = avoid, avoid | 2:24: 'avoid', expected '*' or the number of a robot, 1 to 3",
                "robots 1/state red : spaceWanderer/state red : avoid | 3:7: red leads to state 1 already",
                "robots 1/service a avoid | 2:11: 'avoid', expected '=' after the name of a service",
                "robots 1/service a = avid | 2:13: there is no kind of service called 'avid', expected one of: wallFollower, spaceWanderer, goToGoal, avoid (did you mean 'avoid'?)",
                "robots 1/service avoid = spaceWanderer | 2:9: a service of the kind spaceWanderer is called avoid, which is another kind, expected another name",
                "robots 1/service a = avoid/service a = avoid | 3:9: the service a is declared already, expected another name",
                "robots 1/service a = avoid no colors | 2:22: 'colors', expected 'colours' after 'no'",
                "robots 1/service a = avoid(neer 1) | 2:19: avoid has the argument 'neer', expected one of: near, far, turn, onward (did you mean 'near'?)",
                "robots 1/service a = avoid(near) | 2:19: 'near', expected a number after near",
                "robots 1/service a = avoid(near 1, near 2) | 2:27: 'near' is given twice, expected it once",
                "robots 1/service a = avoid(near 1; near 2) | 2:27: 'near' is given twice, expected it once",
                "robots 1/service a = avoid(near -1) | 2:13: avoid: the distance at which it turns in place is -1.0 m, expected more than 0",
                "robots 1/service a = avoid(1) | 2:19: avoid has the number 1, expected words: near, far, turn, onward",
                "robots 1/service a = avoid(near 1 | 2:25: the line ends, expected ')' or ';' or ','",
                "robots 1/service a = goToGoal(1) | 2:22: '1', expected 2 numbers: x, y; ';' separates groups",
                "robots 1/service a = goToGoal(1, 2; again 3) | 2:28: 'again 3', expected again alone",
                "robots 1/service a = goToGoal(1, 2, again) | 2:22: '1, 2, again', expected 2 numbers: x, y; ';' separates groups",
                "robots 1/service a = wallFollower(corners square) | 2:26: 'corners square', expected one of: forward, backward",
            })
    void mistakes_areToldWithTheirPlaceAndWhatWasExpected(String lines, String message) {
        var wrong = catchThrowableOfType(
                SubsumptionTableException.class, () -> read(lines.strip().replace("/", "\n")));
        assertThat(wrong).isNotNull().hasMessage("my.table:" + message);
        assertThat("my.table:" + message).startsWith(wrong.where().orElseThrow() + ": ");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "robots 2 | 1:1: the table has no state",
                "robots 1/ignore red : me/state red : spaceWanderer | 3:7: red leads to state 1, but the table ignores it (me), expected one or the other",
                "robots 1/colour sky #0000FE/state red : spaceWanderer | 2:8: the colour sky is declared and leads to no state",
                "robots 1/service a = avoid/state red : spaceWanderer | 2:9: the service a is declared and in charge of no robot in any state",
                "robots 1/state red : spaceWanderer/state blue : avoid | 3:7: state 2 (blue) can be reached and never ends",
                "robots 1/allow final/state red : avoid/state blue : avoid | 4:7: state 2 (blue) never begins, because no robot in state 1 (red)",
                "robots 1/state red : spaceWanderer > avoid | 2:7: the layer avoid of 'spaceWanderer > avoid' is never reached, because spaceWanderer always drives",
                "robots 1/state red : avoid > avoid > spaceWanderer | 2:7: the layers 'avoid > avoid > spaceWanderer' name avoid twice",
            })
    void mistakesOfTheWholeTable_areReportedWhereTheyWereWritten(String lines, String message) {
        assertThatThrownBy(() -> read(lines.strip().replace("/", "\n")))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessageStartingWith("my.table:" + message);
    }

    @Test
    void kindOrDeclaration_isAServiceForCode() {
        assertThat(SubsumptionTableReader.kind("goToGoal(2.50, 0)", ServiceCatalogue.standard()))
                .isEqualTo(service("goToGoal = goToGoal(2.5, 0)"));
        Service patrol = service("patrol = goToGoal(2.50, 0) colours");
        assertThat(patrol)
                .isEqualTo(service("patrol = goToGoal(2.5, 0) colours"))
                .isNotEqualTo(service("patrol = goToGoal(2.5, 1) colours"));
        assertThat(patrol.findsColours()).isTrue();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "goToGoal(1, 2, again) | service:1:10: '1, 2, again', expected 2 numbers",
                "avoidd | service:1:1: there is no kind of service called 'avoidd'",
                "avoid again | service:1:7: 'again', expected the end of the line",
                "avoid colours | service:1:7: 'colours', expected the end of the line: only the services of tables look for colours",
                "avoid no colours | service:1:7: 'no', expected the end of the line: only the services of tables look for colours",
            })
    void mistakesInAKind_haveTheColumnOfItsText(String text, String message) {
        assertThatThrownBy(() -> SubsumptionTableReader.kind(text, ServiceCatalogue.standard()))
                .isInstanceOf(SubsumptionTableException.class)
                .hasMessageStartingWith(message);
    }
}
