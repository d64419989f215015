package io.troupe.services.component.application;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.broker.Need;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import io.troupe.services.component.kinds.BehaviourComponent;
import io.troupe.services.component.kinds.ComponentKind;
import io.troupe.services.component.kinds.ComponentKind.Parameter;
import io.troupe.services.component.kinds.ComponentKinds;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class ApplicationReaderTest {
    private static ApplicationPlan read(String text) {
        return ApplicationReader.parse(text, Path.of("my.app"), ComponentKinds.standard(), Map.of("port", "7000"));
    }

    @Test
    void declaration_isReadAsItStands() {
        var plan = read("""
                # what it is
                application demo          # and a comment

                component robots is player port=${port} robots=1,2
                component finder is colourFinder service=eyes capabilities=sees,looks
                component other is colourFinder
                component script is process run="python3 x.py ${port}"
                robot2 needs service eyes
                demo needs capability sees service eyes
                connect robot1/blobs to finder/blobs
                at 1.5s replace finder by other
                """);
        assertThat(plan.name()).isEqualTo("demo");
        assertThat(plan.components()).containsOnlyKeys("robots", "finder", "other", "script");
        assertThat(plan.components().get("finder").service()).isEqualTo("eyes");
        assertThat(plan.components().get("finder").capabilities()).containsExactly("sees", "looks");
        assertThat(plan.components().get("script").service()).isEqualTo("script");
        assertThat(plan.needs()).containsExactly(Need.ofService("robot2", "eyes"), new Need("demo", "eyes", "sees"));
        assertThat(plan.wires()).extracting(Object::toString).containsExactly("robot1/blobs -> finder/blobs");
        assertThat(plan.replacements()).containsExactly(new Replacement(Duration.ofMillis(1500), "finder", "other"));
    }

    @Test
    void kindOfOnesOwn_isReadAsTheOthers_andNamesAndCommentsAreThoseOfTables() {
        var given = new ArrayList<String>();
        var lamp = new ComponentKind(
                "lamp", "shines", List.of(new Parameter("colour", "of its light", "blue")), (name, arguments) -> {
                    given.add(name + " " + arguments.text("colour"));
                    return BehaviourComponent.of(name, "light", List.of(), () -> senses -> Optional.empty());
                });
        var kinds = ComponentKinds.standard().with(lamp);
        var plan = ApplicationReader.parse("""
                application größe.1
                component sun-é is lamp
                component red is lamp colour=#FF0000 # a comment
                """, Path.of("my.app"), kinds, Map.of());
        assertThat(plan.name()).isEqualTo("größe.1");
        assertThat(plan.components()).containsOnlyKeys("sun-é", "red");
        assertThat(given).containsExactly("sun-é blue", "red #FF0000");
        assertThatThrownBy(() -> kinds.with(lamp)).hasMessage("there is a kind lamp already");
        assertThatThrownBy(() -> ApplicationReader.parse(
                        "application a\ncomponent x is lamp #FF0000", Path.of("my.app"), kinds, Map.of()))
                .hasMessageContaining("my.app:2:21: found \"#FF0000\", expected PARAMETER=VALUE");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = ';',
            value = {
                "compnent x is player; my.app:2:1: found \"compnent\", expected application, component, connect, at, or a user that needs a service; did you mean \"component\"?",
                "component 1x is player; my.app:2:11: \"1x\" is no name, expected the component's name",
                "component x as player; my.app:2:13: found \"as\", expected \"is\"",
                "component x is; my.app:2:15: the line ends here, expected a kind of component",
                "component x is plyer; my.app:2:16: there is no kind of component \"plyer\"; did you mean \"player\"? expected one of",
                "component x is player prot=1; my.app:2:23: player has no parameter \"prot\"; did you mean \"port\"?",
                "component x is player port=zero; my.app:2:23: port is \"zero\", expected a whole number from 1 to 65535",
                "component x is player port=1 port=2; my.app:2:30: \"port\" is given twice, expected it once",
                "component x is player robots=1,1; my.app:2:23: robots has 1 twice, expected each once",
                "component x is player camera=maybe; my.app:2:23: camera is \"maybe\", expected one of yes, no",
                "component x is wallFollower corners=round; my.app:2:29: corners is \"round\", expected one of forward, backward",
                "component x is process; my.app:2:16: a component of kind process has no run, expected run=",
                "component x is process run=\"a b; my.app:2:24: a quote is not closed",
                "component x is player port=${prot}; my.app:2:23: ${prot} has no value here, expected one of [${port}]",
                "component x is wallFollower service=; my.app:2:29: service is \"\", expected a name",
                "component x is wallFollower capabilities=a,; my.app:2:29: capabilities is \"a,\", expected names with commas",
                "application again; my.app:2:1: the name of the application stands here, expected it once, on the first line",
                "connected needs service s; my.app:2:1: \"connected\" is neither the application",
                "robots drive; my.app:2:1: found \"robots\", expected application, component, connect, at, or a user that needs a service",
                "robot1 needs service s; my.app:2:1: \"robot1\" is neither the application nor a component nor a robot of one",
                "demo need service s; my.app:2:6: found \"need\", expected \"needs\"",
                "demo needs servise s; my.app:2:12: found \"servise\", expected \"service\" or \"capability\", each once",
                "demo needs service; my.app:2:19: the line ends here, expected a service",
                "connect a/b to c/d; my.app:2:9: no component above has a topic \"a/b\"; there is none",
                "at noon replace a by b; my.app:2:4: \"noon\" is no time, expected for example 500ms, 20s or 2min",
                "at 2s replace a by b; my.app:2:15: \"a\" is no component of demo",
            })
    void mistake_isNamedByItsPlace_andByWhatWasExpected(String line, String message) {
        assertThatThrownBy(() -> read("application demo\n" + line + "\n"))
                .isInstanceOf(ApplicationFileException.class)
                .hasMessageStartingWith(message);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = ';',
            value = {
                "component r is player; my.app:1:1: the application has no name, expected a line \"application NAME\"",
                "application demo/component r is player/component r is player; my.app:3:16: demo has two components named r, expected one"
            })
    void mistakeOfTheWholeText_isNamedByItsPlace(String lines, String message) {
        assertThatThrownBy(() -> read(lines.replace('/', '\n') + "\n")).hasMessage(message);
    }

    @Test
    void nodes_areThoseOfTheFirstLine_andTheFirstOneHasWhatIsPlacedNowhere() {
        var plan = read("""
                application demo on base,laptop,robot-2
                component a is wallFollower corners=backward on laptop
                component b is spaceWanderer service=s
                component c is spaceWanderer on base
                """);
        assertThat(plan.nodes()).containsExactly("base", "laptop", "robot-2");
        assertThat(plan.componentsOn("base")).containsExactly("b", "c");
        assertThat(plan.componentsOn("laptop")).containsExactly("a");
        assertThat(plan.componentsOn("robot-2")).isEmpty();
        assertThat(plan.inOneProcess().nodes()).isEmpty();
        assertThat(plan.inOneProcess().components()).isEqualTo(plan.components());
        assertThat(read("application demo\n").componentsOn("base")).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = ';',
            value = {
                "application d at base; my.app:1:15: found \"at\", expected \"on\"",
                "application d on; my.app:1:17: the line ends here, expected nodes with commas between them",
                "application d on a,,b; my.app:1:18: the nodes are \"a,,b\", expected names with commas between them",
                "application d on a,b,a; my.app:1:18: the nodes of d are [a, b, a], expected each once",
                "application d on a b; my.app:1:20: found \"b\", expected the end of the line",
                "application d on base,laptop/component w is wallFollower on labtop; 'my.app:2:32: \"labtop\" is no node of d; did you mean \"laptop\"? expected one of base, laptop'",
                "application d on base/component w is wallFollower on; my.app:2:31: the line ends here, expected a node",
                "application d on base/component w is wallFollower on base x; my.app:2:37: found \"x\", expected the end of the line",
                "application d/component w is wallFollower on base; my.app:2:32: d names no nodes, expected \"application d on NODE,NODE\"",
            })
    void mistakeAboutNodes_isNamedByItsPlace(String lines, String message) {
        assertThatThrownBy(() -> read(lines.replace('/', '\n') + "\n"))
                .isInstanceOf(ApplicationFileException.class)
                .hasMessage(message);
    }

    @Test
    void wiresBetweenDifferentTypes_inACircle_orTwice_areRefused() {
        String two = "application demo\ncomponent r is player robots=1,2\nconnect robot1/velocity to robot2/velocity\n";
        assertThatThrownBy(() -> read(two + "connect robot1/sonar to robot1/velocity\n"))
                .hasMessageStartingWith(
                        "my.app:4:25: robot1/velocity is of Velocity, expected a topic of SonarReading as robot1/sonar is");
        assertThatThrownBy(() -> read(two + "connect robot2/velocity to robot1/velocity\n"))
                .hasMessage("my.app:4:28: the wire robot2/velocity -> robot1/velocity closes a cycle, expected"
                        + " wires that end somewhere");
        assertThatThrownBy(() -> read(two + "connect robot1/sonar to robot1/sonar\n"))
                .hasMessageStartingWith("my.app:4:25: the wire robot1/sonar -> robot1/sonar closes a cycle");
        assertThatThrownBy(() -> read(two + "connect robot1/velocity to robot2/velocity\n"))
                .hasMessage("my.app:4:28: robot1/velocity -> robot2/velocity is there already, expected it once");
    }

    @Test
    void text_thatIsNoUtf8_isNamedByItsPlace_andAByteOrderMarkIsNone(@TempDir Path directory) throws IOException {
        Path file = directory.resolve("my.app");
        Files.write(file, new byte[] {'a', '\n', (byte) 0xc3, (byte) 0xa4, '#', (byte) 0xe4, '\n'});
        assertThatThrownBy(() -> ApplicationReader.text(file))
                .isInstanceOf(ApplicationFileException.class)
                .hasMessage(file + ":2:3: the byte here is no UTF-8, expected a text in UTF-8");
        Files.writeString(file, "\uFEFFapplication a\n");
        var plan = ApplicationReader.read(file, ComponentKinds.standard(), Map.of());
        assertThat(plan.name()).isEqualTo("a");
        assertThatThrownBy(() -> ApplicationReader.text(directory))
                .hasMessage(directory + ": a directory, expected the file of a declaration");
    }

    @Test
    void catalogue_describesItsKinds() {
        assertThat(ComponentKinds.standard().all())
                .extracting(kind -> kind.name())
                .containsExactly("player", "wallFollower", "spaceWanderer", "behaviour", "colourFinder", "process");
        assertThat(ComponentKinds.standard().find("process").orElseThrow().describe())
                .contains("run=", "has to be given");
    }
}
