package io.troupe.sim.device;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.TestWorlds;
import io.troupe.sim.model.Pose;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.Test;

class NearestWallsTest {
    private static Outline box(SplittableRandom random, double spreadM, double largestM) {
        return new Outline(
                TestWorlds.box(random.nextDouble(0.05, largestM), random.nextDouble(0.05, largestM)),
                new Pose(
                        random.nextDouble(-spreadM, spreadM),
                        random.nextDouble(-spreadM, spreadM),
                        random.nextDouble(-4, 4)));
    }

    /** Compares with a search over all walls, bit for bit, inside and outside of the walls' extent. */
    @Test
    void gap_isThatOfTheNearestOfAll() {
        for (long seed = 0; seed < 300; seed++) {
            var random = new SplittableRandom(seed);
            double spreadM = random.nextDouble(0.5, 60);
            List<Outline> walls = new ArrayList<>();
            for (int i = random.nextInt(1, 40); i > 0; i--) {
                walls.add(box(random, spreadM, random.nextInt(4) == 0 ? 30 : 2));
            }
            var nearest = new NearestWalls(walls);
            for (int i = 0; i < 50; i++) {
                Outline body = box(random, 1.5 * spreadM, 3);
                double expected = walls.stream().mapToDouble(body::gapM).min().orElseThrow();
                assertThat(nearest.gapM(body)).as("seed %d, body %d", seed, i).isEqualTo(expected);
            }
        }
    }

    @Test
    void gap_withoutWalls_isInfinite() {
        assertThat(new NearestWalls(List.of()).gapM(box(new SplittableRandom(1), 1, 1)))
                .isInfinite();
    }
}
