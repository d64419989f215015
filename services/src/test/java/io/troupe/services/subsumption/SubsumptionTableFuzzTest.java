package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

/**
 * Valid files after random edits: the reader returns a table or reports the position of the error, and nothing else
 * happens.
 */
class SubsumptionTableFuzzTest {
    private static final int EDITED = 20_000;
    private static final String GOOD = """
            # all that a file can say
            robots 7
            ignore black : walls # and more
            ignore orange
            colour violet #8A2BE2
            colour blue
            service patrol = goToGoal(1.5, -2; 3, 0; speed 0.3; within 0.2; again) colours
            service dodge = avoid(near 0.4; far .65) no colours
            service wallFollower = wallFollower(corners backward)
            hold 1.5 s
            allow final
            state blue : wallFollower, spaceWanderer, dodge > patrol, patrol, dodge, dodge > spaceWanderer, avoid
            state violet priority 2 : * = spaceWanderer, 3..5 = wallFollower, 7 = dodge > patrol
            state #123456 priority -1 : 1..7 = spaceWanderer
            """;
    private static final List<String> PIECES = List.of(
            "#",
            "..",
            "*",
            ">",
            ",",
            ";",
            "(",
            ")",
            "=",
            ":",
            "-",
            "7",
            "0",
            "1e400",
            "99999999999",
            "\n",
            "\r",
            " ",
            "\t",
            "\0",
            "é",
            "\uD83D",
            "\uD83E\uDD16",
            "#FFFFFF",
            "state red : ",
            "priority",
            "colours",
            "no",
            "final",
            "ms",
            "spaceWanderer",
            "goToGoal",
            "robots 3");

    @Test
    void goodFile_isRead() {
        assertThat(parse(GOOD).states()).hasSize(3);
    }

    @Test
    void editedFile_isATable_orTheMistakeIsReportedWithItsPosition() {
        int tables = 0;
        for (int seed = 0; seed < EDITED; seed++) {
            String text = edited(new Random(seed));
            try {
                SubsumptionTable table = parse(text);
                tables++;
                assertThat(parse(SubsumptionTableWriter.write(table)))
                        .as("seed %d", seed)
                        .isEqualTo(table);
            } catch (SubsumptionTableException wrong) {
                var where = wrong.where().orElseThrow();
                assertThat(wrong)
                        .as("seed %d", seed)
                        .hasMessageStartingWith("fuzz:" + where.line() + ":" + where.column() + ": ");
                assertThat(where.line()).as("seed %d: line", seed).isBetween(1, (int)
                        Math.max(1, text.lines().count()));
                assertThat(where.column()).as("seed %d: column", seed).isPositive();
            } catch (RuntimeException other) {
                fail("seed " + seed + ":\n" + text, other);
            }
        }
        assertThat(tables).as("edits that leave a table").isBetween(EDITED / 50, EDITED * 9 / 10);
    }

    private static SubsumptionTable parse(String text) {
        return SubsumptionTableReader.parse(text, Path.of("fuzz"), ServiceCatalogue.standard());
    }

    private static String edited(Random random) {
        String text = GOOD;
        for (int edits = 1 + random.nextInt(4); edits > 0; edits--) {
            int from = random.nextInt(text.length());
            int to = Math.min(text.length(), from + random.nextInt(4));
            text = switch (random.nextInt(5)) {
                case 0 -> text.substring(0, from) + text.substring(to);
                case 1 -> text.substring(0, from) + (char) (32 + random.nextInt(95)) + text.substring(to);
                case 2 -> text.substring(0, from) + PIECES.get(random.nextInt(PIECES.size())) + text.substring(from);
                case 3 -> text.substring(0, from) + text.substring(from, to).repeat(2) + text.substring(to);
                default -> linesShuffled(text, random);
            };
            if (text.isEmpty()) {
                return text;
            }
        }
        return text;
    }

    /** Removes, duplicates or moves a line. */
    private static String linesShuffled(String text, Random random) {
        var lines = new ArrayList<>(Arrays.asList(text.split("\n", -1)));
        String line = lines.remove(random.nextInt(lines.size()));
        for (int copies = random.nextInt(3); copies > 0; copies--) {
            lines.add(random.nextInt(lines.size() + 1), line);
        }
        return String.join("\n", lines);
    }
}
