package io.troupe.services.subsumption;

import static io.troupe.common.text.NamedColours.BLACK;
import static io.troupe.common.text.NamedColours.BLUE;
import static io.troupe.common.text.NamedColours.GREEN;
import static io.troupe.common.text.NamedColours.ORANGE;
import static io.troupe.common.text.NamedColours.RED;
import static io.troupe.services.behaviour.TestSenses.blob;
import static io.troupe.services.subsumption.RobotsBench.SW;
import static io.troupe.services.subsumption.RobotsBench.WF;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.tools.Thorough;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.OptionalInt;
import java.util.Random;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/**
 * Random tables: built in code, parsed from an equivalent text in one of its possible forms, and written; and edits.
 */
class RandomSubsumptionTableTest {
    private static final int TABLES = Thorough.times(200, 2_000);
    private static final List<Integer> COLOURS = List.of(BLUE, RED, GREEN, ORANGE, BLACK, 0xC8A2C8, 0x123456, 0xFFFFFF);
    private static final Service PATROL = declared("patrol = goToGoal(1, 2; again) colours");
    private static final Service DODGE = declared("dodge = avoid(near 0.3)");
    private static final List<Service> SERVICES = List.of(WF, SW, PATROL, DODGE, DODGE.over(PATROL), DODGE.over(SW));

    private final List<String> lines = new ArrayList<>();
    private Random random = new Random(0);

    private static SubsumptionTable read(String text) {
        return SubsumptionTableReader.parse(text, Path.of("random"), ServiceCatalogue.standard());
    }

    private static Service declared(String declaration) {
        return SubsumptionTableReader.service(declaration, ServiceCatalogue.standard());
    }

    /** A random table; {@link #lines} is the equivalent text. */
    private SubsumptionTable table(long seed) {
        random = new Random(seed);
        lines.clear();
        int robots = 1 + random.nextInt(9);
        int states = 1 + random.nextInt(5);
        var colours = new ArrayList<>(COLOURS);
        Collections.shuffle(colours, random);
        var builder = SubsumptionTable.forRobots(robots).allowFinal();
        lines.add("robots " + robots);
        lines.add("allow final");
        lines.add("service patrol = goToGoal( 1 , 2.0 ;again) colours");
        lines.add("service dodge=avoid( near .3 )");
        int holdMillis = random.nextInt(3) * random.nextInt(2000);
        builder.holdSeconds(holdMillis / 1000.0).service(PATROL).service(DODGE);
        lines.add("hold " + (random.nextBoolean() ? holdMillis + "ms" : holdMillis / 1000.0 + " s"));
        int ignored = colours.get(states);
        builder.ignoring(ignored, "for a reason");
        lines.add("ignore " + name(ignored) + ": for a reason");
        for (int state = 0; state < states; state++) {
            int colour = colours.get(state);
            // the first state uses every declared service, and can end
            List<Service> services = IntStream.range(0, robots)
                    .mapToObj(robot -> SERVICES.get(random.nextInt(SERVICES.size())))
                    .collect(Collectors.toCollection(ArrayList::new));
            if (state == 0) {
                services.set(random.nextInt(robots), DODGE.over(PATROL));
            }
            builder.state(colour, services);
            String priority = "";
            if (random.nextBoolean()) {
                int value = random.nextInt(7) == 0 ? Integer.MIN_VALUE : random.nextInt(-2, 3);
                builder.priority(colour, value);
                priority = " priority " + value;
            }
            lines.add("state " + name(colour) + priority + " :" + assignment(services));
        }
        return builder.build();
    }

    private String name(int colour) {
        String hex = NamedColours.hex(colour);
        return random.nextBoolean()
                ? NamedColours.name(colour)
                : random.nextBoolean() ? hex : hex.toLowerCase(Locale.ROOT);
    }

