package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.DeviceReading;
import io.troupe.sim.device.DeviceReading.Fiducial;
import java.util.ArrayList;
import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** What a finder of markers sees, worked out by hand. */
class FiducialFinderTest {
    private static final double DEGREE = StrictMath.PI / 180;

    private static final String FINDER =
            "position ( name \"r\" size [ 0.4 0.4 0.2 ] fiducial_return 9 fiducial ( pose [ 0.1 0 0 0 ] range_max 5"
                    + " range_max_id 3 fov 90 ) )\n";

    private static List<Fiducial> seen(World world, int robot) {
        RobotReading reading = world.latest().robots().get(robot);
        return ((DeviceReading.Fiducials) reading.devices().getFirst()).seen();
    }

    private static List<Fiducial> seen(String models) {
        return seen(Specs.start(FINDER + models), 0);
    }

    private static String marker(String pose, String more) {
        return "model ( pose [ " + pose + " ] size [ 0.2 0.2 0.5 ] " + more + " )\n";
    }

    private static void assertSees(List<Fiducial> seen, int id, double x, double y, double headingDeg) {
        assertThat(seen).singleElement().satisfies(marker -> {
            assertThat(marker.id()).isEqualTo(id);
            assertThat(marker.x()).isCloseTo(x, within(1e-12));
            assertThat(marker.y()).isCloseTo(y, within(1e-12));
            assertThat(marker.headingRad()).isCloseTo(headingDeg * DEGREE, within(1e-12));
        });
    }

    @Test
    void marker_ahead_isSeenWhereItIsRelativeToTheFinder() {
        assertSees(seen(marker("2.1 1 0 30", "fiducial_return 7")), 7, 2, 1, 30);
    }

    @Test
    void marker_seenByARobotThatIsTurned_isInTheFramesOfRobotAndFinder() {
        var world = Specs.start("""
                position ( pose [ 1 1 0 90 ] size [ 0.4 0.4 0.2 ] fiducial ( pose [ 0 0.1 0 -90 ] ) )
                model ( pose [ 3 1.5 0 -170 ] size [ 0.2 0.2 0.5 ] fiducial_return 3 )
                """);
        // the finder is at (0.9, 1) and looks along x; 190 degrees are 170 the other way
        assertSees(seen(world, 0), 3, 2.1, 0.5, -170);
    }

    @Test
    void marker_fartherThanItsNumberCanBeRead_isSeenWithNumberZero() {
        assertSees(seen(marker("4.1 0 0 0", "fiducial_return 7")), 0, 4, 0, 0);
    }

    @Test
    void marker_outOfRangeOrViewOrWithAnotherKeyOrWithoutNumber_isNotSeen() {
        assertThat(seen(marker("5.2 0 0 0", "fiducial_return 7")
                        + marker("1.1 1.05 0 0", "fiducial_return 7")
                        + marker("-2 0 0 0", "fiducial_return 7")
                        + marker("2.1 0.7 0 0", "fiducial_return 7 fiducial_key 2")
                        + marker("2.1 -0.7 0 0", "")))
                .isEmpty();
        assertThat(seen(marker("1.1 0.95 0 0", "fiducial_return 7"))).hasSize(1);
    }

    @Test
    void marker_behindSomething_isNotSeen() {
        String hidden = marker("3.1 0 0 0", "fiducial_return 7");
        assertThat(seen(hidden + marker("2 0 0 0", ""))).isEmpty();
        assertThat(seen(hidden + marker("2 0.05 0 0", "blob_return 0 obstacle_return 0")))
                .isEmpty();
        assertThat(seen(hidden + marker("2 0.2 0 0", ""))).hasSize(1);
        assertThat(seen(hidden + marker("2 0 0 0", "blob_return 0 ranger_return 0")))
                .as("neither rangers nor cameras notice it")
                .hasSize(1);
    }

    @Test
    void markers_ofObstaclesAndRobots_comeInTheOrderOfTheFileAndNeverTheOwn() {
        String robot =
                "position ( name \"other\" pose [ 1.1 0 0 180 ] size [ 0.2 0.2 0.2 ] fiducial_return 4 ranger () )\n";
        List<Fiducial> seen =
                seen(robot + marker("2.1 1 0 0", "fiducial_return 5") + marker("2.1 -1 0 0", "fiducial_return 6"));
        assertThat(seen).extracting(Fiducial::id).containsExactly(5, 6, 4);
    }

    @Test
    void markerOfARobotWithCargoBeforeIt_isSeen() {
        String robot = "position ( name \"other\" pose [ 2.1 0 0 180 ] size [ 0.2 0.2 0.2 ] fiducial_return 4"
                + " model ( pose [ 0.3 0 0 0 ] size [ 0.1 0.4 0.4 ] ) )\n";
        String plain = "position ( name \"plain\" pose [ 0 4 0 0 ] size [ 0.2 0.2 0.2 ] )\n";
        assertSees(seen(plain + robot), 4, 2, 0, 180);
    }

    @Test
    void robots_thatDriveAround_areSeenAsAComparisonOfAllPairsShows() {
        long seed = 20;
        var random = new SplittableRandom(seed);
        var text = new StringBuilder();
        for (int i = 0; i < 12; i++) {
            text.append("position ( name \"r" + i + "\" pose [ " + (i % 4) * 2 + " " + (i / 4) * 2
                    + " 0 0 ] size [ 0.3 0.3 0.2 ] ranger_return 0 blob_return 0 fiducial_return " + (i + 1)
                    + " fiducial ( range_max 3 range_max_id 3 fov 120 ) )\n");
        }
        var world = Specs.start(text.toString());
        for (int tick = 0; tick < 100; tick++) {
            for (int i = 0; i < 12; i++) {
                world.command(i, random.nextDouble(0, 0.5), random.nextDouble(-1, 1));
            }
            Snapshot now = world.advance();
            for (int i = 0; i < 12; i++) {
                assertThat(seen(world, i))
                        .as("seed %s, tick %s, robot %s", seed, tick, i)
                        .extracting(Fiducial::id)
                        .isEqualTo(inView(now, i));
            }
        }
    }

    private static List<Integer> inView(Snapshot now, int robot) {
        var from = now.robots().get(robot).pose();
        List<Integer> ids = new ArrayList<>();
        IntStream.range(0, now.robots().size()).filter(other -> other != robot).forEach(other -> {
            var to = now.robots().get(other).pose();
            double dx = to.x() - from.x();
            double dy = to.y() - from.y();
            double bearing = StrictMath.IEEEremainder(StrictMath.atan2(dy, dx) - from.headingRad(), 2 * Math.PI);
            if (StrictMath.hypot(dx, dy) < 3 && Math.abs(bearing) <= 60 * DEGREE) {
                ids.add(other + 1);
            }
        });
        return ids;
    }
}
