package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.common.text.NamedColours;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.Test;

class SubsumptionTableWriterTest {
    private static SubsumptionTable read(String text) {
        return SubsumptionTableReader.parse(text, Path.of("written"), ServiceCatalogue.standard());
    }

    @Test
    void tableOfThePaper_isWrittenPlainly() {
        assertThat(SubsumptionTableWriter.write(SubsumptionTable.ofThePaper())).isEqualTo("""
                robots 2
                ignore black : walls and robot 2
                ignore orange : robot 1
                state blue : wallFollower, spaceWanderer
                state red : spaceWanderer, wallFollower
                state green : spaceWanderer, spaceWanderer
                """);
    }

    @Test
    void manyRobots_areWrittenInRanges() {
        var table = SubsumptionTable.forRobots(50)
                .when(
                        0xFFFF00,
                        Assignment.everyRobot(Service.SPACE_WANDERER)
                                .robots(3, 5, Service.WALL_FOLLOWER)
                                .robot(50, Service.WALL_FOLLOWER))
                .build();
        assertThat(SubsumptionTableWriter.write(table))
                .isEqualTo("robots 50\nstate yellow : * = spaceWanderer, 3..5 = wallFollower, 50 = wallFollower\n");
    }

    @Test
    void writtenTable_isReadAsAnEqualOne() {
        for (int seed = 0; seed < 300; seed++) {
            SubsumptionTable table = table(new Random(seed));
            String text = SubsumptionTableWriter.write(table);
            assertThat(read(text)).as("seed %d%n%s", seed, text).isEqualTo(table);
            assertThat(SubsumptionTableWriter.write(read(text))).isEqualTo(text);
        }
    }

    @Test
    void serviceOfBareCode_cannotBeWritten() {
        var own = new Service("own", true, () -> senses -> java.util.Optional.empty());
        var table = SubsumptionTable.forRobots(1).when(NamedColours.RED, own).build();
        assertThatThrownBy(() -> SubsumptionTableWriter.write(table))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("the service own cannot be written");
    }

    /** A random table that passes the checks. */
    private static SubsumptionTable table(Random random) {
        int robots = 1 + random.nextInt(12);
        var services = new ArrayList<>(List.of(
                Service.SPACE_WANDERER,
                Service.WALL_FOLLOWER,
                service("avoid = avoid" + (random.nextBoolean() ? "" : " colours")),
                service("walker = spaceWanderer no colours"),
                service("patrol = goToGoal(%s, -2; 0.001, 3e2; speed 0.%d; again) colours"
                        .formatted(random.nextGaussian(), 1 + random.nextInt(9)))));
        services.add(services.get(2).over(services.get(4)));
        var builder = SubsumptionTable.forRobots(robots).allowFinal();
        if (random.nextBoolean()) {
            builder.hold(random.nextInt(5) / 4.0);
        }
        var colours = random.ints(0, 0x1000000).distinct().limit(6).boxed().toList();
        builder.colour("own", colours.get(0)).colour("red", colours.get(1)).ignoring(colours.get(2), "a wall: yes");
        builder.ignoring(NamedColours.BLACK, "");
        for (int colour :
                List.of(NamedColours.BLUE, colours.get(0), colours.get(1), NamedColours.RED, colours.get(3))) {
            List<Service> inCharge = new ArrayList<>(List.of(Service.SPACE_WANDERER));
            while (inCharge.size() < robots) {
                inCharge.add(services.get(random.nextInt(services.size())));
            }
            builder.when(colour, inCharge);
            if (random.nextInt(3) == 0) {
                builder.priority(colour, random.nextInt(7) - 3);
            }
        }
        return builder.build();
    }

    private static Service service(String declaration) {
        return SubsumptionTableReader.service(declaration, ServiceCatalogue.standard());
    }
}
