package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.ColourFinder;
import java.lang.System.Logger.Level;
import java.util.OptionalInt;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.BiFunction;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The actor as a service: offers wall following, space wandering, and whatever else a table names, to other actors.
 *
 * <p><b>Role.</b> Spawn it, and call it through its proxy. It connects to a robot when it is first asked to drive it
 * and keeps the connection until that fails, unless it is to reconnect: then the robot stands from the end of one
 * service until the first reading of the next, a tick in lock step.
 *
 * <p><b>Order.</b> A robot never has two services: one that is called while another is about to stop begins when that
 * has stopped.
 *
 * <p><b>Units and shapes.</b> Robots by Player index, from 0. A reference is 1 = run, 0 = stop, 2 = stopped and zero
 * speed sent; whoever calls a service sets it to 1 before and to 0 to end it.
 *
 * <p><b>Errors.</b> A robot that does not exist, or whose service was not told to stop, rejects the promise; so does a
 * server that goes away. The next service connects anew.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6, Figures 17 and 20.
 */
public class RobotServices extends Actor {
    /**
     * Where the robots are, and what they are to do.
     *
     * @param table the services and colours in play
     * @param reconnects whether every service makes a connection of its own with its robot and closes it when it ends,
     *     instead of one for all
     */
    public record Settings(
            String host, int port, SubsumptionTable table, ServiceObserver observer, boolean reconnects) {
        /** With one connection for all services of a robot. */
        public Settings(String host, int port, SubsumptionTable table, ServiceObserver observer) {
            this(host, port, table, observer, false);
        }

        /** The paper's: its table, the default port on this machine. */
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

        /** The same with a connection for each service, as the paper has it (section 3.5). */
        public Settings withReconnection(boolean newReconnects) {
            return new Settings(host, port, table, observer, newReconnects);
        }
    }

    private static final System.Logger LOG = System.getLogger(RobotServices.class.getName());

    private final Settings settings;
    private @Nullable Charges charges;

    public RobotServices(Settings settings) {
        this.settings = settings;
    }

    /**
     * Lets a robot follow the wall on its left until the reference is cleared.
     *
     * @return fulfilled when it has stopped
     */
    public Promise<@Nullable Void> wallFollower(int robot, AtomicReference<Integer> reference) {
        var service = settings.table().service(Service.WALL_FOLLOWER.name()).orElse(Service.WALL_FOLLOWER);
        return begin(robot, service, reference, ServiceCycle.Finder.LOOKS_AWAY);
    }

    /**
     * Lets a robot wander until it sees a colour that ends the state by the table, its priorities and its hold time, or
     * the reference is cleared.
     *
     * @param colourFinder 1 = look for colours meanwhile; 2 when it has stopped
     * @param stateColour the colour of the present state
     * @return the colour seen; the state's own if the robot was stopped before it saw another
     */
    public Promise<Integer> spaceWanderer(
            int robot, AtomicReference<Integer> reference, AtomicReference<Integer> colourFinder, int stateColour) {
        var table = settings.table();
        ColourRule rule = table.state(stateColour).map(table::ruleIn).orElseGet(() -> anyOf(table));
        return serve(robot, Service.SPACE_WANDERER, reference, colourFinder, rule)
                .thenApply(seen -> seen.orElse(stateColour));
    }

    /** For a state that is not in the table: each of its colours leads somewhere else, at once. */
    private static ColourRule anyOf(SubsumptionTable table) {
        return (blobs, seconds) -> ColourFinder.inOrder(blobs, table::priority)
                .filter(colour -> table.state(colour).isPresent())
                .findFirst();
    }

    /**
     * Lets any service drive a robot, until its colour finder sees a colour that ends the state, or the reference is
     * cleared.
     *
     * @param colourFinder 1 = look for colours meanwhile; 2 when it has stopped
     * @return the colour seen, once; empty if the robot was stopped before it saw one
     */
    public Promise<OptionalInt> serve(
            int robot,
            Service service,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder,
            ColourRule rule) {
        var seen = new OptionalInt[] {OptionalInt.empty()};
        return begin(robot, service, reference, (devices, secondsInCharge) -> {
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
     * Lets a robot wander until the reference is cleared, and sends every colour that it sees meanwhile, whatever it
     * means, but not black, unless a state of the table has it.
     *
     * @param colours is sent each colour at every reading, as a message of its own, and the end
     * @param colourFinder 1 = look for colours meanwhile; 2 when it has stopped
     */
    public void spaceWanderer(
            Callback<Integer> colours,
            int robot,
            AtomicReference<Integer> reference,
            AtomicReference<Integer> colourFinder) {
        report(colours, (colour, secondsInCharge) -> colour, robot, Service.SPACE_WANDERER, reference, colourFinder);
    }

    /**
     * Lets any service drive a robot until the reference is cleared, and sends every colour that it sees meanwhile,
     * whatever it means, but not black, unless a state of the table has it.
     *
     * @param reports is sent each colour at every reading, as a message of its own, those of higher priority first and
     *     of equal ones the largest; and the end. When nobody listens to it any more the service ends: a robot is not
     *     driven on with nobody to stop it.
     * @param colourFinder 1 = look for colours meanwhile; 2 when it has stopped
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
            end = begin(robot, service, reference, finder);
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
     * Each once, though there may be several patches of it. Black is walls everywhere, but a table may give it a state.
     */
    private IntStream coloursToSend(RobotDevices devices) {
        var table = settings.table();
        return ColourFinder.inOrder(devices.blobs(), table::priority)
                .filter(colour -> colour != Colours.BLACK || table.state(colour).isPresent())
                .distinct();
    }

    /**
     * Clears a reference and makes its service notice at once, instead of at the next reading.
     *
     * @return fulfilled when the service has stopped; at once if none runs with that reference
     */
    public Promise<@Nullable Void> stop(AtomicReference<Integer> reference) {
        reference.compareAndSet(ServiceLoop.RUN, ServiceLoop.STOP);
        return charges == null ? Promise.done() : charges.stop(reference);
    }

    @Override
    protected void stopped() {
        if (charges != null) {
            charges.close();
        }
    }

    private Promise<@Nullable Void> begin(
            int robot, Service service, AtomicReference<Integer> reference, ServiceCycle.Finder finder) {
        if (charges == null) {
            charges = new Charges(settings, space());
        }
        return charges.begin(robot, service, reference, finder);
    }
}
