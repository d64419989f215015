package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

class WorldContractTest {
    private final World world = World.create(
            Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(0, 3, 0)))), WorldSettings.DEFAULT);

    private static void assertRefused(WorldSpec spec, String... parts) {
        assertThatThrownBy(() -> World.create(spec, WorldSettings.DEFAULT))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContainingAll(parts);
    }

    private static ObstacleSpec obstacle(Pose pose, Point... polygon) {
        return new ObstacleSpec(
                "thing", pose, new Shape(List.of(List.of(polygon))), Specs.BLACK, true, true, true, Specs.at(12));
    }

    @Test
    void command_thatIsNotFinite_isRefused_namingTheRobot() {
        assertThatThrownBy(() -> world.command(1, Double.NaN, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("robot 'r2' was told to drive at NaN m/s and 0.0 rad/s, expected finite numbers");
        assertThatThrownBy(() -> world.command(0, 0, Double.NEGATIVE_INFINITY)).hasMessageContaining("robot 'r1'");
        assertThatThrownBy(() -> world.setOdometry(1, new Pose(0, Double.NaN, 0)))
                .hasMessageContaining("robot 'r2'");

        assertThat(world.advance().robots().get(1).pose()).isEqualTo(new Pose(0, 3, 0));
    }

    @Test
    void odometry_soFarAwayThatSumsBecomeInfinite_isRefused_namingTheRobot() {
        for (Pose far : List.of(new Pose(1.7e308, 0, 0), new Pose(0, -1.1e9, 0), new Pose(0, 0, 1e10))) {
            assertThatThrownBy(() -> world.setOdometry(1, far))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessage(
                            "odometry of robot 'r2' was set to " + far + ", expected finite numbers of at most 1.0E9");
        }
        world.setOdometry(1, new Pose(1e9, -1e9, 1e9));
        world.command(1, 1, 0.3);

        Pose odometry = world.advance(20).robots().get(1).odometry().pose();

        assertThat(odometry.x()).isCloseTo(1e9, within(2.1));
        assertThat(odometry.y()).isCloseTo(-1e9, within(2.1));
        assertThat(odometry.headingRad()).isBetween(-StrictMath.PI, StrictMath.PI);
    }

    @Test
    void odometryAtTheStart_thatIsTooFarAway_isRefused() {
        RobotSpec r = robot("r1", Pose.ORIGIN);
        var far = new RobotSpec(
                r.name(),
                r.pose(),
                r.shape(),
                r.colour(),
                r.lengthM(),
                r.widthM(),
                r.massKg(),
                r.origin(),
                new Pose(0, 1.7e308, 0),
                r.sonar(),
                r.blobfinder(),
                r.rangers(),
                true,
                true,
                r.where());
        assertRefused(Specs.world(far), "test.world:7:1: robot 'r1' starts with the odometry", "at most 1.0E9");
    }

    @Test
    void controllerThatAdvancesItsOwnWorld_isRefused_andTheWorldGoesOn() {
        assertThatThrownBy(() -> world.advance(3, view -> world.advance()))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("world 'test' is advancing already: a controller commands robots, and must not call"
                        + " advance()");
        assertThat(world.latest().tick()).isZero();

        assertThat(world.advance(3, view -> view.command(0, 0.1, 0)).tick()).isEqualTo(3);
    }

    @Test
    void command_toARobotThatIsNotThere_isRefused() {
        assertThatThrownBy(() -> world.command(2, 0, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("there is no robot 2, world 'test' has 2, counted from 0");
        assertThatThrownBy(() -> world.stop(-1)).hasMessageContaining("there is no robot -1");
    }

    @Test
    void command_beyondTheLimits_isClampedToThem() {
        World limited = World.create(world.spec(), WorldSettings.DEFAULT.withLimits(0.5, 1));
        limited.command(0, 99, -99);
        limited.command(1, -99, 99);

        Snapshot snapshot = limited.advance();

        assertThat(snapshot.robots().get(0).odometry().forwardMps()).isEqualTo(0.5);
        assertThat(snapshot.robots().get(0).odometry().turnRadps()).isEqualTo(-1);
        assertThat(snapshot.robots().get(1).odometry().forwardMps()).isEqualTo(-0.5);
        assertThat(snapshot.robots().get(0).pose().headingRad()).isCloseTo(-0.1, within(1e-12));
    }

    @Test
    @Timeout(60)
    void command_fromAnotherThread_takesEffectAtTheNextInterval() throws Exception {
        CompletableFuture.runAsync(() -> world.command(0, 0.5, 0)).get(30, TimeUnit.SECONDS);

        assertThat(world.latest().robots().getFirst().odometry().forwardMps()).isZero();
        assertThat(world.advance().robots().getFirst().pose().x()).isCloseTo(0.05, within(1e-12));
    }

    @Test
    @Timeout(60)
    void advance_fromASecondThread_isRefused() {
        Snapshot first = world.advance();

        assertThatThrownBy(() -> CompletableFuture.runAsync(world::advance).get(30, TimeUnit.SECONDS))
                .isInstanceOf(ExecutionException.class)
                .cause()
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining(
                        "advance() belongs to thread '" + Thread.currentThread().getName() + "'");
        assertThat(world.latest()).isSameAs(first);
        assertThat(world.advance().tick()).isEqualTo(2);
    }

    @Test
    void interval_thatIsNoMultipleOfThePhysicsStep_isRefused() {
        assertThatThrownBy(() -> World.create(world.spec(), WorldSettings.DEFAULT.withPhysicsStepMicros(15_000)))
                .isInstanceOf(WorldFileException.class)
                .hasMessage(
                        "test.world: the interval of world 'test' is 100000 us, expected a whole multiple of the physics step of"
                                + " 15000 us");
        assertThatThrownBy(() -> World.create(
                        new WorldSpec("still", Path.of("a.world"), 0, List.of(), List.of()), WorldSettings.DEFAULT))
                .hasMessageContaining("is 0 us");
    }

    @Test
    void stepTooLongForTheLimits_isRefused() {
        assertThatThrownBy(() -> World.create(
                        world.spec(),
                        WorldSettings.DEFAULT.withPhysicsStepMicros(100_000).withLimits(30, 1)))
                .hasMessageContaining("a physics step of 100000 us is too long for 30.0 m/s");
    }

    @Test
    void otherIntervals_countTheirOwnTime() {
        var spec = new WorldSpec("slow", Path.of("a.world"), 250, List.of(robot("r1", Pose.ORIGIN)), List.of());
        World slow = World.create(spec, WorldSettings.DEFAULT);
        slow.command(0, 1, 0);

        slow.advance();
        Snapshot second = slow.advance();

        assertThat(second.timeMicros()).isEqualTo(500_000);
        assertThat(second.robots().getFirst().pose().x()).isCloseTo(0.5, within(1e-12));
    }

    @Test
    void polygonThatPhysicsWouldTakeForAnother_isRefused() {
        Point[] clockwise = {new Point(5, 5), new Point(5, 6), new Point(6, 6)};
        Point[] dart = {new Point(5, 5), new Point(6, 5), new Point(5.2, 5.2), new Point(5, 6)};
        Point[] nonagon = new Point[9];
        Arrays.setAll(nonagon, i -> new Point(StrictMath.cos(i * 0.69), StrictMath.sin(i * 0.69)));

        assertRefused(
                Specs.world(List.of(), obstacle(Pose.ORIGIN, clockwise)), "test.world:12:1", "'thing'", "not convex");
        assertRefused(Specs.world(List.of(), obstacle(Pose.ORIGIN, dart)), "not convex and counter-clockwise");
        assertRefused(Specs.world(List.of(), obstacle(Pose.ORIGIN, nonagon)), "9 vertices, expected 3 to 8");
        assertRefused(Specs.world(List.of(), obstacle(Pose.ORIGIN, new Point(0, 0), new Point(1, 0))), "2 vertices");
    }

    @Test
    void bodyTooFarOut_orNotANumber_isRefused() {
        assertRefused(
                Specs.world(List.of(), wall("remote", 5600, 0, 1, 1)), "obstacle 'remote' reaches to (5599.5, -0.5)");
        assertRefused(Specs.world(robot("far", new Pose(600, 0, 0))), "expected at most 500.0 m");
        assertRefused(Specs.world(robot("lost", new Pose(Double.NaN, 0, 0))), "robot 'lost' reaches to (NaN");
        assertRefused(Specs.world(robot("lost", new Pose(0, 0, Double.NaN))), "robot 'lost' has the heading NaN");
    }

    @Test
    void robotWithoutMassOrWithABadDevice_isRefused() {
        RobotSpec r = robot("r1", Pose.ORIGIN);
        assertRefused(
                Specs.world(new RobotSpec(
                        "light",
                        r.pose(),
                        r.shape(),
                        0,
                        1,
                        1,
                        0,
                        Pose.ORIGIN,
                        Pose.ORIGIN,
                        null,
                        null,
                        List.of(),
                        true,
                        true,
                        r.where())),
                "test.world:7:1: robot 'light' has a mass of 0.0");
        assertRefused(
                Specs.world(robot("deaf", Pose.ORIGIN, 0, new SonarSpec(List.of(), 3, 2, 1), null)),
                "test.world:7:1: robot 'deaf': sonar range is [3.0 2.0]");
    }

    @Test
    void worldWithoutRobots_stillKeepsTime() {
        World empty = World.create(Specs.world(List.of(), wall("wall", 0, 0, 1, 1)), WorldSettings.DEFAULT);

        assertThat(empty.advance()).isEqualTo(new Snapshot(1, 100_000, List.of(), List.of()));
    }
}
