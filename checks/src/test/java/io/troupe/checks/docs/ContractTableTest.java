package io.troupe.checks.docs;

import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.CallbackProbe;
import io.troupe.actor.testkit.Probe;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.checks.Repository;
import java.io.IOException;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

/**
 * Every row in {@code docs/contract-actor-core.md}, and every one of the paper's six challenges in the guide, names a
 * test as {@code `ClassTest.method`}, and the tests exist. The tables of the test kit have its methods.
 */
class ContractTableTest {
    private static final Pattern REFERENCE = Pattern.compile("`(\\w+Test)\\.(\\w+)`");
    private static final Pattern TEST_METHOD =
            Pattern.compile("@(?:Test|Property|ParameterizedTest)\\b(?:(?!\\bvoid\\b)[\\s\\S])*?\\bvoid (\\w+)\\(");
    /** Quoted text, which may contain anything between the annotation and the method. */
    private static final Pattern STRING = Pattern.compile("\"(?:[^\"\\\\\\n]|\\\\.)*\"");

    private static final Pattern METHOD = Pattern.compile("`(\\w+)\\(");

    /** A test method, with the simple name of its class. */
    private record Reference(String type, String method) {}

    @Test
    void everyPoint_namesTestsThatExist() throws IOException {
        var rows = rows("docs/contract-actor-core.md", "\\| (?!Point).*");
        assertThat(rows).as("points of the contract").hasSizeGreaterThan(50);
        requireTests(rows);
        var named = namedIn(String.join("\n", rows)).stream()
                .filter(reference -> reference.type().equals("ContractTest"))
                .map(Reference::method)
                .toList();
        assertThat(named).containsAll(methodsOf("ContractTest"));
    }

    @Test
    void everyChallenge_namesTestsThatExist() throws IOException {
        var rows = rows("docs/guide/10-challenges.md", "\\| \\[.*");
        assertThat(rows)
                .extracting(row -> row.substring(2, row.indexOf(']') + 1))
                .containsExactly("[i]", "[ii]", "[iii]", "[iv]", "[v]", "[vi]");
        requireTests(rows);
    }

    @Test
    void everyMethodOfTheTestKit_isInTheTableOfItsType_andTheOthersAreNot() throws IOException {
        for (Class<?> type : List.of(TestSpace.class, Probe.class, CallbackProbe.class)) {
            var inherited = Stream.concat(Stream.of(Object.class), Stream.of(type.getInterfaces()))
                    .flatMap(above -> Stream.of(above.getMethods()))
                    .map(Method::getName)
                    .collect(toSet());
            var ours = Stream.of(type.getDeclaredMethods())
                    .filter(method -> Modifier.isPublic(method.getModifiers()) && !method.isSynthetic())
                    .map(Method::getName)
                    .collect(toSet());
            var inTable = methodsInTable(type.getSimpleName());
            assertThat(ours).as("methods of " + type).containsAll(inTable);
            ours.removeAll(inherited);
            assertThat(inTable).as("methods in the guide's table of " + type).containsAll(ours);
        }
    }

    /** The methods in the first column of the table that has the name of their type above that column. */
    private static Set<String> methodsInTable(String type) throws IOException {
        return Repository.text("docs/guide/20-testing-actors.md")
                .lines()
                .dropWhile(line -> !line.matches("\\| `" + type + "\\b.*"))
                .skip(2) // the type, and the rule below it
                .takeWhile(line -> line.startsWith("|"))
                .flatMap(row ->
                        METHOD.matcher(row.substring(0, row.indexOf(" | "))).results())
                .map(match -> match.group(1))
                .collect(toSet());
    }

    /** The rows of the tables of a page, without their heads and rules. */
    private static List<String> rows(String page, String pattern) throws IOException {
        var lines = Repository.text(page).lines();
        return lines.filter(line -> line.matches(pattern)).toList();
    }

    private static void requireTests(List<String> rows) throws IOException {
        for (String row : rows) {
            var named = namedIn(row);
            assertThat(named).as(row).isNotEmpty();
            for (var reference : named) {
                assertThat(methodsOf(reference.type())).as(row).contains(reference.method());
            }
        }
    }

    private static List<Reference> namedIn(String text) {
        var references = REFERENCE.matcher(text).results();
        return references
                .map(match -> new Reference(match.group(1), match.group(2)))
                .toList();
    }

    /** The test methods of all test classes of that simple name. */
    private static List<String> methodsOf(String type) throws IOException {
        List<String> methods = new ArrayList<>();
        for (Path module : Repository.modules()) {
            for (Path file : Repository.files(module.resolve("src/test"), type + ".java")) {
                if (file.endsWith(type + ".java")) {
                    var source = STRING.matcher(Files.readString(file)).replaceAll("\"\"");
                    TEST_METHOD.matcher(source).results().forEach(match -> methods.add(match.group(1)));
                }
            }
        }
        return methods;
    }
}
