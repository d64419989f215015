package io.troupe.checks.api;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.api.PublicTypes.PublicType;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Pattern;
import java.util.spi.ToolProvider;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * The Javadoc pages of actor-core, as its users get them, show the API and no internal types. A type that is public for
 * technical reasons only is in an internal package, which both builds leave out.
 */
class ApiPagesTest {
    @TempDir
    static Path pages;

    private static final Map<String, String> TEXTS = new TreeMap<>(); // by path in the folder

    @BeforeAll
    static void makePages() throws IOException {
        Path sources = Repository.root().resolve("actor-core/src/main/java");
        List<String> arguments = new ArrayList<>(List.of("-quiet", "-Xdoclint:none", "-d", pages.toString()));
        arguments.addAll(List.of("-classpath", System.getProperty("java.class.path")));
        arguments.addAll(List.of("-sourcepath", sources.toString(), "-subpackages", "io.troupe.actor"));
        arguments.addAll(List.of("-exclude", "io.troupe.actor.internal:io.troupe.actor.internal.loop"));
        var output = new StringWriter();
        int status = ToolProvider.findFirst("javadoc")
                .orElseThrow()
                .run(new PrintWriter(output), new PrintWriter(output), arguments.toArray(String[]::new));
        assertThat(status).as(output.toString()).isZero();
        try (var files = Files.walk(pages)) {
            for (Path page :
                    files.filter(file -> file.toString().endsWith(".html")).toList()) {
                TEXTS.put(pages.relativize(page).toString(), Files.readString(page));
            }
        }
    }

    @Test
    void everyTypeOfTheApi_hasAPage_andNoOther() throws IOException {
        var types = PublicTypes.in(Repository.root().resolve("actor-core/src/main/java"));
        assertThat(types)
                .filteredOn(type -> !type.isForTheLibraryOnly())
                .hasSizeGreaterThan(20)
                .allSatisfy(type -> assertThat(TEXTS).containsKey(page(type)));
        assertThat(types)
                .filteredOn(type -> type.isForTheLibraryOnly())
                .hasSizeGreaterThan(5)
                .allSatisfy(type -> assertThat(TEXTS).doesNotContainKey(page(type)));
    }

    @Test
    void pages_nameNoMachinery() {
        var machinery =
                Pattern.compile("followAtHome|enqueueAtHome|ActorCell|NodeQueue|TimerWheel|troupe\\$cell|settleValue"
                        + "|/(Message|Request|Node|Owner|ActorProxy|Home|Recipient)\\.html");
        assertThat(TEXTS)
                .hasSizeGreaterThan(30)
                .allSatisfy((page, text) -> assertThat(machinery
                                .matcher(text)
                                .results()
                                .map(match -> match.group())
                                .toList())
                        .as(page)
                        .isEmpty());
    }

    private static String page(PublicType type) {
        return type.name().replace('.', '/') + ".html";
    }
}
