package io.troupe.checks.api;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.TestMethods;
import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Every row in {@code docs/contract-actor-core.md} names a test, and the tests exist. */
class ContractTableTest {
    @Test
    void everyPoint_namesATest() throws IOException {
        var rows = rows();
        assertThat(rows).as("points of the contract").hasSizeGreaterThan(50);
        assertThat(rows)
                .as("points without a test")
                .allMatch(row -> !TestMethods.namedIn(row).isEmpty());
    }

    @Test
    void everyTestNamed_exists() throws IOException {
        assertThat(TestMethods.missing(String.join("\n", rows())))
                .as("tests that the table names and that do not exist")
                .isEmpty();
    }

    @Test
    void everyTestOfContractTest_isNamed() throws IOException {
        var named = TestMethods.namedIn(String.join("\n", rows())).stream()
                .filter(reference -> reference.type().equals("ContractTest"))
                .map(TestMethods.Reference::method)
                .toList();
        assertThat(named).containsAll(TestMethods.of("ContractTest"));
    }

    /** The rows of the tables, without their heads and rules. */
    private static List<String> rows() throws IOException {
        return Files.readAllLines(Repository.root().resolve("docs/contract-actor-core.md")).stream()
                .filter(line -> line.startsWith("| ") && !line.startsWith("| Point"))
                .toList();
    }
}
