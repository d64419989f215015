package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerClient;
import io.troupe.services.subsumption.ServiceKinds;
import java.io.File;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.jar.JarEntry;
import java.util.jar.JarOutputStream;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The procedure of the guide: its sources are compiled and packed, and a table that names their services is run. */
@Timeout(120)
class ServicesJarTest extends CommandLineBench {
    private static final Path SOURCES = Path.of("src", "test", "java", "io", "troupe", "demo", "guide");
    private static final String JAR = "--services-jar DIR/my.jar ";

    /** A follower that uses the laser. */
    private static final String LASER_KINDS = """
            import io.troupe.services.behaviour.Velocity;
            import io.troupe.services.subsumption.ServiceCatalogue.Kind;
            import io.troupe.services.subsumption.ServiceKinds;
            import java.util.List;
            import java.util.Optional;
            public class LaserKinds implements ServiceKinds {
                @Override
                public List<Kind> kinds() {
                    return List.of(new Kind("chase", false, false, arguments -> {
                        double gapM = arguments.number("gap", 1);
                        return () -> senses -> {
                            double aheadM = senses.laser().nearestM(-0.1, 0.1);
                            return Optional.of(new Velocity(Math.clamp(0.5 * (aheadM - gapM), -0.2, 0.5), 0));
                        };
                    }).withLaser());
                }
            }
            """;

    private static String home(Class<?> type) {
        var location = type.getProtectionDomain().getCodeSource().getLocation();
        return Path.of(URI.create(location.toString())).toString();
    }

    /**
     * Compiles the guide's sources without their package, so that they do not clash with the classes of these tests.
     */
    @BeforeEach
    void writeTableAndJar() throws Exception {
        file("seek.table", """
                robots 2
                service behind = follow(colour orange, gap 0.8)
                state blue : spaceWanderer, behind > spaceWanderer
                state red : seek, spaceWanderer
                """);
        List<Path> sources = new ArrayList<>(List.of(file("LaserKinds.java", LASER_KINDS)));
        for (String name : List.of("LightSeeker.java", "LeaderFollower.java", "SeekingKinds.java")) {
            String text = Files.readString(SOURCES.resolve(name));
            sources.add(file(name, text.replace("package io.troupe.demo.guide;", "")));
        }
        Path classes = Files.createDirectories(directory.resolve("classes"));
        var compiler = ToolProvider.getSystemJavaCompiler();
        try (var files = compiler.getStandardFileManager(null, null, null)) {
            String path = Stream.of(ServiceKinds.class, PlayerClient.class, NamedColours.class)
                    .map(ServicesJarTest::home)
                    .collect(Collectors.joining(File.pathSeparator));
            var options = List.of("-cp", path, "-d", classes.toString());
            var units = files.getJavaFileObjectsFromPaths(sources);
            assertThat(compiler.getTask(null, files, null, options, null, units).call())
                    .isTrue();
        }
        try (var packed = new JarOutputStream(Files.newOutputStream(directory.resolve("my.jar")));
                var files = Files.list(classes)) {
            packed.putNextEntry(new JarEntry("META-INF/services/io.troupe.services.subsumption.ServiceKinds"));
            packed.write("SeekingKinds\nLaserKinds\n".getBytes());
            for (Path file : files.toList()) {
                packed.putNextEntry(new JarEntry(file.getFileName().toString()));
                Files.copy(file, packed);
            }
        }
    }

    @Test
    void run_drivesTheRobotsByTheKindsOfAJar() {
        assertThat(printed("run " + ARENA + JAR + "--table DIR/seek.table --seconds 5 --out DIR"))
                .contains("robot 2 behind > spaceWanderer");
        assertWritten("run.jsonl");
    }

    private static void assertFollowed(String text, String distanceOfTheFollower) {
        var distance = Pattern.compile(distanceOfTheFollower).matcher(text);
        assertThat(distance.find()).as(text).isTrue();
        assertThat(Double.parseDouble(distance.group(1))).isBetween(3.4, 4.6);
    }

    @ParameterizedTest
    @ValueSource(strings = {"chase(gap 0.8)", "follow(colour orange, gap 0.8)"})
    void followerOfAJar_byLaserOrByCamera_followsAsAServiceOfATable_andAsAComponent(String follower)
            throws IOException {
        // a leader that drives 4 m in 20 s, and a robot behind it, about as far as the followers want to be
        file("parade.world", """
                interval_sim 100
                include "pioneer.inc"
                include "sick.inc"
                pioneer2dx ( name "leader" color "orange" pose [ 1.5 0 0 0 ] sicklaser () )
                pioneer2dx ( name "follower" color "black" pose [ 0 0 0 0 ] sicklaser () )
                """);
        file("parade.table", """
                robots 2
                service lead = goToGoal(9, 0; speed 0.2)
                service behind = %s
                state blue : lead, behind
                allow final
                """.formatted(follower));
        String table = "--table DIR/parade.table --seed 3 --out DIR";
        assertFollowed(
                printed("run --world DIR/parade.world --seconds 20 " + JAR + table),
                "distance driven +[0-9.]+ m +([0-9.]+) m");

        file("parade.app", """
                application parade
                component robots is player port=${port} robots=1,2 laser=yes
                component lead   is behaviour of="goToGoal(9, 0; speed 0.2)"
                component behind is behaviour of="%s"
                parade needs service player
                robot1 needs service lead
                robot2 needs service behind
                """.formatted(follower));
        String text = printed("app DIR/parade.app --world DIR/parade.world --out DIR/o --seconds 20 " + JAR);
        assertFollowed(text, "robot 2 +([0-9.]+) m");
    }

    @Test
    void table_isReadWithTheKindsOfAJar_andNotWithoutIt() {
        String table = "table DIR/seek.table --out DIR/o ";
        assertThat(printed(table + JAR)).contains("behind > spaceWanderer");
        assertRefused(table, "there is no kind of service called 'follow'");
    }

    @Test
    void mistakes_areOneLine() throws IOException {
        file("a.app", """
                application a
                component robots is player port=${port}
                component behind is behaviour of="chase(gap 0.8)"
                """);
        String unknown = "of is chase(gap 0.8): service:1:1: there is no kind of service called 'chase'";
        assertRefused("app DIR/a.app " + ARENA, "troupe: DIR/a.app:3:", unknown);
        String run = "run " + ARENA + "--services-jar DIR/none.jar ";
        assertRefused(run + "--table DIR/seek.table", "troupe: DIR/none.jar: no such file, expected a jar");
        assertRefused(run, "DIR/none.jar, but there is no table", "expected a table");
        assertRefused("table DIR/seek.table " + JAR + JAR, "a kind of service called seek already");
    }
}
