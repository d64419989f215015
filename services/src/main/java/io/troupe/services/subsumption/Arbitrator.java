package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * Decides which service drives which robot, by the colours that the robots see: the paper's main code in promise mode.
 *
 * <p><b>Role.</b> An actor: spawn it and send {@link #live} once. After each switch it sends {@link #live} to itself.
 *
 * <p><b>Order.</b> A switch takes these steps. The wanderer that has seen a colour ends itself and fulfils its promise.
 * The arbitrator stops all other services. When all of them have stopped, the services of the next state start. All
 * steps happen between two readings, so every robot always has exactly one service. If two robots see colours in the
 * same reading, the promise that is fulfilled first counts (the robot with the lower index).
 *
 * <p><b>Errors.</b> When a service's promise is rejected, {@link #failure} is rejected with the same error. When this
 * actor is stopped, its services stop at their next reading.
 *
 * <p><b>Source.</b> Paper, section 3.6, Figure 20.
 */
public class Arbitrator extends Actor {
    /** Notified of every state that starts. Called on the actor space's thread. */
    @FunctionalInterface
    public interface StateListener {
        /**
         * Called when a state starts, before its services do.
         *
         * @param seenBy index of the robot that saw the state's colour; null for the first state
         */
        void stateStarted(State state, @Nullable Integer seenBy);

        /** Called for each message with a colour that arrives, also if it has no effect. */
        default void colourReceived(int robot, int colour) {}

        /**
         * Called after {@link #colourReceived} if the message belongs to a state that has already ended; it is ignored.
         */
        default void colourTooLate(int robot, int colour) {}
    }

    private final RobotServices services;
    private final SubsumptionTable table;
    private final StateListener listener;
    private final CurrentState current;

    public Arbitrator(RobotServices services, SubsumptionTable table, StateListener listener) {
        this.services = services;
        this.table = table;
        this.listener = listener;
        this.current = new CurrentState(services, table.first(), listener);
    }

    /** Starts the services of the current state. */
    public void live() {
        current.notifyStarted();
        for (int robot = 0; robot < current.state().services().size(); robot++) {
            startService(robot);
        }
    }

    /** Returns a promise that is rejected when a service fails, and never fulfilled. */
    public Promise<@Nullable Void> failure() {
        return current.failure();
    }

    @Override
    protected void stopped() {
        current.clearReferences();
    }

    private void startService(int robot) {
        int changesBefore = current.changes();
        Service service = current.service(robot);
        ColourRule rule = service.findsColours() ? table.ruleIn(current.state()) : ColourRule.NONE;
        Promise<?> end = services.serve(
                        robot, service, current.newRunReference(robot), CurrentState.newFinderReference(service), rule)
                .thenAccept(colour -> colour.ifPresent(each -> onColour(robot, each, changesBefore)));
        end.exceptionally(error -> {
            current.fail(error);
            return null;
        });
    }

    private void onColour(int robot, int colour, int changesBefore) {
        listener.colourReceived(robot, colour);
        if (current.changes() == changesBefore) {
            changeState(robot, colour);
        } else { // another robot saw a colour in the same reading, and the switch is under way
            listener.colourTooLate(robot, colour);
        }
    }

    /**
     * Handles the first colour that a robot sees in a state. A colour that leads to another state ends the current one;
     * otherwise the robot's service is started again.
     */
    private void changeState(int robot, int colour) {
        table.next(current.state(), colour)
                .ifPresentOrElse(
                        next -> current.changeTo(next, robot).thenRun(() -> ((Arbitrator) self()).live()),
                        () -> startService(robot));
    }
}
