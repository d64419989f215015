package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerClient;
import io.troupe.services.subsumption.ServiceKinds;
import java.io.File;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
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
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** The procedure of the guide: its sources are compiled and packed, and a table that names their services is run. */
@Timeout(120)
class ServicesJarTest {
    private static final Path SOURCES = Path.of("src", "test", "java", "io", "troupe", "demo", "guide");
    private static final String WORLD = Path.of("worlds", "paper-arena.world").toString();
    private static final String TABLE = """
            robots 2
            service behind = follow(colour orange, gap 0.8)
            state blue : spaceWanderer, behind > spaceWanderer
            state red : seek, spaceWanderer
            """;

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

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @TempDir
    private Path directory;

    private Path table;

    @BeforeEach
    void writeTable() throws IOException {
        table = Files.writeString(directory.resolve("seek.table"), TABLE);
    }

    private int troupe(String... arguments) {
        return Main.execute(new PrintWriter(out), new PrintWriter(err), arguments);
    }

    private static String home(Class<?> type) {
        return Path.of(URI.create(
                        type.getProtectionDomain().getCodeSource().getLocation().toString()))
                .toString();
    }

    /**
     * Compiles the guide's sources without their package, so that they do not clash with the classes of these tests.
     */
    private Path jar() throws Exception {
        List<File> sources = new ArrayList<>();
        for (String name : List.of("LightSeeker.java", "LeaderFollower.java", "SeekingKinds.java")) {
            String text = Files.readString(SOURCES.resolve(name)).replace("package io.troupe.demo.guide;", "");
            sources.add(Files.writeString(directory.resolve(name), text).toFile());
        }
        sources.add(Files.writeString(directory.resolve("LaserKinds.java"), LASER_KINDS)
                .toFile());
        Path classes = Files.createDirectories(directory.resolve("classes"));
        var compiler = ToolProvider.getSystemJavaCompiler();
        try (var files = compiler.getStandardFileManager(null, null, null)) {
            String path = Stream.of(ServiceKinds.class, PlayerClient.class, NamedColours.class)
                    .map(ServicesJarTest::home)
                    .collect(Collectors.joining(File.pathSeparator));
            var options = List.of("-cp", path, "-d", classes.toString());
            var units = files.getJavaFileObjectsFromFiles(sources);
            assertThat(compiler.getTask(null, files, null, options, null, units).call())
                    .isTrue();
        }
        Path jar = directory.resolve("my.jar");
        try (var packed = new JarOutputStream(Files.newOutputStream(jar));
                Stream<Path> files = Files.list(classes)) {
            packed.putNextEntry(new JarEntry("META-INF/services/io.troupe.services.subsumption.ServiceKinds"));
            packed.write("SeekingKinds\nLaserKinds\n".getBytes());
            for (Path file : files.toList()) {
                packed.putNextEntry(new JarEntry(file.getFileName().toString()));
                Files.copy(file, packed);
            }
        }
        return jar;
    }

    @Test
    void run_drivesTheRobotsByTheKindsOfAJar() throws Exception {
        Path o = directory.resolve("o");
        assertThat(troupe(
                        "run",
                        "--world",
                        WORLD,
                        "--table",
                        table.toString(),
                        "--services-jar",
                        jar().toString(),
                        "--seconds",
                        "5",
                        "--out",
                        o.toString()))
                .as(err.toString())
                .isZero();
        assertThat(out.toString()).contains("robot 2 behind > spaceWanderer");
        assertThat(o.resolve("run.jsonl")).isNotEmptyFile();
    }

    /** A leader that drives 4 m in 20 s, and a robot behind it, about as far as the followers want to be. */
    private String parade() throws IOException {
        String include =
                "include \"" + Path.of("worlds").toAbsolutePath().toString().replace('\\', '/') + "/%s.inc\"\n";
        return Files.writeString(
                        directory.resolve("parade.world"),
                        "interval_sim 100\n" + include.formatted("pioneer") + include.formatted("laser") + """
                                pioneer2dx ( name "leader" color "orange" pose [ 1.5 0 0 0 ] scanner () )
                                pioneer2dx ( name "follower" color "black" pose [ 0 0 0 0 ] scanner () )
                                """)
                .toString();
    }

