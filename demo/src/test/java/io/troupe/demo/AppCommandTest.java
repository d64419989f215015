package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

@Timeout(60)
class AppCommandTest {
    private static final String WORLD = Path.of("worlds", "paper-arena.cfg").toString();

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @TempDir
    private Path directory;

    private int app(String... arguments) {
        var all = new String[arguments.length + 3];
        all[0] = "app";
        all[1] = "--world";
        all[2] = WORLD;
        System.arraycopy(arguments, 0, all, 3, arguments.length);
        return Main.execute(new PrintWriter(out), new PrintWriter(err), all);
    }

    private String file(String text) throws IOException {
        return Files.writeString(directory.resolve("my.app"), text).toString();
    }

    @Test
    void shippedApplication_findsStartsConnectsReplacesAndSums() {
        assertThat(app("applications/two-robots.app", "--seconds", "32")).isZero();
        assertThat(err.toString()).isEmpty();
        assertThat(out.toString())
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
    }

    @Test
    void shippedApplication_tellsWhichColoursComeIntoSightOfItsCamera() {
        assertThat(app("applications/two-robots.app", "--seconds", "120")).isZero();
        assertThat(out.toString())
                .containsPattern(
                        "(?s)[0-9.]+ s  seen       finder sees green\\R.*[0-9.]+ s  seen       finder sees red\\R")
                .doesNotContain("sees black", "sees orange"); // walls and the other robot
    }

    @Test
    void missingService_isStatus3_andOneLine_afterEverythingHasBeenStopped() throws IOException {
        String missing = Files.readString(Path.of("applications", "two-robots.app"))
                .replace("needs service wallFollower", "needs service wallFolower");
        assertThat(app(file(missing))).isEqualTo(3);
        assertThat(err.toString().lines())
                .singleElement()
                .asString()
                .startsWith("troupe: ")
                .contains(
                        "\"robot1\"",
                        "\"wallFolower\"",
                        "did you mean \"wallFollower\"?",
                        "registered: player",
                        "spaceWanderer");
        assertThat(out.toString()).contains("started    robots", "stopped    robots");
    }

    @Test
    void mistakeInTheFile_isStatus2_andNamesItsPlace() throws IOException {
        String file = file("application a\ncomponent r is plyer\n");
        assertThat(app(file)).isEqualTo(2);
        assertThat(err.toString())
                .startsWith(
                        "troupe: " + file + ":2:16: there is no kind of component \"plyer\"; did you mean \"player\"?");
    }

    @Test
    void fileThatIsNotThere_isStatus2() {
        assertThat(app("no-such.app")).isEqualTo(2);
        assertThat(err.toString().strip())
                .isEqualTo("troupe: no-such.app: no such file, expected the file of a declaration"
                        + " (see troupe app --help)");
    }

    @Test
    void directoryInPlaceOfAFile_isStatus2_andNamed() {
        assertThat(app("applications")).isEqualTo(2);
        assertThat(err.toString().strip())
                .isEqualTo("troupe: applications: a directory, expected the file of a declaration"
                        + " (see troupe app --help)");
    }

    @Test
    void component_mayHaveAnyName() throws IOException {
        assertThat(app(file("""
                application a
                component report        is wallFollower
                component a.application is spaceWanderer
                a needs service wallFollower
                """), "--seconds", "0.2")).as(err.toString()).isZero();
    }

    @Test
    void robotThatTwoDrive_isStatus1() throws IOException {
        assertThat(app(file("""
                        application quarrel
                        component robots is player port=${port}
                        component a is wallFollower
                        component b is spaceWanderer
                        quarrel needs service player
                        robot1 needs service wallFollower
                        robot1 needs service spaceWanderer
                        """))).isEqualTo(1);
        assertThat(err.toString()).startsWith("troupe: robot1/velocity would be fed twice");
    }

    @Test
    void missingFileAndWrongTime_areStatus2() {
        assertThat(app()).isEqualTo(2);
        assertThat(app("x.app", "--seconds", "0")).isEqualTo(2);
        assertThat(err.toString()).contains("FILE is missing", "--seconds is 0.0, expected");
    }

    @Test
    void list_namesTheKindsAndWhatCanBeSaidOfThem() {
        assertThat(app("--list")).isZero();
        assertThat(out.toString())
                .contains("player", "wallFollower", "spaceWanderer", "colourFinder", "process", "robots=", "run=");
    }
}
