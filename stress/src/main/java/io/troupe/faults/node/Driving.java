package io.troupe.faults.node;

import io.troupe.actor.ActorSpace;
import io.troupe.faults.history.Event.Sent;
import io.troupe.faults.history.History;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.time.Duration;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Drives one robot through its Player server, with another speed each time, whether readings arrive or not. Connects
 * again when the connection has ended. On one space.
 */
final class Driving {
    private static final Duration PERIOD = Duration.ofMillis(100);
    private static final double SLOWEST_RADPS = 0.2;
    private static final double STEP_OF_A_LIFE_RADPS = 0.01;
    private static final double STEP_RADPS = 1e-6; // fewer than 10,000 commands of a life

    private final ActorSpace space;
    private final History.Writer history;
    private final String host;
    private final int port;
    private final int robot;
    private final int life;
    private @Nullable RobotConnection connection;
    private int commands;

    /** @param address that of the Player server, HOST:PORT */
    Driving(ActorSpace space, History.Writer history, String address, int robot, int life) {
        this.space = space;
        this.history = history;
        this.host = address.split(":")[0];
        this.port = Integer.parseInt(address.split(":")[1]);
        this.robot = robot;
        this.life = life;
    }

    void drive() {
        try {
            RobotConnection open = connection;
            if (open == null) {
                open = RobotConnection.open(
                        host,
                        port,
                        RobotConnection.Delivery.PUSH,
                        List.of(new RobotConnection.Devices(robot, false, false)));
                open.readOnSpace();
                connection = open;
            }
            PlayerRobot wheels = open.robots().getFirst();
            double turnRadps = SLOWEST_RADPS + life * STEP_OF_A_LIFE_RADPS + ++commands * STEP_RADPS;
            history.add(new Sent(robot, turnRadps));
            wheels.drive(new Velocity(0, turnRadps));
        } catch (PlayerException ended) {
            if (connection != null) {
                connection.close();
                connection = null;
            }
        }
        space.delay(PERIOD).thenRun(this::drive);
    }
}
