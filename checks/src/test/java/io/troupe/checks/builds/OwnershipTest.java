package io.troupe.checks.builds;

import static io.troupe.checks.Repository.root;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/**
 * Whose project this is stands once in each build, in {@code gradle.properties} and {@code pom.xml}; that both have the
 * same values is in {@link BuildAgreementTest}. So a new owner changes two files, and the group in those places where
 * nothing but the group itself can stand.
 */
class OwnershipTest {
    /** Maven takes no expression for the group of a parent, and a reader copies the lines of the README and samples. */
    private static final Pattern MAY_NAME_THE_GROUP = Pattern.compile(
            "pom\\.xml|[\\w-]+/pom\\.xml|README\\.md|docs/examples/(?:consumer[\\w-]*|paper)/(?:pom\\.xml|build\\.gradle\\.kts)");

    private static final Pattern OF_MAVEN =
            Pattern.compile("<groupId>([^<]*)</groupId>\\s*<artifactId>troupe(?:-[\\w-]+)?</artifactId>");
    private static final Pattern OF_GRADLE = Pattern.compile("([\\w.]+):troupe-[\\w-]+");
    private static final Pattern ADDRESS = Pattern.compile("(?://|@)(?:[\\w-]+\\.)*troupe\\.(\\w+)");

    private final Build gradle = read();

    private static Build read() {
        try {
            return GradleReader.read(root());
        } catch (IOException failure) {
            throw new AssertionError(failure);
        }
    }

    @Test
    void owner_standsOnceInEachBuild_andNowhereElse() throws IOException {
        assertThat(gradle.owner()).containsOnlyKeys("owner.name", "owner.url", "owner.scm");
        for (String value : gradle.owner().values()) {
            var exactly = Pattern.compile(Pattern.quote(value) + "(?![/\\w])");
            assertThat(places(exactly))
                    .as(value)
                    .isEqualTo(new TreeMap<>(Map.of("gradle.properties", 1, "pom.xml", 1)));
        }
    }

    /** A name under .example is reserved (RFC 2606). */
    @Test
    void addressesOfTroupe_claimNoDomain() throws IOException {
        List<String> claimed = new ArrayList<>();
        for (Path file : Repository.allFiles()) {
            ADDRESS.matcher(text(file))
                    .results()
                    .filter(address -> !gradle.owner().get("owner.url").contains(address.group()))
                    .filter(address -> !address.group(1).equals("example"))
                    .forEach(address -> claimed.add(name(file) + ": " + address.group()));
        }
        assertThat(claimed).isEmpty();
    }

    @Test
    void group_isTheSameWhereItMustStand_andNowhereElse() throws IOException {
        Map<String, List<String>> groups = new TreeMap<>();
        for (Path file : Repository.allFiles()) {
            var text = text(file);
            List<String> found = new ArrayList<>();
            OF_MAVEN.matcher(text).results().forEach(match -> found.add(match.group(1)));
            OF_GRADLE.matcher(text).results().forEach(match -> found.add(match.group(1)));
            found.removeIf(group -> group.equals("${project.groupId}"));
            if (!found.isEmpty() && !name(file).startsWith("checks/src/")) {
                groups.put(name(file), found);
            }
        }
        assertThat(groups.keySet())
                .allMatch(file -> MAY_NAME_THE_GROUP.matcher(file).matches());
        assertThat(groups.values().stream().flatMap(List::stream)).containsOnly(gradle.group());
        for (Path module : Repository.modules()) {
            var pom = name(module.resolve("pom.xml"));
            assertThat(groups.get(pom))
                    .as(pom + " names the group of its parent")
                    .hasSize(1);
        }
    }

    /** How often the pattern is found, by file. */
    private static Map<String, Integer> places(Pattern pattern) throws IOException {
        var places = new TreeMap<String, Integer>();
        for (Path file : Repository.allFiles()) {
            long count = pattern.matcher(text(file))
                    .results()
                    .map(MatchResult::start)
                    .count();
            if (count > 0) {
                places.put(name(file), (int) count);
            }
        }
        return places;
    }

    private static String name(Path file) {
        return root().relativize(file).toString().replace('\\', '/');
    }

    /** As bytes, since some files are pictures. */
    private static String text(Path file) throws IOException {
        return Files.readString(file, StandardCharsets.ISO_8859_1);
    }
}
