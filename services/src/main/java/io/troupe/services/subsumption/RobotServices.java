package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.common.text.NamedColours;
import io.troupe.services.behaviour.ColourFinder;
import java.lang.System.Logger.Level;
import java.util.OptionalInt;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.BiFunction;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The robot services as an actor: wall following, space wandering, and all other services of a table.
 *
 * <p><b>Role.</b> Spawn it, and call it through its proxy. It connects to a robot when the first service for that robot
 * starts. It keeps the connection until it fails. With {@link Settings#reconnects} each service has a separate
 * connection; then the robot stands still from the end of one service until the first reading of the next, which is one
 * tick in lock step.
 *
 * <p><b>Order.</b> A robot never has two services: a service that is called while the previous one is stopping starts
 * when that one has stopped.
 *
 * <p><b>Units and shapes.</b> Robots by Player index, from 0. A reference is 1 = run, 0 = stop, 2 = stopped and zero
 * speed sent. The caller sets it to 1 before it calls a service, and to 0 to end the service.
 *
 * <p><b>Errors.</b> The promise is rejected if the robot does not exist, if the robot's previous service is still set
 * to run, and if the server disconnects. The next service connects again.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6, Figures 17 and 20.
 */
public class RobotServices extends Actor {
    /**
     * Where the robots are, and which table they use.
     *
     * @param table the services and colours
     * @param reconnects whether each service connects to its robot anew and closes that connection when it ends;
     *     otherwise one connection per robot serves all
     */
    public record Settings(
            String host, int port, SubsumptionTable table, ServiceObserver observer, boolean reconnects) {
        /** Creates settings with one connection per robot. */
        public Settings(String host, int port, SubsumptionTable table, ServiceObserver observer) {
            this(host, port, table, observer, false);
        }

        /** The paper's settings: its table, and the default port on this machine. */
        public static Settings ofThePaper() {
            return new Settings("localhost", 6665, SubsumptionTable.ofThePaper(), ServiceObserver.NONE);
        }

        public Settings withObserver(ServiceObserver newObserver) {
            return new Settings(host, port, table, newObserver, reconnects);
        }

        public Settings withPort(int newPort) {
            return new Settings(host, newPort, table, observer, reconnects);
        }

        public Settings withTable(SubsumptionTable newTable) {
            return new Settings(host, port, newTable, observer, reconnects);
        }

        /** Returns settings with or without a separate connection for each service (paper, section 3.5). */
        public Settings withReconnection(boolean newReconnects) {
            return new Settings(host, port, table, observer, newReconnects);
        }
    }

    private static final System.Logger LOG = System.getLogger(RobotServices.class.getName());

    private final Settings settings;
    private @Nullable RunningServices running;

    public RobotServices(Settings settings) {
        this.settings = settings;
    }

    /**
     * Makes a robot follow the wall on its left until the reference is cleared.
     *
     * @return fulfilled when the service has stopped
     */
    public Promise<@Nullable Void> wallFollower(int robot, AtomicReference<Integer> reference) {
        var service = settings.table().service(Service.WALL_FOLLOWER.name()).orElse(Service.WALL_FOLLOWER);
        return start(robot, service, reference, ServiceCycle.Finder.NONE);
    }

    /**
     * Makes a robot wander until it sees a colour that ends the state by the table, its priorities and its hold time,
     * or until the reference is cleared.
     *
     * @param colourFinder 1 = look for colours; set to 2 when the service has stopped
     * @param stateColour the colour of the current state
     * @return the colour seen; the state's own colour if the robot was stopped before it saw another
     */
    public Promise<Integer> spaceWanderer(
            int robot, AtomicReference<Integer> reference, AtomicReference<Integer> colourFinder, int stateColour) {
        var table = settings.table();
        ColourRule rule = table.state(stateColour).map(table::ruleIn).orElseGet(() -> anyOf(table));
        return serve(robot, Service.SPACE_WANDERER, reference, colourFinder, rule)
                .thenApply(seen -> seen.orElse(stateColour));
    }

    /** The rule for a state that is not in the table: every colour that has a state ends it at once. */
    private static ColourRule anyOf(SubsumptionTable table) {
        return (blobs, seconds) -> ColourFinder.inOrder(blobs, table::priority)
                .filter(colour -> table.state(colour).isPresent())
                .findFirst();
    }

    /**
     * Runs a service on a robot until its colour finder sees a colour that ends the state, or until the reference is
     * cleared.
     *
     * @param colourFinder 1 = look for colours; set to 2 when the service has stopped
     * @return the colour seen; empty if the robot was stopped before it saw one
     */
    public Promise<OptionalInt> serve(
            int robot,
            Service service,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder,
            ColourRule rule) {
        var seen = new OptionalInt[] {OptionalInt.empty()};
        return start(robot, service, reference, (devices, secondsInCharge) -> {
                    if (colourFinder.get() == ServiceLoop.RUN) {
                        seen[0] = rule.pick(devices.blobs(), secondsInCharge);
                        seen[0].ifPresent(colour -> {
                            settings.observer().colourSent(robot, colour);
                            reference.set(ServiceLoop.STOP);
                        });
                    }
                })
                .whenComplete((stopped, error) -> colourFinder.set(ServiceLoop.STOPPED))
                .thenApply(stopped -> seen[0]);
    }

    /**
     * Makes a robot wander until the reference is cleared, and sends every colour that it sees, also those that lead to
     * no state. Black is not sent unless a state of the table has it.
     *
     * @param colours receives each colour at every reading, as a separate message, and the end
     * @param colourFinder 1 = look for colours; set to 2 when the service has stopped
     */
    public void spaceWanderer(
            Callback<Integer> colours,
            int robot,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder) {
        report(colours, (colour, secondsInCharge) -> colour, robot, Service.SPACE_WANDERER, reference, colourFinder);
    }

    /**
     * Runs a service on a robot until the reference is cleared, and sends every colour that the robot sees, also those
     * that lead to no state. Black is not sent unless a state of the table has it.
     *
     * @param reports receives each colour at every reading, as a separate message, in descending order of priority and
     *     then of blob area, and the end. If this callback is cancelled the service stops: a robot must not keep
     *     driving without an arbitrator that could stop it.
     * @param colourFinder 1 = look for colours; set to 2 when the service has stopped
     */
    public void serve(
            Callback<ColourReport> reports,
            int robot,
            Service service,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder) {
        report(
                reports,
                (colour, secondsInCharge) -> new ColourReport(robot, colour, secondsInCharge),
                robot,
                service,
                reference,
                colourFinder);
    }

    private <T> void report(
            Callback<T> reports,
            BiFunction<Integer, Double, T> message,
            int robot,
            Service service,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder) {
        ServiceCycle.Finder finder = (devices, secondsInCharge) -> {
            if (reports.isCancelled()) {
                LOG.log(Level.WARNING, "robot {0}: {1} stops, as nobody listens to it any more", robot + 1, service);
                reference.set(ServiceLoop.STOP);
            } else if (colourFinder.get() == ServiceLoop.RUN) {
                coloursToSend(devices).forEach(colour -> {
                    settings.observer().colourSent(robot, colour);
                    reports.next(message.apply(colour, secondsInCharge));
                });
            }
        };
        Promise<@Nullable Void> end;
        try {
            end = start(robot, service, reference, finder);
        } catch (RuntimeException impossible) {
            end = Promise.failed(impossible);
        }
        end.handle((stopped, error) -> {
            colourFinder.set(ServiceLoop.STOPPED);
            if (error == null) {
                reports.finish();
            } else {
                reports.fail(error);
            }
            return null;
        });
    }

    /**
     * The colours to send, each once even if several blobs have it. Black is the colour of all walls, so it is sent
     * only if the table has a state for it.
     */
    private IntStream coloursToSend(PlayerDevices devices) {
        var table = settings.table();
        return ColourFinder.inOrder(devices.blobs(), table::priority)
                .filter(colour ->
                        colour != NamedColours.BLACK || table.state(colour).isPresent())
                .distinct();
    }

    /**
     * Clears a reference and wakes its service, so that the service stops at once instead of at the next reading.
     *
     * @return fulfilled when the service has stopped; at once if no service runs with that reference
     */
    public Promise<@Nullable Void> stop(AtomicReference<Integer> reference) {
        reference.compareAndSet(ServiceLoop.RUN, ServiceLoop.STOP);
        return running == null ? Promise.done() : running.stop(reference);
    }

    @Override
    protected void stopped() {
        if (running != null) {
            running.close();
        }
    }

    private Promise<@Nullable Void> start(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        if (running == null) {
            running = new RunningServices(settings, space());
        }
        return running.startAfterPrevious(robot, service, reference, finder);
    }
}
