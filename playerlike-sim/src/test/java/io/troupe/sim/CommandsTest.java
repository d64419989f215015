package io.troupe.sim;

import static io.troupe.sim.Specs.robot;
import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.troupe.sim.model.Pose;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Goals, headings, motor power, teleports and the watchdog, tested on the world itself. */
class CommandsTest {
    private static World world(Pose start) {
        return World.create(Specs.world(robot("r1", start)), WorldSettings.DEFAULT);
    }

    private static RobotReading run(World world, int ticks) {
        for (int i = 0; i < ticks; i++) {
            world.advance();
        }
        return world.latest().robots().getFirst();
    }

    @Test
    void goTo_arrives_andTurnsToTheFinalHeading() {
        for (Pose goal : List.of(
                new Pose(2, 0, 1),
                new Pose(-1, 1.5, -2),
                new Pose(0, -3, 3.1),
                new Pose(0.5, 0.5, 0),
                new Pose(0, 0, 2))) {
            World world = world(new Pose(7, -3, 0.8)); // the odometry frame begins there
            world.goTo(0, goal);

            RobotReading reading = run(world, 300);

            Pose reported = reading.odometry().pose();
            assertThat(Math.abs(reported.x() - goal.x())).as("x of %s", goal).isLessThanOrEqualTo(0.02);
            assertThat(Math.abs(reported.y() - goal.y())).as("y of %s", goal).isLessThanOrEqualTo(0.02);
            assertThat(StrictMath.IEEEremainder(reported.headingRad() - goal.headingRad(), 2 * StrictMath.PI))
                    .as("heading of %s", goal)
                    .isCloseTo(0, within(0.001));
        }
    }

    @Test
    void goTo_drivesAtMost40CentimetresPerSecond_andTurnsBeforeItDrives() {
        World world = world(Pose.ORIGIN);
        world.goTo(0, new Pose(0, 5, 0));

        Pose turning = run(world, 5).pose();
        assertThat(turning.headingRad()).as("1 rad/s at most").isCloseTo(0.5, within(1e-9));
        assertThat(turning.y()).isZero();
        run(world, 40);
        double from = world.latest().robots().getFirst().pose().y();
        assertThat(run(world, 10).pose().y() - from).isCloseTo(0.4, within(1e-3));
        assertThat(world.latest().robots().getFirst().odometry().forwardMps()).isEqualTo(0.4);
    }

    @Test
    void goTo_turnsEquallyFastToTheRight() {
        World world = world(Pose.ORIGIN);
        world.goTo(0, new Pose(0, -5, 0));

        assertThat(run(world, 5).pose().headingRad()).isCloseTo(-0.5, within(1e-9));
    }

    @Test
    void goTo_isReplacedByASpeed() {
        World world = world(Pose.ORIGIN);
        world.goTo(0, new Pose(5, 0, 0));
        run(world, 5);
        world.command(0, 0, 0.5);

        assertThat(run(world, 10).odometry().forwardMps()).isZero();
        assertThat(run(world, 1).odometry().turnRadps()).isEqualTo(0.5);
    }

    @Test
    void steer_turnsToTheHeadingWhileItDrives() {
        World world = world(new Pose(0, 0, 1));
        world.steer(0, 0.1, -0.5);

        RobotReading reading = run(world, 200);

        assertThat(reading.odometry().pose().headingRad()).isCloseTo(-0.5, within(1e-6));
        assertThat(reading.odometry().forwardMps()).isEqualTo(0.1);
        assertThat(reading.pose().headingRad()).as("in the odometry frame").isCloseTo(0.5, within(1e-6));
    }

    @Test
    void motorsOff_standStill_andForgetWhatTheyWereTold() {
        World world = world(Pose.ORIGIN);
        world.command(0, 0.5, 0);
        run(world, 2);
        world.motorPower(0, false);
        assertThat(run(world, 5).pose().x()).isCloseTo(0.1, within(1e-9));
        world.command(0, 0.5, 0);
        run(world, 1);
        world.motorPower(0, true);
        assertThat(run(world, 5).pose().x()).isCloseTo(0.1, within(1e-9));
        world.command(0, 0.5, 0);
        assertThat(run(world, 2).pose().x()).isCloseTo(0.2, within(1e-9));
    }

