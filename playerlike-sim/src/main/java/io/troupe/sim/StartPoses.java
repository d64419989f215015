package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.scenario.ObstacleSpec;
import io.troupe.sim.scenario.Pose;
import io.troupe.sim.scenario.RobotSpec;
import io.troupe.sim.scenario.WorldFileException;
import io.troupe.sim.scenario.WorldSpec;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/** Where robots start: where the world file says, moved a little at random if asked for, and clear of everything. */
final class StartPoses {
    private static final int MOST_DRAWS = 100;

    private record Body(String title, Outline outline) {}

    private final WorldSettings settings;
    private final List<Body> placed = new ArrayList<>();

    private StartPoses(WorldSettings settings) {
        this.settings = settings;
    }

    static List<Pose> of(WorldSpec spec, WorldSettings settings) {
        var starts = new StartPoses(settings);
        for (ObstacleSpec obstacle : spec.obstacles()) {
            if (obstacle.blocksBodies()) {
                starts.add("obstacle", obstacle.name(), new Outline(obstacle.shape(), obstacle.pose()));
            }
        }
        return spec.robots().stream().map(starts::choose).toList();
    }

    private void add(String kind, String name, Outline outline) {
        placed.add(new Body(kind + " '" + name + "'", outline));
    }

    private Pose choose(RobotSpec robot) {
        Pose wanted = robot.pose();
        var outline = new Outline(robot.collisionShape(), wanted);
        Body inTheWay = robot.blocksBodies() ? firstOverlapping(outline) : null;
        if (inTheWay != null) {
            throw new WorldFileException(
                    robot.where(), "robot '" + robot.name() + "' overlaps " + inTheWay.title() + ": move one of them");
        }
        boolean jitter = settings.jitterM() > 0 || settings.jitterRad() > 0;
        Pose chosen = jitter ? jittered(robot, outline) : wanted;
        outline.place(chosen);
        if (robot.blocksBodies()) {
            add("robot", robot.name(), outline);
        }
        return chosen;
    }

    private Pose jittered(RobotSpec robot, Outline outline) {
        var random = new RandomStream(settings.seed(), robot.name(), "start");
        Pose from = robot.pose();
        for (int draw = 0; draw < MOST_DRAWS; draw++) {
            var candidate = new Pose(
                    from.x() + random.nextWithin(settings.jitterM()),
                    from.y() + random.nextWithin(settings.jitterM()),
                    from.headingRad() + random.nextWithin(settings.jitterRad()));
            outline.place(candidate);
            if (!robot.blocksBodies()
                    || placed.stream().noneMatch(body -> body.outline().isWithin(outline, Physics.SKIN_M))) {
                return candidate;
            }
        }
        outline.place(from);
        String nearest = nearest(outline).title();
        throw new WorldFileException(
                robot.where(),
                "robot '" + robot.name() + "' has no room to start up to " + settings.jitterM() + " m and "
                        + settings.jitterRad() + " rad from its pose: " + MOST_DRAWS + " draws with seed "
                        + settings.seed() + " were all nearer than " + Physics.SKIN_M
                        + " m to another body; nearest is "
                        + nearest);
    }

    private @Nullable Body firstOverlapping(Outline outline) {
        for (Body body : placed) {
            if (body.outline().overlaps(outline)) {
                return body;
            }
        }
        return null;
    }

    private Body nearest(Outline outline) {
        Body nearest = placed.getFirst();
        for (Body body : placed) {
            if (body.outline().gapM(outline) < nearest.outline().gapM(outline)) {
                nearest = body;
            }
        }
        return nearest;
    }
}
