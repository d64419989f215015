package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The robot services on a Player server: wall following, space wandering, and all other services of a table.
 *
 * <p><b>Role.</b> Spawn it as {@link RobotServices}, or publish it at a broker. It connects to a robot when the first
 * service for that robot starts. It keeps the connection until it fails. With {@link Settings#reconnects} each service
 * has a separate connection; then the robot stands still from the end of one service until the first reading of the
 * next, which is one tick in lock step.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6.
 */
public sealed class RobotServicesActor extends Actor implements RobotServices permits LeasedServicesActor {
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
            return new Settings("localhost", 6665, SubsumptionTable.ofThePaper(), ServiceObserver.none());
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

    private static final System.Logger LOG = System.getLogger(RobotServicesActor.class.getName());

    private final SubsumptionTable table;
    private final ServiceObserver observer;
    private final RobotConnections connections;
    private final Map<Integer, RunningService> running = new HashMap<>(); // by robot
    private final Map<Integer, Integer> stops = new HashMap<>(); // by robot: how often it was stopped

    public RobotServicesActor(Settings settings) {
        this(settings, DriverLimits.SILENCE_LIMIT);
    }

    /** @param silenceLimit a server that is silent for so long has gone */
    RobotServicesActor(Settings settings, Duration silenceLimit) {
        this.table = settings.table();
        this.observer = settings.observer();
        this.connections = new RobotConnections(settings, silenceLimit);
    }

    /**
     * Connects to all robots of the table.
     *
     * @throws PlayerException if one cannot be reached; then there is no connection
     */
    final void connectAll() {
        try {
            for (int robot = 0; robot < table.robots(); robot++) {
                connections.connect(robot);
            }
        } catch (PlayerException unreachable) {
            connections.closeAll();
            throw unreachable;
        }
    }

    /** Whether a speed may be sent to a robot now. */
    boolean mayCommand(int robot, Velocity velocity) {
        return true;
    }

    @Override
    public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
        Service named = named(table, service);
        ColourRule rule = named.findsColours() ? ruleIn(stateColour) : ColourRule.NONE;
        var seen = new ArrayList<Integer>(1);
        return start(robot, named, (devices, secondsInCharge) -> {
                    rule.pick(devices.blobs(), secondsInCharge).ifPresent(colour -> {
                        observer.colourSent(robot, colour);
                        seen.add(colour);
                    });
                    return seen.isEmpty();
                })
                .thenApply(stopped -> new ServiceEnd(seen.stream().findFirst()));
    }

    /** @throws IllegalArgumentException if no state of the table has the service */
    static Service named(SubsumptionTable table, String service) {
        return table.service(service)
                .orElseThrow(() -> new IllegalArgumentException("there is no service " + service + ", expected one of "
                        + table.services().stream().map(Service::name).collect(Collectors.joining(", "))));
    }

    private ColourRule ruleIn(int stateColour) {
        return table.state(stateColour)
                .map(table::ruleIn)
                .orElse((blobs, seconds) -> ColourFinder.inOrder(blobs, table::priority)
                        .filter(colour -> table.state(colour).isPresent())
                        .findFirst());
    }

    @Override
    public void drive(int robot, String service, Callback<ColourReport> reports) {
        Promise<@Nullable Void> end;
        try {
            end = driveWithReports(robot, service, reports);
        } catch (RuntimeException impossible) {
            end = Promise.failed(impossible);
        }
        end.handle((stopped, error) -> {
            if (error == null) {
                reports.finish();
            } else {
                reports.fail(error);
            }
            return null;
        });
    }

    /** The same without the end of the reports; settled when the service has stopped. */
    final Promise<@Nullable Void> driveWithReports(int robot, String service, Callback<ColourReport> reports) {
        Service named = named(table, service);
        return start(robot, named, (devices, secondsInCharge) -> {
            if (reports.isCancelled()) {
                LOG.log(Level.WARNING, "robot {0}: {1} stops, as it has no listener any more", robot + 1, named);
                return false;
            }
            if (named.findsColours()) {
                coloursToSend(devices).forEach(colour -> {
                    observer.colourSent(robot, colour);
                    reports.next(new ColourReport(robot, colour, secondsInCharge));
                });
            }
            return true;
        });
    }

    /** The colours to send, each once even if several blobs have it. */
    private IntStream coloursToSend(PlayerRobot robot) {
        return ColourFinder.inOrder(robot.blobs(), table::priority)
                .filter(colour ->
                        colour != NamedColours.BLACK || table.state(colour).isPresent())
                .distinct();
    }

    @Override
    public Promise<@Nullable Void> stop(int robot) {
        stops.merge(robot, 1, Integer::sum);
        RunningService service = running.get(robot);
        return service == null ? Promise.done() : service.stop();
    }

    @Override
    protected void stopped() {
        connections.closeAll();
    }

    /**
     * Starts a service for a robot, as soon as the robot's previous service has stopped. If the robot is stopped once
     * more before that, the new service does not start.
     *
     * @return settled when the new service has stopped, or will not start
     */
    private Promise<@Nullable Void> start(int robot, Service service, ServiceCycle.Finder finder) {
        RunningService previous = running.get(robot);
        if (previous == null) {
            return startNow(robot, service, finder);
        }
        if (previous.goesOn) {
            throw new IllegalStateException("robot " + (robot + 1) + " is in the charge of " + previous.cycle.service()
                    + " and was to get " + service + ": stop the first before");
        }
        int stopsBefore = stops(robot);
        return previous.ended
                .handle((stopped, error) -> null)
                .thenCompose(free ->
                        stops(robot) == stopsBefore ? start(robot, service, finder) : Promise.<@Nullable Void>done());
    }

    private int stops(int robot) {
        return stops.getOrDefault(robot, 0);
    }

    private Promise<@Nullable Void> startNow(int robot, Service service, ServiceCycle.Finder finder) {
        RobotConnection connection = connections.connect(robot);
        if (service.usesLaser()) {
            try {
                connection.robots().getFirst().useLaser(); // the table may give this service to other robots only
            } catch (PlayerException refused) {
                connections.serviceEnded(robot, true);
                throw refused;
            }
        }
        var started = new RunningService(service, connection, finder, !connections.takeReconnected(robot));
        running.put(robot, started);
        return started.ended.whenComplete((stopped, error) -> {
            running.remove(robot, started);
            connections.serviceEnded(robot, error instanceof PlayerException);
        });
    }

    /**
     * A running service: one cycle for each new reading, until it is stopped. A service that takes over runs its first
     * cycle on the newest reading at once, so that the robot neither stops nor keeps the old speed between two
     * services.
     */
    private final class RunningService {
        private final RobotConnection connection;
        private final PlayerRobot robot;
        private final ServiceCycle cycle;
        private final ServiceCycle.Finder finder;
        /** Settled when zero speed has been sent; no cycle follows. */
        private final Promise<@Nullable Void> ended;

        private boolean started;
        private boolean firstCycle = true;
        private boolean goesOn = true;

        /**
         * Starts the service.
         *
         * @param startsNow whether the service counts as started now, instead of from its first reading on
         */
        RunningService(Service service, RobotConnection connection, ServiceCycle.Finder finder, boolean startsNow) {
            this.connection = connection;
            this.robot = connection.robots().getFirst();
            this.cycle = new ServiceCycle(service, robot, this::command, observer);
            this.finder = finder;
            if (startsNow) {
                notifyStarted();
            }
            this.ended = context()
                    .space()
                    .repeatWhile(() -> goesOn, this::nextCycle)
                    .whenComplete((done, error) -> halt(error));
        }

        private void command(Velocity velocity) {
            if (mayCommand(robot.index(), velocity)) {
                observer.commanded(robot.index(), cycle.service(), velocity);
                robot.drive(velocity);
            }
        }

        /** Ends the service now instead of at the next reading. */
        Promise<@Nullable Void> stop() {
            goesOn = false;
            connection.wake();
            return ended;
        }

        private void notifyStarted() {
            started = true;
            observer.serviceStarted(robot.index(), cycle.service());
        }

        /**
         * Runs one cycle: at once when the service takes over, otherwise at the next reading. The first cycle drives,
         * but does not look for colours. Otherwise two robots that see each other's colours would switch at every
         * reading and stand still.
         */
        private Promise<?> nextCycle() {
            boolean takesOver = firstCycle && robot.hasData();
            firstCycle = false;
            if (takesOver) {
                cycle.run(ServiceCycle.Finder.NONE);
                return Promise.done();
            }
            return connection.nextData().thenAccept(this::react);
        }

        private void react(boolean dataAreReady) {
            if (dataAreReady && goesOn && robot.hasData() && cycle.isDue()) {
                boolean takesOver = !started;
                if (takesOver) {
                    notifyStarted();
                }
                boolean endsItself = !cycle.run(takesOver ? ServiceCycle.Finder.NONE : finder);
                if (endsItself) { // otherwise goesOn stays as it is: the cycle may have stopped the service
                    goesOn = false;
                }
            }
        }

        private void halt(@Nullable Throwable error) {
            goesOn = false;
            try {
                cycle.halt();
            } catch (RuntimeException unreachable) {
                if (error == null) {
                    throw unreachable;
                }
                error.addSuppressed(unreachable);
            } finally {
                if (started) {
                    observer.serviceEnded(robot.index(), cycle.service());
                }
            }
        }
    }

    /** The connections with the robots: one per robot, or one per service. */
    private final class RobotConnections {
        private final Settings settings;
        private final Duration silenceLimit;
        private final Map<Integer, RobotConnection> open = new TreeMap<>(); // by robot
        private final Set<Integer> reconnecting = new HashSet<>();
        private final List<RobotConnection> closing = new ArrayList<>();

        RobotConnections(Settings settings, Duration silenceLimit) {
            this.settings = settings;
            this.silenceLimit = silenceLimit;
        }

        /** Returns the connection with a robot; connects if there is none. */
        RobotConnection connect(int robot) {
            return open.computeIfAbsent(robot, index -> {
                var devices = new RobotConnection.Devices(index, true, table.usesLaser(index));
                var connection = RobotConnection.open(
                        settings.host(),
                        settings.port(),
                        RobotConnection.Delivery.PULL,
                        List.of(devices),
                        silenceLimit);
                connection.readOnSpace();
                return connection;
            });
        }

        /** Whether the robot's new connection replaces an earlier one; true at most once per connection. */
        boolean takeReconnected(int robot) {
            return reconnecting.remove(robot);
        }

        /**
         * Called when a robot's service has ended. If each service has a separate connection, or the connection has
         * failed, the connection is closed, but only when the space is idle and so after the next service has
         * connected. In lock step a server behind a socket does not wait for a client that has left; the world would
         * advance before the new connection exists. (A server in this JVM waits for the end of the turn.)
         */
        void serviceEnded(int robot, boolean connectionFailed) {
            RobotConnection ended = connectionFailed || settings.reconnects() ? open.remove(robot) : null;
            if (ended != null) { // also null if all connections are closed already
                reconnecting.add(robot);
                closing.add(ended);
                context().space().onIdle(this::closePending);
            }
        }

        void closeAll() {
            closing.addAll(open.values());
            open.clear();
            closePending();
        }

        private void closePending() {
            closing.forEach(RobotConnection::close);
            closing.clear();
        }
    }
}
