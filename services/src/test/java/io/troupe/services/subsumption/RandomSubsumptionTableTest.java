package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.TestBlobs;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import java.util.OptionalInt;
import java.util.Random;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** Random tables: each is built in code, and parsed from an equivalent text in one of its possible forms. */
class RandomSubsumptionTableTest {
    private static final int TABLES = 2_000;
    private static final List<Integer> COLOURS = List.of(
            NamedColours.BLUE,
            NamedColours.RED,
            NamedColours.GREEN,
            NamedColours.ORANGE,
            NamedColours.BLACK,
            0xC8A2C8,
            0x123456,
            0xFFFFFF);
    private static final Service PATROL = declared("patrol = goToGoal(1, 2; again) colours");
    private static final Service DODGE = declared("dodge = avoid(near 0.3)");
    private static final List<Service> SERVICES = List.of(
            Service.WALL_FOLLOWER,
            Service.SPACE_WANDERER,
            PATROL,
            DODGE,
            DODGE.over(PATROL),
            DODGE.over(Service.SPACE_WANDERER));

    private final List<String> lines = new ArrayList<>();
    private Random random = new Random(0);

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
        builder.hold(holdMillis / 1000.0).service(PATROL).service(DODGE);
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
            builder.when(colour, services);
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
        List<String> parts = new ArrayList<>();
        if (other != null) {
            parts.add("*=" + other);
        }
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
            assertThat(SubsumptionTableReader.parse(text, Path.of("seed " + seed), ServiceCatalogue.standard()))
                    .as(text)
                    .isEqualTo(built)
                    .hasSameHashCodeAs(built);
            assertThat(SubsumptionTableReader.parse(
                            SubsumptionTableWriter.write(built),
                            Path.of("written " + seed),
                            ServiceCatalogue.standard()))
                    .isEqualTo(built);
        }
    }

    @Test
    void rule_picksWhatAnEyeWouldPick_andWhatTheCallbacksOfTheSameReadingLeadTo() {
        int picked = 0;
        for (long seed = 0; seed < TABLES; seed++) {
            SubsumptionTable table = table(seed);
            State state = table.states().get(random.nextInt(table.states().size()));
            List<Blob> seen = IntStream.range(0, random.nextInt(6))
                    .mapToObj(left ->
                            TestBlobs.of(COLOURS.get(random.nextInt(COLOURS.size())), 8 + random.nextInt(5), left * 10))
                    .collect(Collectors.toCollection(ArrayList::new));
            Collections.shuffle(seen, random);
            double seconds = random.nextInt(20) / 10.0;

            OptionalInt expected = byEye(table, state, seen, seconds);
            assertThat(table.ruleIn(state).pick(seen, seconds))
                    .as("seed %d", seed)
                    .isEqualTo(expected);
            assertThat(ColourFinder.inOrder(seen, table::priority)
                            .filter(colour -> colour != NamedColours.BLACK
                                    || table.state(colour).isPresent())
                            .filter(colour -> table.next(state, colour, seconds).isPresent())
                            .findFirst())
                    .as("seed %d", seed)
                    .isEqualTo(expected);
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
            int priority = table.priorities().getOrDefault(each.colour(), 0);
            int own = table.priorities().getOrDefault(state.colour(), 0);
            boolean ends = seconds >= table.holdSeconds() || priority > own;
            if (other && ends && each.areaPx2() >= 10 && (best == null || isBefore(table, each, best))) {
                best = each;
            }
        }
        return best == null ? OptionalInt.empty() : OptionalInt.of(best.colour());
    }

    private static boolean isBefore(SubsumptionTable table, Blob one, Blob other) {
        int priority = table.priorities().getOrDefault(one.colour(), 0);
        int otherPriority = table.priorities().getOrDefault(other.colour(), 0);
        if (priority != otherPriority) {
            return priority > otherPriority;
        }
        return one.areaPx2() == other.areaPx2() ? one.leftPx() < other.leftPx() : one.areaPx2() > other.areaPx2();
    }
}