    /** The services in order, or by robot numbers in any order. */
    private String assignment(List<Service> services) {
        if (random.nextBoolean()) {
            return services.stream().map(Service::name).collect(Collectors.joining(random.nextBoolean() ? "," : " , "));
        }
        Service other = random.nextBoolean() ? services.get(random.nextInt(services.size())) : null;
        List<String> parts = new ArrayList<>(other == null ? List.of() : List.of("*=" + other));
        for (int from = 0; from < services.size(); from++) {
            int to = from;
            while (to + 1 < services.size()
                    && services.get(to + 1).equals(services.get(from))
                    && random.nextInt(3) > 0) {
                to++;
            }
            if (!services.get(from).equals(other)) {
                parts.add((from == to ? "" + (from + 1) : (from + 1) + ".." + (to + 1)) + " = " + services.get(from));
            }
            from = to;
        }
        Collections.shuffle(parts, random);
        return String.join(", ", parts);
    }

    /** The lines in random order, except the states, with comments and blank lines between them. */
    private String text() {
        var states = lines.stream().filter(line -> line.startsWith("state")).iterator();
        var others = new ArrayList<>(
                lines.stream().filter(line -> !line.startsWith("state")).toList());
        Collections.shuffle(others, random);
        var text = new StringBuilder();
        for (var other : others) {
            text.append(random.nextBoolean() ? "\n" : "").append(other).append(random.nextBoolean() ? " # so\n" : "\n");
            if (states.hasNext() && random.nextBoolean()) {
                text.append('\t').append(states.next()).append("\r\n");
            }
        }
        states.forEachRemaining(state -> text.append(state).append("   \n"));
        return text.toString();
    }

    @Test
    void text_isReadAsTheEquivalentTable() {
        for (long seed = 0; seed < TABLES; seed++) {
            SubsumptionTable built = table(seed);
            String text = text();
            assertThat(read(text))
                    .as("seed %d%n%s", seed, text)
                    .isEqualTo(built)
                    .hasSameHashCodeAs(built);
            var written = read(SubsumptionTableWriter.write(built));
            assertThat(written).as("seed %d", seed).isEqualTo(built);
        }
    }

    @Test
    void rule_picksWhatAnEyeWouldPick_andWhatTheCallbacksOfTheSameReadingLeadTo() {
        int picked = 0;
        for (long seed = 0; seed < TABLES; seed++) {
            SubsumptionTable table = table(seed);
            State state = table.states().get(random.nextInt(table.states().size()));
            List<Blob> seen = IntStream.range(0, random.nextInt(6))
                    .mapToObj(
                            left -> blob(COLOURS.get(random.nextInt(COLOURS.size())), 8 + random.nextInt(5), left * 10))
                    .collect(Collectors.toCollection(ArrayList::new));
            Collections.shuffle(seen, random);
            double seconds = random.nextInt(20) / 10.0;

            OptionalInt expected = byEye(table, state, seen, seconds);
            var picks = table.ruleIn(state).pick(seen, seconds);
            assertThat(picks).as("seed %d", seed).isEqualTo(expected);
            var called = ColourFinder.inOrder(seen, table::priority)
                    .filter(colour -> colour != BLACK || table.state(colour).isPresent())
                    .filter(colour -> table.next(state, colour, seconds).isPresent())
                    .findFirst();
            assertThat(called).as("seed %d", seed).isEqualTo(expected);
            picked += expected.isPresent() ? 1 : 0;
        }
        assertThat(picked).isBetween(TABLES / 10, TABLES * 9 / 10);
    }

    /** A model of the colour rule, as the guide describes it, blob by blob. */
    private static OptionalInt byEye(SubsumptionTable table, State state, List<Blob> seen, double seconds) {
        Blob best = null;
        for (Blob each : seen) {
            boolean other = table.states().stream().anyMatch(to -> to.colour() == each.colour())
                    && each.colour() != state.colour();
            boolean ends =
                    seconds >= table.holdSeconds() || priority(table, each.colour()) > priority(table, state.colour());
            if (other && ends && each.areaPx2() >= 10 && (best == null || isBefore(table, each, best))) {
                best = each;
            }
        }
        return best == null ? OptionalInt.empty() : OptionalInt.of(best.colour());
    }

