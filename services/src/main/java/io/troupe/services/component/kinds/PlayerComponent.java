package io.troupe.services.component.kinds;

import io.troupe.services.bus.Topic;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Makes a component of a Player server, Troupe's or another: it publishes the sensor readings of its robots, and
 * subscribes to their velocity commands.
 *
 * <p><b>Role.</b> Robot n publishes {@code robotn/sonar} and {@code robotn/position}, and also {@code robotn/blobs} and
 * {@code robotn/laser} if the settings enable them. It moves at the velocities published on {@code robotn/velocity}. A
 * moving robot that has received no velocity for {@value PlayerRobot#MAX_READINGS_WITHOUT_COMMAND} sonar readings is
 * stopped, and this is reported to the observer.
 *
 * <p><b>Threads.</b> A server in the same JVM is found by its port; in lock step, its world waits until the space of
 * the interface is idle. Connecting to a server over a socket blocks the space.
 *
 * <p><b>Errors.</b> The start fails if there is no server, or no such robot. The component fails when the connection to
 * the server is lost.
 */
public final class PlayerComponent {
    /**
     * Address of the server, and the devices that are used.
     *
     * @param robots robot numbers from 1, which are Player indices plus one
     * @param camera whether to subscribe to the blobfinders of the robots
     * @param laser whether to subscribe to the lasers of the robots
     */
    public record Settings(String host, int port, List<Integer> robots, boolean camera, boolean laser) {
        public Settings {
            robots = List.copyOf(robots);
            if (robots.isEmpty() || robots.stream().anyMatch(number -> number < 1)) {
                throw new IllegalArgumentException("robots are " + robots + ", expected numbers from 1");
            }
        }

        /** Settings without lasers. */
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
        List<Topic<?>> subscribes = new ArrayList<>();
        List<Topic<?>> publishes = new ArrayList<>();
        for (int number : settings.robots()) {
            String robot = "robot" + number;
            names.put(number - 1, robot);
            subscribes.add(RobotTopics.velocity(robot));
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
                subscribes,
                publishes,
                () -> new PlayerCommunication(settings),
                new PlayerConversion(names),
                Buffering.LATEST, // only the latest command is useful
                Buffering.STREAM);
    }
}
