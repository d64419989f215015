package io.troupe.services.component.kinds;

import io.troupe.services.bus.BusTopic;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * A Player server, ours or a real one, as a component: its robots say what they sense, and hear how to move.
 *
 * <p><b>Role.</b> Robot n publishes {@code robotn/sonar} and {@code robotn/position}, and {@code robotn/blobs} and
 * {@code robotn/laser} if the settings say that it has these; it drives as {@code robotn/velocity} says. When no
 * velocity has come for {@value PlayerRobot#PATIENCE_READINGS} readings, the robot is stopped, and this is told.
 *
 * <p><b>Threads.</b> A server in this JVM is found by its port; its world waits, in lock step, until the space of the
 * interface has nothing left to do. Connecting to a server behind a socket holds the space meanwhile.
 *
 * <p><b>Errors.</b> It cannot be started where there is no server, or no such robot; it fails when the server goes
 * away.
 */
public final class PlayerComponent {
    /**
     * Where the server is, and what of it is used.
     *
     * @param robots by number from 1, which is the Player index plus one
     * @param camera whether they have blobfinders, which are subscribed to then
     * @param laser whether they have lasers, which are subscribed to then
     */
    public record Settings(String host, int port, List<Integer> robots, boolean camera, boolean laser) {
        public Settings {
            robots = List.copyOf(robots);
            if (robots.isEmpty() || robots.stream().anyMatch(number -> number < 1)) {
                throw new IllegalArgumentException("robots are " + robots + ", expected numbers from 1");
            }
        }

        /** Without lasers. */
        public Settings(String host, int port, List<Integer> robots, boolean camera) {
            this(host, port, robots, camera, false);
        }

        String where() {
            return "Player server " + host + ":" + port;
        }
    }

    private PlayerComponent() {}

    public static Component<?, ?> of(Settings settings) {
        Map<Integer, String> names = new LinkedHashMap<>();
        List<BusTopic<?>> hears = new ArrayList<>();
        List<BusTopic<?>> publishes = new ArrayList<>();
        for (int number : settings.robots()) {
            String robot = "robot" + number;
            names.put(number - 1, robot);
            hears.add(RobotTopics.velocity(robot));
            publishes.add(RobotTopics.position(robot));
            publishes.add(RobotTopics.sonar(robot));
            if (settings.camera()) {
                publishes.add(RobotTopics.blobs(robot));
            }
            if (settings.laser()) {
                publishes.add(RobotTopics.laser(robot));
            }
        }
        return new Component<>(
                "player",
                List.of("senses", "moves"),
                hears,
                publishes,
                () -> new PlayerCommunication(settings),
                new PlayerConversion(names),
                Buffering.LATEST, // an old command is worse than none
                Buffering.STREAM);
    }
}