    private static boolean isBefore(SubsumptionTable table, Blob one, Blob other) {
        int byPriority = Integer.compare(priority(table, one.colour()), priority(table, other.colour()));
        int byArea = Integer.compare(one.areaPx2(), other.areaPx2());
        return byPriority > 0 || byPriority == 0 && (byArea > 0 || byArea == 0 && one.leftPx() < other.leftPx());
    }

    private static int priority(SubsumptionTable table, int colour) {
        return table.priorities().getOrDefault(colour, 0);
    }

    // ---- written tables

    @Test
    void writtenTable_isReadAsAnEqualOne() {
        for (int seed = 0; seed < 300; seed++) {
            SubsumptionTable table = passing(new Random(seed));
            String text = SubsumptionTableWriter.write(table);
            assertThat(read(text)).as("seed %d%n%s", seed, text).isEqualTo(table);
            assertThat(SubsumptionTableWriter.write(read(text))).isEqualTo(text);
        }
    }

    /** A random table that passes the checks. */
    private static SubsumptionTable passing(Random random) {
        int robots = 1 + random.nextInt(12);
        var services = new ArrayList<>(List.of(
                SW,
                WF,
                declared("avoid = avoid" + (random.nextBoolean() ? "" : " colours")),
                declared("walker = spaceWanderer no colours"),
                declared("patrol = goToGoal(%s, -2; 0.001, 3e2; speed 0.%d; again) colours"
                        .formatted(random.nextGaussian(), 1 + random.nextInt(9)))));
        services.add(services.get(2).over(services.get(4)));
        var builder = SubsumptionTable.forRobots(robots).allowFinal();
        if (random.nextBoolean()) {
            builder.holdSeconds(random.nextInt(5) / 4.0);
        }
        var colours = random.ints(0, 0x1000000).distinct().limit(6).boxed().toList();
        builder.colour("own", colours.get(0)).colour("red", colours.get(1)).ignoring(colours.get(2), "a wall: yes");
        builder.ignoring(BLACK, "");
        for (int colour : List.of(BLUE, colours.get(0), colours.get(1), RED, colours.get(3))) {
            List<Service> inCharge = new ArrayList<>(List.of(SW));
            while (inCharge.size() < robots) {
                inCharge.add(services.get(random.nextInt(services.size())));
            }
            builder.state(colour, inCharge);
            if (random.nextInt(3) == 0) {
                builder.priority(colour, random.nextInt(7) - 3);
            }
        }
        return builder.build();
    }

    // ---- valid files after random edits

    private static final int EDITED = Thorough.times(2_000, 20_000);
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
            ("#|..|*|>|,|;|(|)|=|:|-|7|0|1e400|99999999999|\n|\r| |\t|\0|é|\uD83D|\uD83E\uDD16|#FFFFFF|state red : "
                            + "|priority|colours|no|final|ms|spaceWanderer|goToGoal|robots 3")
                    .split("\\|"));

    @Test
    void editedFile_isATable_orTheMistakeIsReportedWithItsPosition() {
        assertThat(read(GOOD).states()).hasSize(3);
        int tables = 0;
        for (int seed = 0; seed < EDITED; seed++) {
            String text = edited(new Random(seed));
            try {
                SubsumptionTable table = read(text);
                tables++;
                var written = read(SubsumptionTableWriter.write(table));
                assertThat(written).as("seed %d", seed).isEqualTo(table);
            } catch (SubsumptionTableException wrong) {
                var where = wrong.where().orElseThrow();
                String place = "random:" + where.line() + ":" + where.column() + ": ";
                assertThat(wrong).as("seed %d", seed).hasMessageStartingWith(place);
                long lines = Math.max(1, text.lines().count());
                assertThat((long) where.line()).as("seed %d: line", seed).isBetween(1L, lines);
                assertThat(where.column()).as("seed %d: column", seed).isPositive();
            } catch (RuntimeException other) {
                fail("seed " + seed + ":\n" + text, other);
            }
        }
        assertThat(tables).as("edits that leave a table").isBetween(EDITED / 50, EDITED * 9 / 10);
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
