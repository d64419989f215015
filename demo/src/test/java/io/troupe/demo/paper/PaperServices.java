package io.troupe.demo.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.Blob;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.ControlCycle;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;

/**
 * The services class of the paper, "made as actor", with the methods that Figures 17 and 20 call. A reference is 1 =
 * run, 0 = stop, 2 = stopped and zero speed sent. The caller sets it to 1 before it calls a service, and to 0 to end
 * the service: "There is a loop in the service which checks the value of the atomic reference of the service."
 */
public class PaperServices extends Actor {
    private static final int STOP = 0;
    private static final int RUN = 1;
    private static final int STOPPED = 2;

    private final SubsumptionTable table = SubsumptionTable.ofThePaper();
    private final Map<Integer, RobotConnection> connections = new HashMap<>();
    private final Map<Integer, Loop> loops = new HashMap<>(); // the running services by robot

    /** Follows the wall on the left until the reference is cleared. */
    public Promise<Void> wallFollower(int robot, AtomicReference<Integer> reference) {
        return run(robot, Service.WALL_FOLLOWER, reference, blobs -> {});
    }

    /**
     * Wanders until the robot sees a colour that leads to another state, or until the reference is cleared.
     *
     * @param colourFinder 1 = look for colours; set to 2 when the service has stopped
     * @return the colour seen; the state's own colour if the robot was stopped before it saw another
     */
    public Promise<Integer> spaceWanderer(
            int robot, AtomicReference<Integer> reference, AtomicReference<Integer> colourFinder, int stateColour) {
        var rule = table.ruleIn(table.state(stateColour).orElseThrow());
        var seen = new AtomicReference<>(stateColour);
        return run(robot, Service.SPACE_WANDERER, reference, blobs -> {
                    if (colourFinder.get() == RUN) {
                        rule.pick(blobs, 0).ifPresent(colour -> {
                            seen.set(colour);
                            reference.set(STOP);
                        });
                    }
                })
                .thenApply(stopped -> {
                    colourFinder.set(STOPPED);
                    return seen.get();
                });
    }

    /** Wanders until the reference is cleared, and sends every colour but black at every reading. */
    public void spaceWanderer(
            Callback<Integer> colours,
            int robot,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder) {
        run(robot, Service.SPACE_WANDERER, reference, blobs -> {
                    if (colourFinder.get() == RUN) {
                        ColourFinder.inOrder(blobs, colour -> 0)
                                .filter(colour -> colour != 0)
                                .distinct()
                                .forEach(colours::next);
                    }
                })
                .whenComplete((stopped, error) -> {
                    colourFinder.set(STOPPED);
                    if (error == null) {
                        colours.finish();
                    } else {
                        colours.fail(error);
                    }
                });
    }

    /** Fulfilled when the service of a cleared reference has stopped; ends its wait for the next reading. */
    public Promise<Void> stop(AtomicReference<Integer> reference) {
        return loops.values().stream()
                .filter(loop -> loop.reference == reference)
                .findFirst()
                .map(Loop::end)
                .orElseGet(Promise::done);
    }

    @Override
    protected void stopped() {
        connections.values().forEach(RobotConnection::close);
    }

    private Promise<Void> run(
            int robot, Service service, AtomicReference<Integer> reference, Consumer<List<Blob>> colourFinder) {
        Loop previous = loops.get(robot);
        if (previous == null) {
            var loop = new Loop(robot, service, reference, colourFinder);
            loops.put(robot, loop);
            return loop.ended.whenComplete((stopped, error) -> loops.remove(robot, loop));
        }
        if (previous.reference.get() == RUN) {
            throw new IllegalStateException("robot " + (robot + 1) + " has a service that runs");
        }
        return previous.end()
                .handle((stopped, error) -> null)
                .thenCompose(free -> run(robot, service, reference, colourFinder));
    }

    private RobotConnection connect(int robot) {
        var connection = RobotConnection.open(
                "localhost",
                6665,
                RobotConnection.Delivery.PULL,
                List.of(new RobotConnection.Devices(robot, true, false)));
        connection.readOnSpace();
        return connection;
    }

    /** A service that drives a robot: a cycle for each reading, until the reference is cleared. */
    private final class Loop {
        private final RobotConnection connection;
        private final PlayerRobot robot;
        private final AtomicReference<Integer> reference;
        private final Consumer<List<Blob>> colourFinder;
        private final ControlCycle cycle;
        private final Promise<Void> ended;
        private boolean firstCycle = true;

        Loop(int index, Service service, AtomicReference<Integer> reference, Consumer<List<Blob>> colourFinder) {
            this.connection = connections.computeIfAbsent(index, PaperServices.this::connect);
            this.robot = connection.robots().getFirst();
            this.reference = reference;
            this.colourFinder = colourFinder;
            this.cycle = new ControlCycle(service.behaviour().get(), robot::drive);
            this.ended = space().repeatWhile(() -> reference.get() == RUN, this::next)
                    .whenComplete((done, error) -> {
                        cycle.halt();
                        reference.set(STOPPED);
                    });
        }

        Promise<Void> end() {
            connection.wake();
            return ended;
        }

        private Promise<?> next() {
            boolean takesOver = firstCycle && robot.hasData(); // then the colours of this reading have been seen
            firstCycle = false;
            if (takesOver) {
                drive();
                return Promise.done();
            }
            return connection.nextData().thenAccept(ready -> {
                if (ready && reference.get() == RUN && robot.hasData() && cycle.isDue(robot.timeSeconds())) {
                    colourFinder.accept(robot.blobs());
                    if (reference.get() == RUN) {
                        drive();
                    }
                }
            });
        }

        private void drive() {
            robot.drive(cycle.step(robot.senses(false)).orElse(Velocity.STOP));
        }
    }
}
