package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import org.jspecify.annotations.Nullable;

/**
 * Decides which service drives which robot, by the colours that the robots see: the paper's main code in callback mode.
 *
 * <p><b>Role.</b> An actor: spawn it and send {@link #live} once. After each switch it sends {@link #live} to itself.
 *
 * <p><b>Order.</b> A colour finder sends every colour that its robot sees, at every reading, while its service keeps
 * driving. The first colour that leads to another state ends the current one: the arbitrator stops all services, and
 * starts those of the next state when all have stopped. It waits for a promise where the paper has a busy loop. All
 * this happens between two readings, as in promise mode. Colours that arrive late, from services of an earlier state,
 * are counted and ignored.
 *
 * <p><b>Errors.</b> {@link #failure} is rejected when a service fails, or ends although it was not stopped. When this
 * actor is stopped, its services stop at their next reading.
 *
 * <p><b>Source.</b> Paper, section 3.5, Figure 17.
 */
public class CallbackArbitrator extends Actor {
    private final RobotServices services;
    private final SubsumptionTable table;
    private final Arbitrator.StateListener listener;
    private final CurrentState current;

    public CallbackArbitrator(RobotServices services, SubsumptionTable table, Arbitrator.StateListener listener) {
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
        var reports = new Callback.Stream<ColourReport>(
                report -> onColour(report, changesBefore), error -> serviceEnded(robot, service, changesBefore, error));
        services.serve(
                reports, robot, service, current.newRunReference(robot), CurrentState.newFinderReference(service));
    }

    private void onColour(ColourReport report, int changesBefore) {
        listener.colourReceived(report.robot(), report.colour());
        if (current.changes() == changesBefore) {
            table.next(current.state(), report.colour(), report.secondsInCharge())
                    .ifPresent(next -> changeState(next, report.robot()));
        } else {
            listener.colourTooLate(report.robot(), report.colour());
        }
    }

    private void changeState(State next, int robot) {
        current.changeTo(next, robot).thenRun(() -> ((CallbackArbitrator) self()).live());
    }

    private void serviceEnded(int robot, Service service, int changesBefore, @Nullable Throwable error) {
        if (error != null) {
            current.fail(error);
        } else if (current.changes() == changesBefore) {
            current.fail(new IllegalStateException("robot " + (robot + 1) + ": " + service + " has ended in state "
                    + current.state().number() + " though nothing told it to"));
        }
    }
}
