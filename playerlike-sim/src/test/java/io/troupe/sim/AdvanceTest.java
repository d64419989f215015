package io.troupe.sim;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.device.BlobImage;
import io.troupe.sim.device.ColourBlob;
import io.troupe.sim.model.Pose;
import io.troupe.sim.worldfile.ScenarioReader;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;
import org.junit.jupiter.api.Test;

/** Many intervals in one call, and the view that controllers get meanwhile. */
class AdvanceTest {
    private static World crowd() {
        return World.create(Tiles.world(20, 5, Specs.RED, Specs.ORANGE), WorldSettings.DEFAULT);
    }

    @Test
    void manyIntervals_endWhereSingleOnesDo() {
        World single = crowd();
        World many = crowd();
        for (int tick = 0; tick < 200; tick++) {
            Tiles.wander(single.view());
            single.advance();
        }

        Snapshot end = many.advance(150, Tiles::wander);
        assertThat(end.tick()).isEqualTo(150);
        end = many.advance(50, Tiles::wander);

        assertThat(end).isEqualTo(single.latest()).isSameAs(many.latest());
        assertThat(many.timeMicros()).isEqualTo(20_000_000);
    }

    @Test
    void intervals_withoutAController_keepTheLastCommand() {
        World world = World.create(Specs.world(Specs.robot("r", Pose.ORIGIN)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);

        assertThat(world.advance(20).robots().getFirst().pose().x()).isCloseTo(1, within(1e-12));
    }

    @Test
    void view_showsAtEveryTick_whatASnapshotTells() {
        World world = crowd();
        var contacts = new ArrayList<Contact>();
        world.advance(300, view -> {
            Snapshot snapshot = view.snapshot();
            assertThat(view.tick()).isEqualTo(snapshot.tick());
            assertThat(view.timeMicros()).isEqualTo(snapshot.timeMicros());
            assertThat(view.contactCount()).isEqualTo(snapshot.contacts().size());
            for (int i = 0; i < view.contactCount(); i++) {
                assertThat(contact(view, i, world))
                        .isEqualTo(snapshot.contacts().get(i));
            }
            contacts.addAll(snapshot.contacts());
            for (int robot = 0; robot < view.robotCount(); robot++) {
                assertShows(view, robot, snapshot.robots().get(robot));
            }
            Tiles.wander(view);
        });
        assertThat(contacts).isNotEmpty();
    }

    private static Contact contact(WorldView view, int i, World world) {
        int obstacle = view.contactObstacle(i);
        String other = obstacle >= 0
                ? world.spec().obstacles().get(obstacle).name()
                : world.spec().robots().get(view.contactOtherRobot(i)).name();
        return new Contact(view.contactTimeMicros(i), view.contactRobot(i), other, view.contactOtherRobot(i));
    }

    private static void assertShows(WorldView view, int robot, RobotReading reading) {
        assertThat(new Pose(view.x(robot), view.y(robot), view.headingRad(robot)))
                .isEqualTo(reading.pose());
        assertThat(new Pose(view.odometryX(robot), view.odometryY(robot), view.odometryHeadingRad(robot)))
                .isEqualTo(reading.odometry().pose());
        assertThat(view.forwardMps(robot)).isEqualTo(reading.odometry().forwardMps());
        assertThat(view.turnRadps(robot)).isEqualTo(reading.odometry().turnRadps());
        assertThat(view.stalled(robot)).isEqualTo(reading.odometry().stalled());
        assertThat(view.wallGapM(robot)).isEqualTo(reading.wallGapM());
        assertThat(IntStream.range(0, view.sonarCount(robot)).mapToObj(i -> view.rangeM(robot, i)))
                .isEqualTo(reading.sonarM());
        BlobImage image = reading.blobs();
        assertThat(view.blobCount(robot)).isEqualTo(image.blobs().size());
        for (int i = 0; i < view.blobCount(robot); i++) {
            ColourBlob blob = image.blobs().get(i);
            assertThat(List.of(view.blobColour(robot, i), view.blobLeft(robot, i), view.blobRight(robot, i)))
                    .isEqualTo(List.of(blob.colour(), blob.left(), blob.right()));
            assertThat(List.of(view.blobTop(robot, i), view.blobBottom(robot, i), view.blobRangeM(robot, i)))
                    .isEqualTo(List.of(blob.top(), blob.bottom(), blob.rangeM()));
        }
    }

    @Test
    void latest_duringALongAdvance_isMadeWhenSomebodyAsks() {
        World world = crowd();
        List<Long> seen = new ArrayList<>();
        world.latest();
        world.advance(6, view -> {
            if (view.tick() % 2 == 0) {
                seen.add(world.latest().tick()); // requests the next snapshot
            }
        });
        // tick 0 exists; a request at tick 0 publishes tick 1, and so on
        assertThat(seen).containsExactly(0L, 1L, 3L);
        assertThat(world.latest().tick()).isEqualTo(6);
    }

    @Test
    void viewCommand_replacesWhatOthersSaidBefore_andIsReplacedByWhatTheySayAfter() {
        World world = World.create(Specs.world(Specs.robot("r", Pose.ORIGIN)), WorldSettings.DEFAULT);
        world.command(0, 0.1, 0);
        world.view().command(0, 0.2, 0);
        assertThat(world.advance().robots().getFirst().odometry().forwardMps()).isEqualTo(0.2);

        world.view().command(0, 99, -99);
        assertThat(world.view().forwardMps(0)).as("still what was in force").isEqualTo(0.2);
        assertThat(world.advance().robots().getFirst().odometry().turnRadps()).isEqualTo(-10);

        world.view().command(0, 0.3, 0);
        world.command(0, 0.4, 0);
        assertThat(world.advance().robots().getFirst().odometry().forwardMps()).isEqualTo(0.4);
        assertThatThrownBy(() -> world.view().command(0, Double.NaN, 0)).hasMessageContaining("robot 'r'");
    }

    @Test
    void controllerThatThrows_endsTheAdvance_andTheTickBeforeIsPublished() {
        World world = crowd();
        assertThatThrownBy(() -> world.advance(10, view -> {
                    if (view.tick() == 4) {
                        throw new IllegalStateException("enough");
                    }
                }))
                .hasMessage("enough");
        assertThat(world.latest().tick()).isEqualTo(4);
        assertThat(world.advance().tick()).isEqualTo(5);
    }

    @Test
    void contacts_areThoseOfTheLastInterval() {
        World world = World.create(
                Specs.world(Specs.robot("r", Pose.ORIGIN), Specs.wall("wall", 0.8, 0, 1, 4)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);

        assertThat(world.advance(20).contacts()).isEmpty();
        assertThat(world.view().contactCount()).isZero();
    }

    @Test
    void whatIsNotThere_isRefused() {
        World world = World.create(Specs.world(Specs.robot("r", Pose.ORIGIN)), WorldSettings.DEFAULT);
        assertThat(world.view().sonarCount(0)).isZero();
        assertThat(world.view().blobCount(0)).isZero();
        assertThatThrownBy(() -> world.view().rangeM(0, 0)).isInstanceOf(IndexOutOfBoundsException.class);
        assertThatThrownBy(() -> world.view().blobColour(0, 0)).hasMessage("there is no blob 0, robot 0 sees 0");
        assertThatThrownBy(() -> world.view().contactRobot(0)).isInstanceOf(IndexOutOfBoundsException.class);
        assertThatThrownBy(() -> world.advance(0)).hasMessageContaining("cannot advance by 0 intervals");
    }

    @Test
    void sonarsOfStage4_areTheRangerWithOneRayForEachSensor_andAllRangersCanBeRead() {
        World world =
                World.create(ScenarioReader.readText("""
                        model ( pose [ 3 0 0 0 ] size [ 2 8 ] )
                        position ( name "r"
                          ranger ( sensor ( range [ 0 8 ] fov 90 samples 3 ) )
                          ranger ( sensor ( pose [ 0 0 0 0 ] range [ 0 5 ] ) sensor ( pose [ 0 0 0 180 ] range [ 0 4 ] ) ) )
                        position ( name "scanner" pose [ 0 3 0 0 ] ranger ( sensor ( samples 90 ) ) )
                        """, Path.of("t.world")).world(), WorldSettings.DEFAULT);
        WorldView view = world.view();

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
}
