package io.troupe.services.subsumption;

import static io.troupe.services.behaviour.TestSenses.ring;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.player.PlayerClient;
import io.troupe.services.behaviour.RobotPose;
import io.troupe.services.behaviour.Senses;
import io.troupe.services.behaviour.Velocity;
import java.io.File;
import java.io.IOException;
import java.io.StringWriter;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.jar.JarEntry;
import java.util.jar.JarOutputStream;
import java.util.stream.Stream;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Tests valid and invalid jars, which are compiled and packed here. */
class ServiceJarTest {
    private static final String PROVIDERS = "META-INF/services/" + ServiceKinds.class.getName();
    private static final String TURN = kinds("""
            return List.of(new Kind("turn", true, true, arguments -> {
                double rate = arguments.number("rate", 0.5);
                return () -> senses -> Optional.of(Turning.at(rate));
            }));""") + """
            class Turning {
                static io.troupe.services.behaviour.Velocity at(double rate) {
                    return new io.troupe.services.behaviour.Velocity(0, rate);
                }
            }
            """;

    @TempDir
    private Path directory;

    private static String kinds(String body) {
        return """
                import io.troupe.services.subsumption.ServiceCatalogue.Kind;
                import io.troupe.services.subsumption.ServiceKinds;
                import java.util.List;
                import java.util.Optional;
                public class Mine implements ServiceKinds {
                    @Override
                    public List<Kind> kinds() {
                        %s
                    }
                }
                """.formatted(body);
    }

    private static String home(Class<?> type) {
        var location = type.getProtectionDomain().getCodeSource().getLocation();
        return Path.of(URI.create(location.toString())).toString();
    }

    /** Compiles a source named Mine, and writes the provider file. */
    private Path classes(String source, String providers) throws IOException {
        Path classes = directory.resolve("classes");
        Path file = Files.writeString(directory.resolve("Mine.java"), source);
        Path named = classes.resolve(PROVIDERS);
        Files.createDirectories(named.getParent());
        Files.writeString(named, providers);
        String path = home(ServiceKinds.class) + File.pathSeparator + home(PlayerClient.class);
        var compiler = ToolProvider.getSystemJavaCompiler();
        var complaints = new StringWriter();
        try (var files = compiler.getStandardFileManager(null, null, null)) {
            var options = List.of("-cp", path, "-d", classes.toString());
            var task = compiler.getTask(complaints, files, null, options, null, files.getJavaFileObjects(file));
            assertThat(task.call()).as(complaints.toString()).isTrue();
        }
        return classes;
    }

    private Path jar(String source, String providers) throws IOException {
        return pack(classes(source, providers), directory.resolve("mine.jar"));
    }

    private static Path pack(Path classes, Path jar) throws IOException {
        try (var out = new JarOutputStream(Files.newOutputStream(jar));
                Stream<Path> files = Files.walk(classes)) {
            for (Path file : files.filter(Files::isRegularFile).toList()) {
                String name = classes.relativize(file).toString().replace(File.separatorChar, '/');
                out.putNextEntry(new JarEntry(name));
                Files.copy(file, out);
                out.closeEntry();
            }
        }
        return jar;
    }

    private void assertUnusable(Path jar, String... parts) {
        assertThatThrownBy(() -> ServiceJar.open(jar).close())
                .isInstanceOf(ServiceJarException.class)
                .hasMessageStartingWith(jar + ": ")
                .hasMessageContaining("expected")
                .satisfies(thrown -> assertThat(thrown.getMessage()).contains(parts));
    }

    @Test
    void kindOfAJar_isNamedByATable_andItsClassesAreLoadedWhenTheyAreUsed() throws IOException {
        try (var mine = ServiceJar.open(jar(TURN, "Mine"))) {
            var catalogue = mine.addTo(ServiceCatalogue.standard());
            var table = SubsumptionTableReader.parse(
                    "robots 1\nservice slow = turn(rate 0.25)\nstate red : slow\n", Path.of("t"), catalogue);
            var behaviour = table.first().services().getFirst().behaviour().get();
            assertThat(behaviour.step(new Senses(0, ring(), new RobotPose(0, 0, 0))))
                    .hasValue(new Velocity(0, 0.25));
            assertThat(mine.kinds())
                    .singleElement()
                    .extracting(kind -> kind.maker().getClass().getClassLoader())
                    .isNotEqualTo(ServiceKinds.class.getClassLoader());
        }
        try (var mine = ServiceJar.open(classes(TURN, "# mine\nMine\n"))) { // a directory of classes
            assertThat(mine.addTo(ServiceCatalogue.standard()).names()).endsWith("avoid", "turn");
        }
    }

