package io.troupe.view;

import io.troupe.actor.Clock;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SimulationInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.player.structures.PlayerPose;
import io.troupe.services.robot.DriverLimits;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Snapshot;
import io.troupe.sim.device.Odometry;
import io.troupe.sim.device.Scene;
import io.troupe.sim.model.ObstacleSpec;
import io.troupe.sim.model.Pose;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.sim.physics.Physics;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * The robots of a Player server on another host, in the world that a file describes. Poses of the robots, and of the
 * obstacles that they can push, come from the server; gaps, contacts, speeds and what the sensors read are computed
 * from them, at each reading.
 *
 * <p><b>Threads.</b> One; {@link #stop} may be called by any thread.
 */
final class RemoteWorld implements AutoCloseable {
    private static final System.Logger LOG = System.getLogger(RemoteWorld.class.getName());
    private static final Duration POSE_LIMIT = Duration.ofSeconds(5);
    private static final double FAR_M = 3; // robots so far apart do not touch
    private static final Pose UNKNOWN = new Pose(0, 0, 0);

    private final WorldSpec world;
    private final String address;
    private final PlayerClient client;
    private final Position2DInterface first;
    private final SimulationInterface simulation;
    private final Scene scene;
    private final List<ComputedSensors> sensors = new ArrayList<>();
    private final List<Integer> movers; // indices of the obstacles that move
    private final Set<String> touching = new HashSet<>();
    private final Set<String> unknown = new HashSet<>(); // obstacles that the server does not know
    private double startSeconds = Double.NaN;
    private long ticks;
    private @Nullable Snapshot last;
    private volatile boolean stopped;

    /**
     * Connects.
     *
     * @throws PlayerException if there is no server, or it does not offer the devices
     */
    RemoteWorld(String host, int port, WorldSpec world) {
        this.world = world;
        this.address = host + ":" + port;
        this.scene = new Scene(world);
        world.robots().forEach(robot -> sensors.add(new ComputedSensors(robot)));
        this.movers = world.movingObstacles();
        this.client = new PlayerClient(host, port);
        try {
            client.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
            client.setSilenceLimit(DriverLimits.SILENCE_LIMIT);
            first = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
            simulation = client.requestInterfaceSimulation(0, PlayerConstants.PLAYER_OPEN_MODE);
        } catch (RuntimeException refused) {
            client.close();
            throw refused;
        }
    }

    /** The next reading, or null if this was stopped. Times begin with the first one. */
    @Nullable
    Snapshot next() {
        try {
            double stampSeconds;
            do {
                client.readAll();
                stampSeconds = first.getData() == null ? Double.NaN : first.getTimestamp();
            } while (Double.isNaN(stampSeconds));
            if (Double.isNaN(startSeconds)) {
                startSeconds = stampSeconds;
            }
            return snapshot(StrictMath.round((stampSeconds - startSeconds) * 1e6));
        } catch (PlayerException closed) {
            if (stopped) {
                return null;
            }
            throw closed;
        }
    }

    private Snapshot snapshot(long timeMicros) {
        var poses = new ArrayList<Pose>();
        for (int robot = 0; robot < world.robots().size(); robot++) {
            String name = world.robots().get(robot).name();
            Pose pose = pose(name);
            if (pose == null) {
                throw new PlayerException("the robots at " + address + " do not include '" + name
                        + "', expected those of " + world.file());
            }
            scene.place(robot, pose);
            poses.add(pose);
        }
        var moved = new ArrayList<Pose>();
        for (int mover = 0; mover < movers.size(); mover++) {
            Pose pose = place(world.obstacles().get(movers.get(mover)));
            scene.place(world.robots().size() + mover, pose);
            moved.add(pose);
        }
        scene.refresh();
        var readings = new ArrayList<RobotReading>();
        for (int robot = 0; robot < poses.size(); robot++) {
            Pose pose = poses.get(robot);
            readings.add(sensors.get(robot)
                    .read(scene, robot, pose, odometry(robot, pose, timeMicros), scene.wallGapM(robot)));
        }
        last = new Snapshot(
                ticks++, timeMicros, readings, contacts(timeMicros, poses, moved), moved, Collections.emptySortedMap());
        return last;
    }

    /** The speeds since the last reading. */
    private Odometry odometry(int robot, Pose pose, long timeMicros) {
        Snapshot before = last;
        if (before == null) {
            return new Odometry(UNKNOWN, 0, 0, false);
        }
        RobotReading reading = before.robots().get(robot);
        double seconds = (timeMicros - before.timeMicros()) / 1e6;
        if (seconds <= 0) {
            return reading.odometry();
        }
        Pose from = reading.pose();
        double turnRad = StrictMath.IEEEremainder(pose.headingRad() - from.headingRad(), 2 * StrictMath.PI);
        double middleRad = from.headingRad() + turnRad / 2; // it has turned meanwhile
        double x = pose.x() - from.x();
        double y = pose.y() - from.y();
        double cos = StrictMath.cos(middleRad);
        double sin = StrictMath.sin(middleRad);
        return new Odometry(
                UNKNOWN, (x * cos + y * sin) / seconds, (y * cos - x * sin) / seconds, turnRad / seconds, false);
    }

    /** Where an obstacle is that moves; its start if the server does not know it. */
    private Pose place(ObstacleSpec obstacle) {
        Pose pose = unknown.contains(obstacle.name()) ? null : pose(obstacle.name());
        if (pose == null && unknown.add(obstacle.name())) {
            LOG.log(
                    Level.WARNING,
                    "the simulator at {0} does not know where ''{1}'' is, expected the models of {2}: it is shown where"
                            + " that file has it",
                    address,
                    obstacle.name(),
                    world.file());
        }
        return pose == null ? obstacle.pose() : pose;
    }

    /** Where a model is; null if the server does not answer that. */
    private @Nullable Pose pose(String model) {
        simulation.get2DPose(model);
        long sinceNanos = Clock.system().nanos();
        while (!simulation.isPose2DReady()) {
            if (Clock.system().nanos() - sinceNanos > POSE_LIMIT.toNanos()) {
                return null;
            }
        }
        PlayerPose pose = simulation.getPose2D().getPose();
        return new Pose(pose.getPx(), pose.getPy(), pose.getPa());
    }

    // ---- contacts

    private List<Contact> contacts(long timeMicros, List<Pose> poses, List<Pose> moved) {
        List<ObstacleSpec> obstacles = new ArrayList<>(world.obstacles());
        for (int mover = 0; mover < moved.size(); mover++) {
            int index = movers.get(mover);
            obstacles.set(index, obstacles.get(index).at(moved.get(mover)));
        }
        List<Contact> begun = new ArrayList<>();
        for (int robot = 0; robot < poses.size(); robot++) {
            for (int other = 0; other < robot; other++) {
                String name = world.robots().get(other).name();
                Pose here = poses.get(robot);
                Pose there = poses.get(other);
                boolean near = StrictMath.hypot(here.x() - there.x(), here.y() - there.y()) < FAR_M;
                double gapM = near ? gapM(robot, here, body(other, there)) : Double.POSITIVE_INFINITY;
                if (begins(robot, name, gapM)) {
                    begun.add(new Contact(timeMicros, robot, name, other));
                }
            }
            for (ObstacleSpec obstacle : obstacles) {
                boolean near = scene.wallGapM(robot) <= Physics.SKIN_M && obstacle.blocksBodies();
                double gapM = near ? gapM(robot, poses.get(robot), obstacle) : Double.POSITIVE_INFINITY;
                if (begins(robot, "obstacle " + obstacle.name(), gapM)) {
                    begun.add(new Contact(timeMicros, robot, obstacle.name(), -1));
                }
            }
        }
        return begun;
    }

    private boolean begins(int robot, String with, double gapM) {
        String pair = robot + " " + with;
        if (gapM > Physics.SKIN_M) {
            touching.remove(pair);
            return false;
        }
        return touching.add(pair);
    }

    private ObstacleSpec body(int robot, Pose pose) {
        RobotSpec spec = world.robots().get(robot);
        return new ObstacleSpec(
                spec.name(), pose, spec.collisionShape(), spec.colour(), spec.blocksBodies(), true, true, spec.where());
    }

    private double gapM(int robot, Pose pose, ObstacleSpec obstacle) {
        RobotSpec spec = world.robots().get(robot);
        var both = new Scene(
                new WorldSpec(world.name(), world.file(), world.intervalMillis(), List.of(spec), List.of(obstacle)));
        both.place(0, pose);
        return both.wallGapM(0);
    }

    /** Ends {@link #next}. */
    void stop() {
        stopped = true;
        client.close();
    }

    @Override
    public void close() {
        client.close();
    }
}
