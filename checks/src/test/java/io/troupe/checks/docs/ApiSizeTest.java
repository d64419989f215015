package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import com.sun.source.tree.ClassTree;
import com.sun.source.tree.CompilationUnitTree;
import com.sun.source.util.DocTrees;
import com.sun.source.util.JavacTask;
import com.sun.source.util.TreePath;
import io.troupe.checks.Repository;
import io.troupe.checks.docs.ApiSizeTest.PublicTypes.PublicType;
import java.io.File;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.TreeMap;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.lang.model.element.Modifier;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * The API of the libraries stays small, and is documented. Types that are public only because generated code or another
 * package of the library uses them do not count: they are hidden, or in {@code io.troupe.actor.internal} and below. The
 * Javadoc pages, as users get them, show the API and no internal types; both builds leave out the internal packages.
 */
class ApiSizeTest {
    private static final Path SOURCES = Repository.root().resolve("actor-core/src/main/java");

    @TempDir
    Path folder;

    /** A new type of the API needs a reason, or one that goes. Nearly all of the simulator are structures of Player. */
    @ParameterizedTest
    @CsvSource({
        "common, 8",
        "drawing, 3",
        "actor-core, 41",
        "actor-service, 32",
        "actor-nats, 2",
        "actor-micrometer, 1",
        "playerlike-sim, 316",
        "services, 66",
        "verification, 68",
        "view, 24"
    })
    void publicTypes_ofEachLibrary_areFew_andHaveJavadoc(String module, int most) throws IOException {
        var types = PublicTypes.in(Repository.root().resolve(module).resolve("src/main/java"));
        assertThat(types)
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .as("API types of " + module)
                .isNotEmpty()
                .hasSizeLessThanOrEqualTo(most);
        assertThat(types)
                .filteredOn(type -> type.javadoc().isEmpty())
                .as("public types without a class comment")
                .isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"actor-core", "actor-service"})
    void types_haveASample_orSayHowUsersMeetThem(String module) throws IOException {
        Path folder = Repository.root().resolve(module).resolve("src/main/java");
        assertThat(PublicTypes.in(folder))
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .hasSizeGreaterThan(20)
                .allSatisfy(type ->
                        assertThat(type.javadoc()).as(type.name()).containsAnyOf("{@snippet", "Users meet it as "));
    }

    /** The client and its interfaces that work; the package documentation gives the reason for the others. */
    @Test
    void workingTypesOfThePlayerClient_haveASample() throws IOException {
        var types = PublicTypes.in(Repository.root().resolve("playerlike-sim/src/main/java/io/troupe/player"));
        for (String working :
                List.of("PlayerClient", "Position2D", "Sonar", "Laser", "Blobfinder", "Ranger", "Simulation")) {
            String name = "io.troupe.player." + (working.equals("PlayerClient") ? working : working + "Interface");
            assertThat(types)
                    .filteredOn(type -> type.name().equals(name))
                    .singleElement()
                    .satisfies(type -> assertThat(type.javadoc()).as(name).contains("{@snippet"));
        }
    }

    @Test
    void reader_seesPublicTypesOnly_andWhichAreInternal() throws IOException {
        Files.writeString(folder.resolve("Marked.java"), """
                package some.internal;
                /** Helps
                 * the library. */
                @Deprecated
                public class Marked { public static class Inner {} }
                class Hidden {}
                """);
        Files.writeString(folder.resolve("Bare.java"), """
                package some;
                // for generated code
                public record Bare(int size) {}
                """);
        assertThat(PublicTypes.in(folder))
                .containsExactly(
                        new PublicType("some.Bare", ""), new PublicType("some.internal.Marked", "Helps the library."))
                .extracting(PublicType::isForTheLibraryOnly)
                .containsExactly(false, true);
    }

    @Test
    void pages_areThoseOfTheApi_andNameNoMachinery() throws IOException {
        var pages = pages();
        var types = PublicTypes.in(SOURCES);
        assertThat(types)
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .hasSizeGreaterThan(20)
                .allSatisfy(type -> assertThat(pages).containsKey(page(type)));
        assertThat(types)
                .filteredOn(type -> type.isForTheLibraryOnly())
                .hasSizeGreaterThan(5)
                .allSatisfy(type -> assertThat(pages).doesNotContainKey(page(type)));
        var machinery =
                Pattern.compile("followAtHome|enqueueAtHome|ActorCell|EntryQueue|TimerWheel|troupe\\$cell|settleValue"
                        + "|/(Message|Request|QueueEntry|TurnOwner|ActorProxy|Home|Recipient)\\.html");
        assertThat(pages)
                .hasSizeGreaterThan(30)
                .allSatisfy((page, text) -> assertThat(
                                machinery.matcher(text).results().map(MatchResult::group))
                        .as(page)
                        .isEmpty());
    }

    /** The texts of the pages that javadoc makes, by path in the folder. */
    private Map<String, String> pages() throws IOException {
        var output = new StringWriter();
        var arguments = List.of(
                List.of("-quiet", "-Xdoclint:none", "-d", folder.toString()),
                List.of("--module-path", modules()),
                List.of("-sourcepath", SOURCES.toString(), "-subpackages", "io.troupe.actor"),
                List.of("-exclude", "io.troupe.actor.internal:io.troupe.actor.internal.loop"));
        var javadoc = java.util.spi.ToolProvider.findFirst("javadoc").orElseThrow();
        var writer = new PrintWriter(output);
        int status = javadoc.run(
                writer, writer, arguments.stream().flatMap(List::stream).toArray(String[]::new));
        assertThat(status).as(output.toString()).isZero();
        Map<String, String> texts = new TreeMap<>();
        for (Path page : Repository.files(folder, ".html")) {
            texts.put(folder.relativize(page).toString(), Files.readString(page));
        }
        return texts;
    }

    /** The libraries that the descriptor of the module names. */
    private static String modules() {
        return Stream.of(System.getProperty("java.class.path").split(File.pathSeparator))
                .filter(each -> each.matches(".*[/\\\\](asm|jspecify)-[\\d.]+\\.jar"))
                .collect(Collectors.joining(File.pathSeparator));
    }

    private static String page(PublicType type) {
        return "io.troupe.actor/" + type.name().replace('.', '/') + ".html";
    }

    /** Reads the public top-level types of a source folder, with their Javadoc, by the compiler's own parser. */
    static final class PublicTypes {
        /**
         * A public top-level type.
         *
         * @param name the qualified name
         * @param javadoc the text of its comment in one line; empty if it has none
         */
        record PublicType(String name, String javadoc) {
            /**
             * True if it is public for technical reasons only: it is hidden, or in a package called {@code internal} or
             * below.
             */
            boolean isForTheLibraryOnly() {
                return name.contains(".internal.") || javadoc.contains("@hidden");
            }
        }

        private PublicTypes() {}

        static List<PublicType> in(Path folder) throws IOException {
            var compiler =
                    Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE, runs the tests");
            List<PublicType> types = new ArrayList<>();
            try (var files = compiler.getStandardFileManager(null, null, null)) {
                var task = (JavacTask) compiler.getTask(
                        null,
                        files,
                        null,
                        List.of("-proc:none"),
                        null,
                        files.getJavaFileObjectsFromPaths(Repository.files(folder, ".java")));
                var docs = DocTrees.instance(task);
                for (CompilationUnitTree unit : task.parse()) {
                    for (var declaration : unit.getTypeDecls()) {
                        if (declaration instanceof ClassTree type
                                && type.getModifiers().getFlags().contains(Modifier.PUBLIC)) {
                            String comment = docs.getDocComment(TreePath.getPath(unit, type));
                            types.add(new PublicType(
                                    unit.getPackageName() + "." + type.getSimpleName(),
                                    comment == null ? "" : comment.strip().replaceAll("\\s+", " ")));
                        }
                    }
                }
            }
            return types;
        }
    }
}
