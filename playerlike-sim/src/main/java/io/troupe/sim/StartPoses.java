package io.troupe.sim;

import io.troupe.sim.device.Outline;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import io.troupe.sim.worldfile.WorldFileException;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;

/**
 * Start poses of the robots: the poses of the world file, with random jitter if the settings ask for it, then clear of
 * every other body. A robot that overlaps something at its pose in the file is not moved, and is stuck there.
 *
 * @param stuck which robots, by index, overlap an obstacle or each other
 */
record StartPoses(List<Pose> poses, BitSet stuck) {
    static StartPoses of(WorldSpec spec, WorldSettings settings) {
        var choice = new Choice(settings);
        for (ObstacleSpec obstacle : spec.obstacles()) {
            if (obstacle.blocksBodies()) {
                choice.add("obstacle", obstacle.name(), -1, new Outline(obstacle.shape(), obstacle.pose()));
            }
        }
        choice.findStuck(spec.robots());
        var poses = new ArrayList<Pose>();
        for (int i = 0; i < spec.robots().size(); i++) {
            poses.add(choice.choose(spec.robots().get(i), i));
        }
        return new StartPoses(List.copyOf(poses), choice.stuck);
    }

    /** Places the robots one after the other, by index. */
    private static final class Choice {
        private static final int MOST_DRAWS = 100;

        /** @param robot its index, -1 for an obstacle */
        private record Body(String title, int robot, Outline outline) {}

        private final WorldSettings settings;
        private final List<Body> placed = new ArrayList<>();
        private final BitSet stuck = new BitSet();

        Choice(WorldSettings settings) {
            this.settings = settings;
        }

        void add(String kind, String name, int robot, Outline outline) {
            placed.add(new Body(title(kind, name), robot, outline));
        }

        private static String title(String kind, String name) {
            return kind + " '" + name + "'";
        }

        /**
         * Finds the stuck robots, by the poses of the file alone. They stay there, and the others are kept clear of
         * them.
         */
        void findStuck(List<RobotSpec> robots) {
            var all = new ArrayList<>(placed);
            for (int i = 0; i < robots.size(); i++) {
                RobotSpec robot = robots.get(i);
                if (robot.blocksBodies()) {
                    var body = new Body(
                            title("robot", robot.name()), i, new Outline(robot.collisionShape(), robot.pose()));
                    for (Body other : all) {
                        if (other.outline().overlaps(body.outline())) {
                            stuck.set(i);
                            if (other.robot() >= 0) {
                                stuck.set(other.robot());
                            }
                        }
                    }
                    all.add(body);
                }
            }
            all.stream()
                    .filter(body -> body.robot() >= 0 && stuck.get(body.robot()))
                    .forEach(placed::add);
        }

        Pose choose(RobotSpec robot, int index) {
            if (stuck.get(index)) {
                return robot.pose(); // placed already
            }
            var outline = new Outline(robot.collisionShape(), robot.pose());
            boolean jitter = settings.jitterM() > 0 || settings.jitterRad() > 0;
            Pose chosen = jitter ? jittered(robot, outline) : robot.pose();
            outline.place(chosen);
            if (robot.blocksBodies()) {
                add("robot", robot.name(), index, outline);
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
}