    @Test
    void watchdog_stopsARobotThatHearsNothing_inSimulatedTime() {
        World world =
                World.create(Specs.world(robot("r1", Pose.ORIGIN)), WorldSettings.DEFAULT.withWatchdogMicros(500_000));
        world.command(0, 0.2, 0);
        assertThat(run(world, 20).pose().x()).isCloseTo(0.1, within(1e-9));
        for (int i = 0; i < 20; i++) {
            world.command(0, 0.2, 0);
            run(world, 1);
        }
        assertThat(world.latest().robots().getFirst().pose().x()).isCloseTo(0.5, within(1e-9));
        world.goTo(0, new Pose(2, 0, 0));
        assertThat(run(world, 100).pose().x()).as("a goal is not a speed").isCloseTo(2, within(0.02));
    }

    @Test
    void watchdog_isOffByDefault() {
        World world = world(Pose.ORIGIN);
        world.command(0, 0.2, 0);
        assertThat(run(world, 100).pose().x()).isCloseTo(2, within(1e-9));
    }

    @Test
    void teleport_putsTheRobotThere_andItDrivesOn() {
        World world =
                World.create(Specs.world(robot("r1", Pose.ORIGIN), wall("wall", 1.18, 0, 1, 4)), WorldSettings.DEFAULT);
        world.command(0, 0.5, 0);
        run(world, 20);
        assertThat(world.latest().robots().getFirst().odometry().stalled()).isTrue();
        world.teleport(0, new Pose(-5, 3, StrictMath.PI / 2));

        RobotReading reading = run(world, 10);

        // the touch ends in the first step, which is as exact as the physics: single precision
        assertThat(reading.pose().x()).isCloseTo(-5, within(1e-6));
        assertThat(reading.pose().y()).isCloseTo(3.5, within(1e-6));
        assertThat(reading.odometry().stalled()).isFalse();
        assertThat(reading.odometry().pose()).as("exact odometry follows").isEqualTo(reading.pose());
    }

    @Test
    void teleport_intoSomething_isRefused_sayingIntoWhat() {
        World world = World.create(
                Specs.world(
                        List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(0, 3, 0))), wall("wall", 3, 0, 1, 1)),
                WorldSettings.DEFAULT);

        assertThatThrownBy(() -> world.teleport(0, new Pose(2.5, 0, 0)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("robot 'r1' cannot be put at (2.5 m, 0.0 m, 0.0 rad): it would overlap obstacle 'wall'");
        assertThatThrownBy(() -> world.teleport(0, new Pose(0.2, 3.2, 1)))
                .hasMessageContaining("it would overlap robot 'r2'");
        assertThatThrownBy(() -> world.teleport(0, new Pose(Double.NaN, 0, 0))).hasMessageContaining("finite");
        assertThatThrownBy(() -> world.teleport(0, new Pose(501, 0, 0))).hasMessageContaining("at most 500.0 m");
        assertThat(run(world, 1).pose()).isEqualTo(Pose.ORIGIN);
        world.teleport(0, new Pose(0.1, 0.1, 0));
        assertThat(run(world, 1).pose())
                .as("where it stands itself there is room")
                .isEqualTo(new Pose(0.1, 0.1, 0));
    }

    @Test
    void teleports_ofTwoRobotsToOnePlace_letOneThere() {
        World world = World.create(
                Specs.world(List.of(robot("r1", Pose.ORIGIN), robot("r2", new Pose(0, 3, 0)))), WorldSettings.DEFAULT);
        world.teleport(0, new Pose(5, 5, 0));
        world.teleport(1, new Pose(5, 5, 1));

        Snapshot snapshot = world.advance();

        assertThat(snapshot.robots().get(0).pose()).isEqualTo(new Pose(5, 5, 0));
        assertThat(snapshot.robots().get(1).pose()).isEqualTo(new Pose(0, 3, 0));
    }
}
