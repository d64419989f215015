package io.troupe.sim;

import static io.troupe.sim.Specs.R1;
import static io.troupe.sim.Specs.driven;
import static io.troupe.sim.Specs.first;
import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.run;
import static io.troupe.sim.Specs.start;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.Odometry;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Point;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.Shape;
import io.troupe.sim.model.SonarSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.worldfile.WorldFileException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.parallel.Isolated;

/** Commands and intervals of a world, the view that controllers get, and what is refused. */
@Isolated("reads the log")
class WorldTest {
    private static final RobotSpec R2 = robot("r2", 0, 3, 0);

    private final World world = start(List.of(R1, R2));

    @Test
    void command_thatIsNotFinite_orToARobotThatIsNotThere_isRefused() {
        assertThatThrownBy(() -> world.command(1, Double.NaN, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("robot 'r2' was commanded to drive at NaN m/s and 0.0 rad/s, expected finite numbers");
        assertThatThrownBy(() -> world.command(0, 0, Double.NEGATIVE_INFINITY)).hasMessageContaining("robot 'r1'");
        assertThatThrownBy(() -> world.setOdometry(1, new Pose(0, Double.NaN, 0)))
                .hasMessageContaining("robot 'r2'");
        assertThat(world.advance().robots().get(1).pose()).isEqualTo(new Pose(0, 3, 0));
        assertThatThrownBy(() -> world.command(2, 0, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("there is no robot 2, world 'test' has 2, counted from 0");
        assertThatThrownBy(() -> world.stop(-1)).hasMessageContaining("there is no robot -1");
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
    void command_beyondTheLimits_isClampedToThem() {
        World limited = World.create(world.spec(), WorldSettings.defaults().withLimits(0.5, 1));
        limited.command(0, 99, -99);
        limited.command(1, -99, 99);
        Snapshot snapshot = limited.advance();
        assertThat(first(snapshot).odometry().forwardMps()).isEqualTo(0.5);
        assertThat(first(snapshot).odometry().turnRadps()).isEqualTo(-1);
        assertThat(snapshot.robots().get(1).odometry().forwardMps()).isEqualTo(-0.5);
        assertThat(first(snapshot).pose().headingRad()).isCloseTo(-0.1, within(1e-12));
    }

    @Test
    @Timeout(60)
    void secondThread_mayCommand_butNotAdvance() throws Exception {
        CompletableFuture.runAsync(() -> world.command(0, 0.5, 0)).get(30, TimeUnit.SECONDS);
        assertThat(first(world.latest()).odometry().forwardMps()).isZero();
        assertThat(run(world, 1).pose().x()).isCloseTo(0.05, within(1e-12));
        Snapshot first = world.advance();
        assertThatThrownBy(() -> CompletableFuture.runAsync(world::advance).get(30, TimeUnit.SECONDS))
                .isInstanceOf(ExecutionException.class)
                .cause()
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining(
                        "advance() belongs to thread '" + Thread.currentThread().getName() + "'");
        assertThat(world.latest()).isSameAs(first);
        assertThat(world.advance().tick()).isEqualTo(3);
    }

    // ---- many intervals in one call, and the view

    private static World crowd() {
        return World.create(Arena.crowd(20, 5, Specs.RED, Specs.ORANGE), WorldSettings.defaults());
    }

    @Test
    void intervals_inOneCall_endWhereSingleOnesDo_andKeepTheLastCommand() {
        World single = crowd();
        World many = crowd();
        for (int tick = 0; tick < 200; tick++) {
            Arena.wander(single.view());
            single.advance();
        }
        assertThat(many.advance(150, Arena::wander).tick()).isEqualTo(150);
        Snapshot end = many.advance(50, Arena::wander);
        assertThat(end).isEqualTo(single.latest()).isSameAs(many.latest());
        assertThat(many.timeMicros()).isEqualTo(20_000_000);
        world.command(0, 0.5, 0);
        assertThat(first(world.advance(20)).pose().x()).isCloseTo(1, within(1e-12));
    }

    @Test
    void view_showsAtEveryTick_whatASnapshotTells() {
        World crowd = crowd();
        var contacts = new ArrayList<Contact>();
        crowd.advance(300, view -> {
            Snapshot snapshot = view.snapshot();
            assertThat(view.tick()).isEqualTo(snapshot.tick());
            assertThat(view.timeMicros()).isEqualTo(snapshot.timeMicros());
            assertThat(IntStream.range(0, view.contactCount()).mapToObj(i -> contact(view, i, crowd.spec())))
                    .isEqualTo(snapshot.contacts());
            contacts.addAll(snapshot.contacts());
            for (int robot = 0; robot < view.robotCount(); robot++) {
                assertShows(view, robot, snapshot.robots().get(robot));
            }
            Arena.wander(view);
        });
        assertThat(contacts).isNotEmpty();
    }

    private static Contact contact(WorldView view, int i, WorldSpec spec) {
        int obstacle = view.contactObstacle(i);
        String other = obstacle >= 0
                ? spec.obstacles().get(obstacle).name()
                : spec.robots().get(view.contactOtherRobot(i)).name();
        return new Contact(view.contactTimeMicros(i), view.contactRobot(i), other, view.contactOtherRobot(i));
    }

    private static void assertShows(WorldView view, int robot, RobotReading reading) {
        assertThat(new Pose(view.x(robot), view.y(robot), view.headingRad(robot)))
                .isEqualTo(reading.pose());
        var odometry = new Pose(view.odometryX(robot), view.odometryY(robot), view.odometryHeadingRad(robot));
        assertThat(new Odometry(odometry, view.forwardMps(robot), view.turnRadps(robot), view.stalled(robot)))
                .isEqualTo(reading.odometry());
        assertThat(view.wallGapM(robot)).isEqualTo(reading.wallGapM());
        assertThat(IntStream.range(0, view.sonarCount(robot)).mapToObj(i -> view.rangeM(robot, i)))
                .isEqualTo(reading.sonarM());
        assertThat(IntStream.range(0, view.blobCount(robot))
                        .mapToObj(i -> tuple(
                                view.blobColour(robot, i),
                                view.blobLeft(robot, i),
                                view.blobRight(robot, i),
                                view.blobTop(robot, i),
                                view.blobBottom(robot, i),
                                view.blobRangeM(robot, i))))
                .isEqualTo(reading.blobs().blobs().stream()
                        .map(blob -> tuple(
                                blob.colour(), blob.left(), blob.right(), blob.top(), blob.bottom(), blob.rangeM()))
                        .toList());
    }

    @Test
    void latest_duringALongAdvance_isMadeWhenSomebodyAsks() {
        World crowd = crowd();
        List<Long> seen = new ArrayList<>();
        crowd.latest();
        crowd.advance(6, view -> {
            if (view.tick() % 2 == 0) {
                seen.add(crowd.latest().tick()); // requests the next snapshot
            }
        });
        // tick 0 exists; a request at tick 0 publishes tick 1, and so on
        assertThat(seen).containsExactly(0L, 1L, 3L);
        assertThat(crowd.latest().tick()).isEqualTo(6);
    }

    @Test
    void viewCommand_replacesWhatOthersSaidBefore_andIsReplacedByWhatTheySayAfter() {
        WorldView view = world.view();
        world.command(0, 0.1, 0);
        view.command(0, 0.2, 0);
        assertThat(run(world, 1).odometry().forwardMps()).isEqualTo(0.2);
        view.command(0, 99, -99);
        assertThat(view.forwardMps(0)).as("still what was in force").isEqualTo(0.2);
        assertThat(run(world, 1).odometry().turnRadps()).isEqualTo(-10);
        view.command(0, 0.3, 0);
        world.command(0, 0.4, 0);
        assertThat(run(world, 1).odometry().forwardMps()).isEqualTo(0.4);
        assertThatThrownBy(() -> view.command(0, Double.NaN, 0)).hasMessageContaining("robot 'r1'");
    }

    @Test
    void controllerThatThrowsOrAdvances_endsTheAdvance_andTheTickBeforeIsPublished() {
        assertThatThrownBy(() -> world.advance(3, view -> world.advance()))
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("world 'test' is advancing already: a controller commands robots, and must not call"
                        + " advance()");
        assertThat(world.latest().tick()).isZero();
        assertThat(world.advance(3, view -> view.command(0, 0.1, 0)).tick()).isEqualTo(3);

        World crowd = crowd();
        assertThatThrownBy(() -> crowd.advance(10, view -> {
                    if (view.tick() == 4) {
                        throw new IllegalStateException("enough");
                    }
                }))
                .hasMessage("enough");
        assertThat(crowd.latest().tick()).isEqualTo(4);
        assertThat(crowd.advance().tick()).isEqualTo(5);
    }

    @Test
    void contacts_areThoseOfTheLastInterval_andWhatIsNotThereIsRefused() {
        World walled = driven(0.5, start(R1, wall("wall", 0.8, 0, 1, 4)));
        assertThat(walled.advance(20).contacts()).isEmpty();
        assertThat(walled.view().contactCount()).isZero();
        WorldView view = world.view();
        assertThat(view.sonarCount(0)).isZero();
        assertThat(view.blobCount(0)).isZero();
        assertThatThrownBy(() -> view.rangeM(0, 0)).isInstanceOf(IndexOutOfBoundsException.class);
        assertThatThrownBy(() -> view.blobColour(0, 0)).hasMessage("there is no blob 0, robot 0 sees 0");
        assertThatThrownBy(() -> view.contactRobot(0)).isInstanceOf(IndexOutOfBoundsException.class);
        assertThatThrownBy(() -> world.advance(0)).hasMessageContaining("cannot advance by 0 intervals");
    }

    @Test
    void sonarsOfStage4_areTheRangerWithOneRayForEachSensor_andAllRangersCanBeRead() {
        WorldView view = start("""
                model ( pose [ 3 0 0 0 ] size [ 2 8 ] )
                position ( name "r"
                  ranger ( sensor ( range [ 0 8 ] fov 90 samples 3 ) )
                  ranger ( sensor ( pose [ 0 0 0 0 ] range [ 0 5 ] ) sensor ( pose [ 0 0 0 180 ] range [ 0 4 ] ) ) )
                position ( name "scanner" pose [ 0 3 0 0 ] ranger ( sensor ( samples 90 ) ) )
                """).view();
        assertThat(view.sonarCount(0)).isEqualTo(2);
        assertThat(view.rangeM(0, 0)).isEqualTo(2);
        assertThat(view.rangeM(0, 1)).as("sees nothing").isEqualTo(4);
        assertThatThrownBy(() -> view.rangeM(0, 2)).isInstanceOf(IndexOutOfBoundsException.class);
        assertThat(view.sonarCount(1)).as("a laser is no ring of sonars").isZero();
        assertThat(view.rangerCount(0)).isEqualTo(2);
        assertThat(view.rangeCount(0, 0)).isEqualTo(3);
        assertThat(view.rangeM(0, 0, 1)).isEqualTo(2);
        assertThat(view.rangeCount(1, 0)).isEqualTo(90);
        assertThatThrownBy(() -> view.rangeM(1, 1, 0)).isInstanceOf(IndexOutOfBoundsException.class);
    }

    @Test
    void interval_thatIsNoMultipleOfThePhysicsStep_orLongerThanTheLimitsAllow_isRefused() {
        WorldSettings settings = WorldSettings.defaults();
        assertThatThrownBy(() -> World.create(world.spec(), settings.withPhysicsStepMicros(15_000)))
                .isInstanceOf(WorldFileException.class)
                .hasMessage(
                        "test.world: the interval of world 'test' is 100000 us, expected a whole multiple of the physics step of"
                                + " 15000 us");
        var still = new WorldSpec("still", Path.of("a.world"), 0, List.of(), List.of());
        assertThatThrownBy(() -> World.create(still, settings)).hasMessageContaining("is 0 us");
        WorldSettings slow = settings.withPhysicsStepMicros(100_000).withLimits(30, 1);
        assertThatThrownBy(() -> World.create(world.spec(), slow))
                .hasMessageContaining("a physics step of 100000 us is too long for 30.0 m/s");
    }

    @Test
    void time_isCountedByTheWorldsOwnInterval_andWithoutRobots() {
        World slow = driven(
                1,
                World.create(
                        new WorldSpec("slow", Path.of("a.world"), 250, List.of(R1), List.of()),
                        WorldSettings.defaults()));
        assertThat(run(slow, 2).pose().x()).isCloseTo(0.5, within(1e-12));
        assertThat(slow.latest().timeMicros()).isEqualTo(500_000);
        assertThat(start(List.of(), wall("wall", 0, 0, 1, 1)).advance())
                .isEqualTo(new Snapshot(1, 100_000, List.of(), List.of()));
    }

    private static void assertRefused(WorldSpec spec, String... parts) {
        assertThatThrownBy(() -> World.create(spec, WorldSettings.defaults()))
                .isInstanceOf(WorldFileException.class)
                .hasMessageContainingAll(parts);
    }

    private static void assertPolygonIsRefused(List<Point> polygon, String... parts) {
        var shape = new Shape(List.of(polygon));
        var thing = new ObstacleSpec("thing", Pose.ORIGIN, shape, Specs.BLACK, true, true, true, Specs.at(12));
        assertRefused(Specs.world(List.of(), thing), parts);
    }

    @Test
    void specification_thatMakesNoSense_isRefused() {
        assertPolygonIsRefused(
                List.of(new Point(5, 5), new Point(5, 6), new Point(6, 6)), "test.world:12:1", "'thing'", "not convex");
        assertPolygonIsRefused(
                List.of(new Point(5, 5), new Point(6, 5), new Point(5.2, 5.2), new Point(5, 6)),
                "not convex and counter-clockwise");
        assertPolygonIsRefused(
                IntStream.range(0, 9)
                        .mapToObj(i -> new Point(StrictMath.cos(i * 0.69), StrictMath.sin(i * 0.69)))
                        .toList(),
                "9 vertices, expected 3 to 8");
        assertPolygonIsRefused(List.of(new Point(0, 0), new Point(1, 0)), "2 vertices");
        assertRefused(
                Specs.world(List.of(), wall("remote", 5600, 0, 1, 1)), "obstacle 'remote' reaches to (5599.5, -0.5)");
        assertRefused(Specs.world(robot("far", 600, 0, 0)), "expected at most 500.0 m");
        assertRefused(Specs.world(robot("lost", Double.NaN, 0, 0)), "robot 'lost' reaches to (NaN");
        assertRefused(Specs.world(robot("lost", 0, 0, Double.NaN)), "robot 'lost' has the heading NaN");
        assertRefused(
                Specs.world(Specs.with(R1, "startOdometry", new Pose(0, 1.7e308, 0))),
                "test.world:7:1: robot 'r1' starts with the odometry",
                "at most 1.0E9");
        assertRefused(Specs.world(Specs.with(R1, "massKg", 0.0)), "test.world:7:1: robot 'r1' has a mass of 0.0");
        assertRefused(
                Specs.world(Specs.with(R1, "sonar", new SonarSpec(List.of(), 3, 2, 1))),
                "test.world:7:1: robot 'r1': sonar range is [3.0 2.0]");
    }

    /** Physics runs in single precision: a world should be centred on the origin. */
    @Test
    void worldBeyond150Metres_isWarnedOf_once_namingWhatIsFarthest() {
        assertThat(LoggedWarnings.of(
                        SpecCheck.class,
                        () -> start(List.of(), wall("far", 160, 0, 1, 1), wall("farther", 0, -200, 1, 1))))
                .containsExactly(
                        "WARNING test.world: obstacle 'farther' reaches 201 m from the origin along x or y: beyond 150 m"
                                + " collisions get coarse, expected a world centred on the origin");
        assertThat(LoggedWarnings.of(SpecCheck.class, () -> start(List.of(), wall("near", 149, -149, 1, 1))))
                .isEmpty();
    }

    @Test
    void settings_keepWhatIsNotChanged_andNameANumberThatMakesNoSense() {
        assertThat(WorldSettings.defaults()
                        .withSeed(7)
                        .withJitter(0.02, 0.03)
                        .withPhysicsStepMicros(20_000)
                        .withLimits(1, 2)
                        .withWatchdogMicros(500_000)
                        .withSensingThreads(3))
                .hasToString("7 0.02 0.03 20000 1.0 2.0 500000, 3 threads");
        WorldSettings settings = WorldSettings.defaults();
        assertThatThrownBy(() -> settings.withJitter(-0.1, 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("jitterM is -0.1, expected a finite number, 0 or more");
        assertThatThrownBy(() -> settings.withLimits(1, Double.NaN)).hasMessageContaining("maxTurnRadps is NaN");
        assertThatThrownBy(() -> settings.withPhysicsStepMicros(0)).hasMessageContaining("physicsStepMicros is 0");
        assertThatThrownBy(() -> settings.withSensingThreads(0)).hasMessageContaining("sensingThreads is 0");
    }
}