    private static void assertFollowed(String text, String distanceOfTheFollower) {
        var distance = Pattern.compile(distanceOfTheFollower).matcher(text);
        assertThat(distance.find()).as(text).isTrue();
        assertThat(Double.parseDouble(distance.group(1))).isBetween(3.4, 4.6);
    }

    @ParameterizedTest
    @ValueSource(strings = {"chase(gap 0.8)", "follow(colour orange, gap 0.8)"})
    void followerOfAJar_byLaserOrByCamera_followsAsAServiceOfATable(String follower) throws Exception {
        Files.writeString(table, """
                robots 2
                service lead = goToGoal(9, 0; speed 0.2)
                service behind = %s
                state blue : lead, behind
                allow final
                """.formatted(follower));
        String o = directory.resolve("o").toString();
        String jar = jar().toString();
        assertThat(troupe(
                        "run",
                        "--world",
                        parade(),
                        "--table",
                        table.toString(),
                        "--services-jar",
                        jar,
                        "--seconds",
                        "20",
                        "--seed",
                        "3",
                        "--out",
                        o))
                .as(err.toString())
                .isZero();
        assertFollowed(out.toString(), "distance driven +[0-9.]+ m +([0-9.]+) m");
    }

    @ParameterizedTest
    @ValueSource(strings = {"chase(gap 0.8)", "follow(colour orange, gap 0.8)"})
    void followerOfAJar_byLaserOrByCamera_followsAsAComponent(String follower) throws Exception {
        String parade = Files.writeString(directory.resolve("parade.app"), """
                application parade
                component robots is player port=${port} robots=1,2 laser=yes
                component lead   is behaviour of="goToGoal(9, 0; speed 0.2)"
                component behind is behaviour of="%s"
                parade needs service player
                robot1 needs service lead
                robot2 needs service behind
                """.formatted(follower))
                .toString();
        assertThat(troupe("app", parade, "--world", parade(), "--services-jar", jar().toString(), "--seconds", "20"))
                .as(err.toString())
                .isZero();
        assertFollowed(out.toString(), "robot 2 +([0-9.]+) m");
    }

    @Test
    void componentOfAServiceThatIsNotThere_isStatus2_atItsPlace() throws Exception {
        String file = Files.writeString(directory.resolve("a.app"), """
                        application a
                        component robots is player port=${port}
                        component behind is behaviour of="chase(gap 0.8)"
                        """).toString();
        assertThat(troupe("app", file, "--world", WORLD)).isEqualTo(Main.USAGE);
        assertThat(err.toString())
                .startsWith("troupe: " + file + ":3:")
                .contains("of is chase(gap 0.8): service:1:1: there is no kind of service called 'chase'");
    }

    @Test
    void table_isReadWithTheKindsOfAJar_andNotWithoutIt() throws Exception {
        String o = directory.resolve("o").toString();
        String jar = jar().toString();
        assertThat(troupe("table", table.toString(), "--services-jar", jar, "--out", o))
                .as(err.toString())
                .isZero();
        assertThat(out.toString()).contains("behind > spaceWanderer");
        assertThat(troupe("table", table.toString(), "--out", o)).isEqualTo(Main.USAGE);
        assertThat(err.toString()).contains("there is no kind of service called 'follow'");
    }

    @Test
    void jarThatIsNotThere_orHasNoTable_orIsGivenTwice_isOneLine() throws Exception {
        String missing = directory.resolve("none.jar").toString();
        assertThat(troupe("run", "--world", WORLD, "--table", table.toString(), "--services-jar", missing))
                .isEqualTo(Main.USAGE);
        assertThat(troupe("run", "--world", WORLD, "--services-jar", missing)).isEqualTo(Main.USAGE);
        String jar = jar().toString();
        assertThat(troupe("table", table.toString(), "--services-jar", jar, "--services-jar", jar))
                .isEqualTo(Main.USAGE);
        assertThat(err.toString().lines())
                .satisfiesExactly(
                        line -> assertThat(line).startsWith("troupe: " + missing + ": no such file, expected a jar"),
                        line -> assertThat(line).contains(missing + ", but there is no table", "expected a table"),
                        line -> assertThat(line).contains("a kind of service called seek already"));
    }
}
