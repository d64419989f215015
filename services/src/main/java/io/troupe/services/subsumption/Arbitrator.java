package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Decides which service drives which robot, by the colours that the robots see: the paper's main code in promise and in
 * callback mode.
 *
 * <p><b>Role.</b> An actor: spawn it and send {@link #live} once. After each switch it sends {@link #live} to itself.
 *
 * <p><b>Order.</b> A switch takes these steps. In promise mode, a wanderer that has seen a colour ends itself and
 * fulfils its promise. In callback mode, it sends every colour at every reading and keeps driving; the first colour
 * that leads to another state counts. The arbitrator stops all services. When all of them have stopped, the services of
 * the next state start. It waits for a promise where the paper has a busy loop. All steps happen between two readings,
 * so every robot always has exactly one service. If two robots see colours in the same reading, the message that
 * arrives first counts (from the robot with the lower index); the other is too late.
 *
 * <p><b>Errors.</b> When a service fails, {@link #failure} is rejected with the same error; in callback mode also when
 * a service ends although it was not stopped. When this actor is stopped, its services stop.
 *
 * <p><b>Source.</b> Paper, section 3.5, Figure 17, and section 3.6, Figure 20.
 */
public class Arbitrator extends Actor {
    /** Notified of every state that starts. Called on the actor space's thread. */
    @FunctionalInterface
    public interface StateListener {
        /**
         * Called when a state starts, before its services do.
         *
         * @param seenByIndex Player index, from 0, of the robot that saw the state's colour; null for the first state
         */
        void stateStarted(State state, @Nullable Integer seenByIndex);

        /** Called for each message with a colour that arrives, also if it has no effect. */
        default void colourReceived(int robotIndex, int colour) {}

        /**
         * Called after {@link #colourReceived} if the message belongs to a state that has already ended; it is ignored.
         */
        default void colourTooLate(int robotIndex, int colour) {}
    }

    private final Mode mode;
    private final LeasedRobots robots;
    private final SubsumptionTable table;
    private final StateListener listener;
    private final Deferred<@Nullable Void> failure = new Deferred<>();
    private State state;
    private @Nullable Integer seenBy;
    private int changes; // a message that was sent under another number belongs to an earlier state

    /** @param mode promise or callback */
    public Arbitrator(Mode mode, LeasedRobots robots, SubsumptionTable table, StateListener listener) {
        if (mode == Mode.SYNC) {
            throw new IllegalArgumentException("the mode is " + mode + ", expected callback or promise");
        }
        this.mode = mode;
        this.robots = robots;
        this.table = table;
        this.listener = listener;
        this.state = table.first();
    }

    /** Starts the services of the current state. */
    public void live() {
        listener.stateStarted(state, seenBy);
        for (int robot = 0; robot < table.robots(); robot++) {
            startService(robot);
        }
    }

    /** Returns a promise that is rejected when a service fails, and never fulfilled. */
    public Promise<@Nullable Void> failure() {
        return failure;
    }

    @Override
    protected void stopped() {
        stopServices().exceptionally(ended -> null); // a service that cannot be called has ended with its space
    }

    private Promise<?> stopServices() {
        return Promise.all(
                IntStream.range(0, table.robots()).mapToObj(robots::stop).toList());
    }

    private void startService(int robot) {
        String service = state.services().get(robot).name();
        if (mode == Mode.PROMISE) {
            driveUntilColour(robot, service);
        } else {
            driveWithReports(robot, service);
        }
    }

    private void driveUntilColour(int robot, String service) {
        int changesBefore = changes;
        robots.drive(robot, service, state.colour())
                .thenAccept(seen -> seen.filter(colour -> isInTime(robot, colour, changesBefore))
                        .ifPresent(colour -> table.next(state, colour)
                                .ifPresentOrElse(next -> changeState(next, robot), () -> startService(robot))))
                .exceptionally(error -> {
                    failure.reject(error);
                    return null;
                });
    }

    private void driveWithReports(int robot, String service) {
        int changesBefore = changes;
        robots.report(robot, service, report -> {
                    if (isInTime(robot, report.colour(), changesBefore)) {
                        table.next(state, report.colour(), report.secondsInCharge())
                                .ifPresent(next -> changeState(next, robot));
                    }
                })
                .onSettled((end, error) -> {
                    serviceEnded(robot, service, changesBefore, error);
                });
    }

    private boolean isInTime(int robot, int colour, int changesBefore) {
        listener.colourReceived(robot, colour);
        if (changes == changesBefore) {
            return true;
        }
        listener.colourTooLate(robot, colour); // a colour was seen in the same reading, and the switch is under way
        return false;
    }

    private void changeState(State next, int robot) {
        state = next;
        changes++;
        seenBy = robot;
        stopServices().thenRun(() -> ((Arbitrator) self()).live());
    }

    private void serviceEnded(int robot, String service, int changesBefore, @Nullable Throwable error) {
        if (error != null) {
            failure.reject(error);
        } else if (changes == changesBefore) {
            failure.reject(new IllegalStateException("robot " + (robot + 1) + ": " + service + " has ended in state "
                    + state.number() + " without having been stopped"));
        }
    }
}
