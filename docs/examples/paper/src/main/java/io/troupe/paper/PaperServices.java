package io.troupe.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.player.BlobfinderInterface;
import io.troupe.player.PlayerClient;
import io.troupe.player.Position2DInterface;
import io.troupe.player.SonarInterface;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.ReadingTime;
import io.troupe.services.behaviour.SonarRing;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/**
 * The services class of the paper, "made as actor", with the methods that Figures 17 and 20 call. A reference is 1 =
 * run, 0 = stop, 2 = stopped. The caller sets it to 1 before it calls a service, and to 0 to end the service: "There is
 * a loop in the service which checks the value of the atomic reference of the service."
 *
 * <p>A robot has one service: a service that starts ends the robot's previous one and waits until that has stopped,
 * whatever its reference is. So no state begins while a service of the state before drives the same robot.
 */
public class PaperServices extends Actor {
    private static final int RUN = 1;
    private static final int STOPPED = 2;

    private final String host;
    private final int port;
    private final SubsumptionTable table = SubsumptionTable.ofThePaper();
    private final Map<Integer, Connection> connections = new HashMap<>(); // by the id of the robot

    PaperServices(String host, int port) {
        this.host = host;
        this.port = port;
    }

    /** Follows the wall on the left until the reference is cleared. */
    public void wallFollower(int id, AtomicReference<Integer> atomicRefWF) {
        service(id, atomicRefWF, robot -> {
            var follower = new WallFollower(CornerStyle.FORWARD);
            var temp = WallFollower.START;
            while (atomicRefWF.get() == RUN && robot.waitForData()) {
                var step = follower.step(temp, robot.sonar());
                temp = step.memory();
                robot.setSpeed(step.velocity());
            }
            return null;
        });
    }

    /**
     * Wanders until the robot sees a colour that leads to another state, or until the reference is cleared.
     *
     * @param atomicRefBF the colour finder's: 1 = look for colours
     * @return the colour seen; the state's own if the service was stopped before it saw another
     */
    public Promise<Integer> spaceWanderer(
            int id, AtomicReference<Integer> atomicRefSW, AtomicReference<Integer> atomicRefBF, int stateColor) {
        var rule = table.ruleIn(table.state(stateColor).orElseThrow());
        return service(id, atomicRefSW, robot -> {
            while (atomicRefSW.get() == RUN && robot.waitForData()) {
                var color = rule.pick(atomicRefBF.get() == RUN ? robot.blobs() : List.of(), 0);
                if (color.isPresent()) {
                    return color.getAsInt();
                }
                robot.setSpeed(SpaceWanderer.steer(robot.sonar()));
            }
            return stateColor;
        });
    }

    /** Wanders until the reference is cleared, and sends every colour but black at every reading. */
    public void spaceWanderer(
            Callback<Integer> callback,
            int id,
            AtomicReference<Integer> atomicRefSW,
            AtomicReference<Integer> atomicRefBF) {
        service(id, atomicRefSW, robot -> {
            while (atomicRefSW.get() == RUN && robot.waitForData()) {
                robot.setSpeed(SpaceWanderer.steer(robot.sonar()));
                var colors = ColourFinder.inOrder(robot.blobs(), color -> 0).filter(color -> color != 0);
                for (int color : colors.distinct().toArray()) {
                    if (atomicRefBF.get() == RUN) {
                        callback.next(color);
                        Promise.done().thenRun(() -> {}).await(); // the main code receives the colour before the next
                    }
                }
            }
            return null;
        });
    }

    /** Runs a service in a body that can wait; the robot stops at its end. */
    private <T extends @Nullable Object> Promise<T> service(
            int id, AtomicReference<Integer> reference, Function<Connection, T> loop) {
        return context().space().sequential(() -> {
            for (var previous = connections.get(id); previous != null; previous = connections.get(id)) {
                previous.end().await();
            }
            try (var robot = new Connection(id, reference)) {
                return loop.apply(robot);
            }
        });
    }

    /**
     * The connection of one service with its robot: "Connection and control of the robot is defined in the services",
     * and "there is a reconnection every time when the services are switched".
     */
    private final class Connection implements AutoCloseable {
        private final int id;
        private final PlayerClient robot;
        private final Position2DInterface posi;
        private final SonarInterface rngi;
        private final BlobfinderInterface blfi;
        private final AtomicReference<Integer> reference;
        private final Deferred<@Nullable Void> ended = new Deferred<>();
        private Deferred<@Nullable Void> waiting = new Deferred<>();
        private Promise<@Nullable Void> reading = Promise.done();
        private boolean isOver;
        private double cycleSeconds = Double.NEGATIVE_INFINITY;
        private int cycles;

        Connection(int id, AtomicReference<Integer> reference) {
            this.id = id;
            this.reference = reference;
            robot = new PlayerClient(host, port);
            robot.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
            posi = robot.requestInterfacePosition2D(id, PlayerConstants.PLAYER_OPEN_MODE);
            rngi = robot.requestInterfaceSonar(id, PlayerConstants.PLAYER_OPEN_MODE);
            blfi = robot.requestInterfaceBlobfinder(id, PlayerConstants.PLAYER_OPEN_MODE);
            DriverLimits.limit(posi);
            robot.runThreaded(-1, -1);
            connections.put(id, this);
        }

        /** Waits for the next reading, 100 ms or more after the one before; false if the service is to end. */
        boolean waitForData() {
            while (!isOver) {
                waiting = new Deferred<>();
                reading = robot.nextData();
                waiting.resolveFrom(reading);
                waiting.await();
                boolean isReady = rngi.isDataReady() && blfi.getData() != null;
                if (!isOver && isReady && ReadingTime.isCycle(cycleSeconds, rngi.getTimestamp())) {
                    cycleSeconds = rngi.getTimestamp();
                    cycles++;
                    return true;
                }
            }
            return false;
        }

        SonarRing sonar() {
            return SonarRing.of(rngi.getData().getRanges());
        }

        /**
         * What the camera sees; nothing in the first cycle. Otherwise two robots that see each other's colours would
         * switch at every reading, and never move.
         */
        List<Blob> blobs() {
            return cycles == 1 ? List.of() : Blob.of(blfi.getData());
        }

        void setSpeed(Velocity velocity) {
            posi.setSpeed(velocity.forwardMps(), velocity.turnRadps());
        }

        /** Ends the service now instead of at the next reading. */
        Promise<@Nullable Void> end() {
            isOver = true;
            waiting.resolve(null);
            return ended;
        }

        @Override
        public void close() {
            reading.cancel(); // closing the client would reject it
            try {
                posi.setSpeed(0, 0);
            } finally {
                robot.close();
                connections.remove(id);
                reference.compareAndSet(0, STOPPED);
                ended.resolve(null);
            }
        }
    }
}
