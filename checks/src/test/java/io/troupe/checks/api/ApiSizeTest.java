package io.troupe.checks.api;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.api.PublicTypes.PublicType;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import java.util.spi.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * The API of actor-core stays small, and is documented. Types that are public only because generated code or another
 * package of the library uses them do not count: they are in {@code io.troupe.actor.internal} and below. The Javadoc
 * pages, as users get them, show the API and no internal types; both builds leave out the internal packages.
 */
class ApiSizeTest {
    private static final int MOST_TYPES = 40;
    private static final Path SOURCES = Repository.root().resolve("actor-core/src/main/java");

    @TempDir
    Path folder;

    @Test
    void publicTypes_ofActorCore_areAtMostForty() throws IOException {
        assertThat(PublicTypes.in(SOURCES))
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .extracting(PublicType::name)
                .as("API types of actor-core")
                .contains("io.troupe.actor.ActorSpace", "io.troupe.actor.promise.Promise")
                .hasSizeLessThanOrEqualTo(MOST_TYPES);
    }

    @Test
    void publicTypes_ofActorCore_haveJavadoc() throws IOException {
        assertThat(PublicTypes.in(SOURCES))
                .filteredOn(type -> type.javadoc().isEmpty())
                .as("public types without a class comment")
                .isEmpty();
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
                Pattern.compile("followAtHome|enqueueAtHome|ActorCell|NodeQueue|TimerWheel|troupe\\$cell|settleValue"
                        + "|/(Message|Request|Node|Owner|ActorProxy|Home|Recipient)\\.html");
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
                List.of("-classpath", System.getProperty("java.class.path")),
                List.of("-sourcepath", SOURCES.toString(), "-subpackages", "io.troupe.actor"),
                List.of("-exclude", "io.troupe.actor.internal:io.troupe.actor.internal.loop"));
        var javadoc = ToolProvider.findFirst("javadoc").orElseThrow();
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

    private static String page(PublicType type) {
        return type.name().replace('.', '/') + ".html";
    }
}