    @Test
    void whatIsNoJar_orHasNoProvider_isToldByItsPath() throws IOException {
        assertUnusable(directory.resolve("none.jar"), "no such file");
        assertUnusable(Files.writeString(directory.resolve("text.jar"), "no zip"), "cannot be read as a jar");
        Path classes = classes(TURN, "");
        assertUnusable(pack(classes, directory.resolve("nobody.jar")), PROVIDERS + " names no class");
        Files.delete(classes.resolve(PROVIDERS));
        assertUnusable(pack(classes, directory.resolve("bare.jar")), "there is no " + PROVIDERS);
    }

    @Test
    void providerThatCannotBeMade_throws_orAnswersNothing_isToldByItsName() throws IOException {
        assertUnusable(jar(TURN, "Yours"), "Provider Yours not found");
        assertUnusable(jar(TURN, "Turning"), "Turning");
        String throwing =
                TURN.replace("@Override", "public Mine() { throw new RuntimeException(\"unfit\"); } @Override");
        assertUnusable(jar(throwing, "Mine"), "Mine", "unfit");
        String initialized = TURN.replace("@Override", "static final int X = Integer.parseInt(\"x\"); @Override");
        assertUnusable(jar(initialized, "Mine"), "Mine", "For input string");
        assertUnusable(jar(kinds("throw new IllegalStateException(\"no idea\");"), "Mine"), "Mine threw", "no idea");
        assertUnusable(jar(kinds("return null;"), "Mine"), "Mine threw", "NullPointerException");
        String lacking = kinds("return List.of(new Kind(Other.NAME, true, true, arguments -> null));")
                + "class Other { static final String NAME = String.valueOf(\"other\"); }";
        Path classes = classes(lacking, "Mine");
        Files.delete(classes.resolve("Other.class"));
        assertUnusable(pack(classes, directory.resolve("lacking.jar")), "Mine threw", "NoClassDefFoundError", "Other");
        Path mine = classes(TURN, "Mine").resolve("Mine.class");
        byte[] later = Files.readAllBytes(mine);
        later[6] = 0x7F; // the class file's major version
        Files.write(mine, later);
        assertUnusable(pack(classes, directory.resolve("later.jar")), "more recent version of the Java Runtime");
    }

    @Test
    void kindWithATakenName_isTold_whoeverHasIt() throws IOException {
        Path avoid = jar(kinds("return List.of(new Kind(\"avoid\", true, true, arguments -> null));"), "Mine");
        try (var mine = ServiceJar.open(avoid)) {
            assertThatThrownBy(() -> mine.addTo(ServiceCatalogue.standard()))
                    .isInstanceOf(ServiceJarException.class)
                    .hasMessage(avoid + ": the catalogue has a kind of service called avoid already,"
                            + " expected another name");
        }
        try (var mine = ServiceJar.open(jar(TURN, "Mine"))) {
            var once = mine.addTo(ServiceCatalogue.standard());
            assertThatThrownBy(() -> mine.addTo(once)).hasMessageContaining("called turn already");
        }
    }

    @Test
    void kindThatThrowsOrAnswersNothing_isToldAtItsPlaceInTheTable() throws IOException {
        for (String maker : List.of("null", "java.util.List.of().getFirst()")) {
            String kind = "return List.of(new Kind(\"bad\", true, true, arguments -> { java.util.function.Supplier<"
                    + "io.troupe.services.behaviour.Behaviour> s = () -> null; Object o = " + maker
                    + "; return (java.util.function.Supplier<io.troupe.services.behaviour.Behaviour>) o; }));";
            try (var mine = ServiceJar.open(jar(kinds(kind), "Mine"))) {
                var catalogue = mine.addTo(ServiceCatalogue.standard());
                assertThatThrownBy(() ->
                                SubsumptionTableReader.parse("robots 1\nstate red : bad\n", Path.of("t"), catalogue))
                        .isInstanceOf(SubsumptionTableException.class)
                        .hasMessageStartingWith("t:2:13: the kind of service bad threw java.")
                        .hasMessageEndingWith(", expected its behaviour");
            }
        }
    }
}
