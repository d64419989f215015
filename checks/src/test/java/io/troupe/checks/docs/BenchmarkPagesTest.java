package io.troupe.checks.docs;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import java.io.IOException;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.UnaryOperator;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;

/** The short tables of {@code docs/benchmarks.md} have the medians of the full ones in {@code benchmarks-method.md}. */
class BenchmarkPagesTest {
    /** A workload or number of robots, a contender, and a median with its quartiles. */
    private static final Pattern FULL_ROW = Pattern.compile("\\| (\\S+) \\| ([a-z]\\S*) \\| ([\\d,.]+) \\(.*?\\) .*");

    @Test
    void timesOfActors_areThoseOfTheFullTable() throws IOException {
        var full = fullTable("[a-zA-Z]+");
        var brief = shortTable("| workload |");
        assertThat(brief).hasSize(9).containsOnlyKeys(full.keySet());
        brief.forEach((workload, row) -> {
            var figures = full.getOrDefault(workload, Map.of());
            requireRow(workload, row, 11, figures::get);
        });
    }

    @Test
    void speedsOfWorlds_areThoseOfTheFullTable() throws IOException {
        var full = fullTable("[\\d,]+");
        var brief = shortTable("| robots | troupe |");
        assertThat(brief).hasSize(6).containsOnlyKeys(full.keySet());
        brief.forEach((robots, row) -> {
            var figures = full.getOrDefault(robots, Map.of());
            requireRow(robots, row, 6, figures::get);
        });
    }

    private static void requireRow(String as, Map<String, String> row, int size, UnaryOperator<String> expected) {
        assertThat(row).as(as).hasSize(size);
        row.forEach((contender, figure) -> assertThat(figure).as(as).isEqualTo(expected.apply(contender)));
    }

    /** The medians, by workload or number of robots, then by contender. */
    private static Map<String, Map<String, String>> fullTable(String key) throws IOException {
        Map<String, Map<String, String>> table = new LinkedHashMap<>();
        for (String line : lines("docs/benchmarks-method.md")) {
            var row = FULL_ROW.matcher(line);
            if (row.matches() && row.group(1).matches(key)) {
                table.computeIfAbsent(row.group(1), name -> new LinkedHashMap<>())
                        .put(row.group(2), row.group(3));
            }
        }
        return table;
    }

    /** By the first cell of the row, then by the head of the column. */
    private static Map<String, Map<String, String>> shortTable(String head) throws IOException {
        List<String> rows = lines("docs/benchmarks.md").stream()
                .dropWhile(line -> !line.startsWith(head))
                .takeWhile(line -> line.startsWith("|"))
                .toList();
        assertThat(rows).as(head).hasSizeGreaterThan(2);
        String[] heads = cells(rows.getFirst());
        Map<String, Map<String, String>> table = new LinkedHashMap<>();
        for (String line : rows.subList(2, rows.size())) {
            String[] cells = cells(line);
            Map<String, String> row = new LinkedHashMap<>();
            for (int i = 1; i < cells.length; i++) {
                row.put(heads[i], cells[i]);
            }
            table.put(cells[0].replace("`", ""), row);
        }
        return table;
    }

    private static String[] cells(String row) {
        return row.substring(2, row.length() - 2).split(" \\| ");
    }

    private static List<String> lines(String page) throws IOException {
        return Repository.text(page).lines().toList();
    }
}
