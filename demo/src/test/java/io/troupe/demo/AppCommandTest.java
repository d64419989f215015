package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class AppCommandTest extends CommandLineBench {
    private static final String APP = "app --world worlds/paper-arena.cfg ";

    @Test
    void shippedApplication_findsStartsConnectsReplacesAndSums() {
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
                .doesNotContain("told", "problem", "lost");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void shippedApplication_tellsWhichColoursComeIntoSightOfItsCamera() {
        assertThat(printed(APP + "applications/two-robots.app --seconds 120"))
                .containsPattern(
                        "(?s)[0-9.]+ s  seen       finder sees green\\R.*[0-9.]+ s  seen       finder sees red\\R")
                .doesNotContain("sees black", "sees orange"); // walls and the other robot
    }

    @Test
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
    }

    @Test
    void mistakes_areStatus2_andToldWithTheirPlace() throws IOException {
        String file = file("my.app", "application a\ncomponent r is plyer\n").toString();
        assertThat(troupe(APP + "DIR/my.app")).isEqualTo(2);
        assertThat(err.toString())
                .startsWith(
                        "troupe: " + file + ":2:16: there is no kind of component \"plyer\"; did you mean \"player\"?");
        assertRefused(APP, "FILE is missing");
        assertRefused(APP + "x.app --seconds 0", "--seconds is 0.0, expected");
        String expected = ", expected the file of a declaration (see troupe app --help)";
        assertRefused(APP + "no-such.app");
        assertThat(err.toString().strip()).isEqualTo("troupe: no-such.app: no such file" + expected);
        assertRefused(APP + "applications");
        assertThat(err.toString().strip()).isEqualTo("troupe: applications: a directory" + expected);
    }

    @Test
    void component_mayHaveAnyName() throws IOException {
        file("my.app", """
                application a
                component report        is wallFollower
                component a.application is spaceWanderer
                a needs service wallFollower
                """);
        printed(APP + "DIR/my.app --seconds 0.2");
    }

    @Test
    void robotThatTwoDrive_isStatus1() throws IOException {
        file("my.app", """
                application quarrel
                component robots is player port=${port}
                component a is wallFollower
                component b is spaceWanderer
                quarrel needs service player
                robot1 needs service wallFollower
                robot1 needs service spaceWanderer
                """);
        assertThat(troupe(APP + "DIR/my.app")).isEqualTo(1);
        assertThat(err.toString()).startsWith("troupe: robot1/velocity would be fed twice");
    }

    @Test
    void list_namesTheKindsAndWhatCanBeSaidOfThem() {
        assertThat(printed(APP + "--list"))
                .contains("player", "wallFollower", "spaceWanderer", "colourFinder", "process", "robots=", "run=");
    }
}
