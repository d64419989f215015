package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * Decides which service drives which robot, by the colours that the robots see: the paper's main code in promise mode.
 *
 * <p><b>Role.</b> Spawn it, and send {@link #live} once; it calls itself from then on.
 *
 * <p><b>Order.</b> A switch: the wanderer that has seen a colour has ended itself; all other services are told to stop;
 * when all of them have stopped, the services of the next state begin. That all happens between two readings, so every
 * robot always has exactly one service. If two robots see colours at once, the first promise to be fulfilled counts
 * (the robot with the lower index).
 *
 * <p><b>Errors.</b> What rejects a service's promise rejects {@link #ended}. If this actor is stopped, its services
 * stop at their next reading.
 *
 * <p><b>Source.</b> Paper, section 3.6, Figure 20.
 */
public class Arbitrator extends Actor {
    /** Is told of every state that begins. Called on the actor space's thread. */
    @FunctionalInterface
    public interface StateListener {
        /**
         * A state begins.
         *
         * @param seenBy index of the robot that saw its colour; null for the first state
         */
        void began(State state, @Nullable Integer seenBy);

        /** A message with a colour has arrived, whatever comes of it. */
        default void colourReceived(int robot, int colour) {}

        /** The same message, just received, is about a state that has ended already, and is ignored. */
        default void colourTooLate(int robot, int colour) {}
    }

    private final RobotServices services;
    private final SubsumptionTable table;
    private final StateListener listener;
    private final PresentState present;

    public Arbitrator(RobotServices services, SubsumptionTable table, StateListener listener) {
        this.services = services;
        this.table = table;
        this.listener = listener;
        this.present = new PresentState(services, table.first(), listener);
    }

    /** Puts the services of the present state in charge. */
    public void live() {
        present.begins();
        for (int robot = 0; robot < present.state().services().size(); robot++) {
            begin(robot);
        }
    }

    /** Rejected when a service fails; never fulfilled. */
    public Promise<@Nullable Void> ended() {
        return present.failed();
    }

    @Override
    protected void stopped() {
        present.abandon();
    }

    private void begin(int robot) {
        int changesBefore = present.changes();
        Service service = present.service(robot);
        ColourRule rule = service.findsColours() ? table.ruleIn(present.state()) : ColourRule.NONE;
        Promise<?> end = services.serve(
                        robot, service, present.newReference(robot), PresentState.newColourFinder(service), rule)
                .thenAccept(colour -> colour.ifPresent(each -> received(robot, each, changesBefore)));
        end.exceptionally(error -> {
            present.fail(error);
            return null;
        });
    }

    private void received(int robot, int colour, int changesBefore) {
        listener.colourReceived(robot, colour);
        if (present.changes() == changesBefore) {
            seen(robot, colour);
        } else { // the switch is under way: this one saw something at the same time
            listener.colourTooLate(robot, colour);
        }
    }

    /**
     * A robot has seen a colour: the first one to do so in a state ends it. One that leads nowhere leaves the robot its
     * service.
     */
    private void seen(int robot, int colour) {
        table.next(present.state(), colour)
                .ifPresentOrElse(
                        next -> present.change(next, robot).thenRun(() -> ((Arbitrator) self()).live()),
                        () -> begin(robot));
    }
}
