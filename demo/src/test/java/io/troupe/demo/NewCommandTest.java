package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Objects;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** {@code troupe new}: what it writes runs. */
@Timeout(300)
class NewCommandTest extends CommandLineBench {
    @Test
    void world_isRunByTheCommandThatIsPrinted_andItsRobotsChangeTheirServices() throws Exception {
        String text = printed("new DIR/w");
        assertThat(text).contains(local("wrote DIR/w."), local("    cd DIR/w"), "troupe run --world hall.world --view");
        assertThat(written("w/README.md")).contains("run --world hall.world").doesNotContain("{");
        assertMissing("w/MyRobot.java");

        assertThat(printed("run --world DIR/w/hall.world --seconds 60 --out DIR/o"))
                .contains("robot 2 sees red", "state 2");
        assertThat(err.toString()).isEmpty();
    }

    @Test
    void program_compiles_andDrivesItsRobotThroughTheHall_theSameWayEveryTime() throws Exception {
        assertThat(printed("new DIR/p --kind player")).contains("@classpath MyRobot.java");
        assertThat(written("p/README.md"))
                .contains("java @classpath MyRobot.java")
                .doesNotContain("{");
        String path = written("p/classpath");
        assertThat(path).startsWith("-cp \"").endsWith("\"\n").contains("playerlike-sim");

        var compiler = Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE");
        String classes = System.getProperty("java.class.path");
        Path source = directory.resolve("p/MyRobot.java");
        assertThat(compiler.run(null, null, null, "-cp", classes, source.toString()))
                .isZero();
        try (var loader =
                new URLClassLoader(new URL[] {directory.resolve("p").toUri().toURL()})) {
            var run = loader.loadClass("MyRobot").getDeclaredMethod("run", Path.class, int.class);
            run.setAccessible(true);
            var end = (String) run.invoke(null, directory.resolve("p/hall.world"), 300);
            assertThat(run.invoke(null, directory.resolve("p/hall.world"), 300)).isEqualTo(end);
            var numbers = end.split(" m[a-z ]*");
            assertThat(StrictMath.hypot(Double.parseDouble(numbers[0]), Double.parseDouble(numbers[1])))
                    .as(end)
                    .isBetween(1.0, 10.0);
        }
    }

    @Test
    void folderThatIsNotEmpty_orAFile_isRefused_andNothingIsWritten() throws Exception {
        file("full/mine.world", "");
        assertRefused("new DIR/full", "FOLDER is DIR/full, which is not empty, expected a new folder");
        assertRefused("new DIR/full/mine.world", "FOLDER is DIR/full/mine.world, but DIR/full/mine.world is a file");
        assertThat(Files.list(directory.resolve("full"))).hasSize(1);
        assertRefused("new", "FOLDER is missing, expected a new or an empty folder");
    }
}
