package io.troupe.checks.api;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** Every point in {@code docs/contract-actor-core.md} names a test, and the tests it names exist. */
class ContractTableTest {
    private static final Pattern REFERENCE = Pattern.compile("`(\\w+Test)\\.(\\w+)`");
    private static final Pattern TEST_METHOD =
            Pattern.compile("@(?:Test|Property|ParameterizedTest)\\b[^;{}]*?\\bvoid (\\w+)\\(");

    private record Reference(String type, String method) {
        static Reference of(MatchResult match) {
            return new Reference(match.group(1), match.group(2));
        }
    }

    @Test
    void everyPoint_namesATest() throws IOException {
        var rows = rows();
        assertThat(rows).as("points of the contract").hasSizeGreaterThan(50);
        assertThat(rows)
                .as("points without a test")
                .allMatch(row -> REFERENCE.matcher(row).find());
    }

    @Test
    void everyTestNamed_exists() throws IOException {
        Set<String> missing = new TreeSet<>();
        for (Reference reference : references()) {
            if (!tests(reference.type()).contains(reference.method())) {
                missing.add(reference.type() + "." + reference.method());
            }
        }
        assertThat(missing)
                .as("tests that the table names and that do not exist")
                .isEmpty();
    }

    @Test
    void everyTestOfContractTest_isNamed() throws IOException {
        var named = references().stream()
                .filter(reference -> reference.type().equals("ContractTest"))
                .map(Reference::method)
                .toList();
        assertThat(named).containsAll(tests("ContractTest"));
    }

    /** The rows of the tables, without their heads and rules. */
    private static List<String> rows() throws IOException {
        return Files.readAllLines(Repository.root().resolve("docs/contract-actor-core.md")).stream()
                .filter(line -> line.startsWith("| ") && !line.startsWith("| Point"))
                .toList();
    }

    private static List<Reference> references() throws IOException {
        return rows().stream()
                .flatMap(row -> REFERENCE.matcher(row).results())
                .map(Reference::of)
                .toList();
    }

    /** The test methods of all test classes of that simple name. */
    private static List<String> tests(String type) throws IOException {
        List<String> methods = new ArrayList<>();
        for (Path module : Repository.modules()) {
            var folder = module.resolve("src/test");
            if (Files.isDirectory(folder)) {
                try (var files = Files.walk(folder)) {
                    for (Path file :
                            files.filter(each -> each.endsWith(type + ".java")).toList()) {
                        TEST_METHOD
                                .matcher(Files.readString(file))
                                .results()
                                .forEach(match -> methods.add(match.group(1)));
                    }
                }
            }
        }
        return methods;
    }
}
