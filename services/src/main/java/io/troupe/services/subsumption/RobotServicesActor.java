package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.common.text.NamedColours;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.robot.DriverLimits;
import io.troupe.services.robot.PlayerRobot;
import io.troupe.services.robot.RobotConnection;
import java.lang.System.Logger.Level;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * The robot services on a Player server: wall following, space wandering, and all other services of a table.
 *
 * <p><b>Role.</b> Spawn it as {@link RobotServices}, or publish it at a broker. It connects to a robot when the first
 * service for that robot starts. It keeps the connection until it fails. With {@link Settings#withReconnection} each
 * service has a separate connection; then the robot stands still from the end of one service until the first reading of
 * the next, which is one tick in lock step.
 *
 * <p>{@link RobotNode} publishes it for callers on other hosts: there a service drives a robot only while its caller
 * renews a lease, so no robot has two drivers, and none goes on when its arbitrator is gone.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6.
 */
public final class RobotServicesActor extends Actor implements RobotServices {
    /** Where the robots are, and which table they use. */
    public static final class Settings extends io.troupe.actor.Settings<Settings> {
        private static final Settings DEFAULTS = new Settings();

        private String host = "localhost";
        private int port = 6665;
        private SubsumptionTable table = SubsumptionTable.ofThePaper();
        private ServiceObserver observer = ServiceObserver.none();
        private boolean reconnects;

        private Settings() {}

        /** The paper's table, the default port on this machine, one connection per robot, no observer. */
        public static Settings defaults() {
            return DEFAULTS;
        }

        @Override
        protected void check() {} // a server that is not there is an error of the connection

        /** Where the robots are, with the port: this machine, or that of a Player server. */
        public Settings withHost(String newHost) {
            Objects.requireNonNull(newHost, "host");
            return with(copy -> copy.host = newHost);
        }

        /** The port of a world in this JVM or of a Player server. */
        public Settings withPort(int newPort) {
            return with(copy -> copy.port = newPort);
        }

        /** The services and colours. */
        public Settings withTable(SubsumptionTable newTable) {
            Objects.requireNonNull(newTable, "table");
            return with(copy -> copy.table = newTable);
        }

        /** Is notified of what the services do. */
        public Settings withObserver(ServiceObserver newObserver) {
            Objects.requireNonNull(newObserver, "observer");
            return with(copy -> copy.observer = newObserver);
        }

        /**
         * Whether each service connects to its robot anew and closes that connection when it ends (paper, section 3.5);
         * otherwise one connection per robot serves all.
         */
        public Settings withReconnection(boolean newReconnects) {
            return with(copy -> copy.reconnects = newReconnects);
        }

        public String host() {
            return host;
        }

        public int port() {
            return port;
        }

        public SubsumptionTable table() {
            return table;
        }

        public ServiceObserver observer() {
            return observer;
        }

        public boolean reconnects() {
            return reconnects;
        }
    }

    /**
     * Whom a provider drives for.
     *
     * @param leasesEnd whether leases end: over hosts, where the caller may be gone or cut off
     * @param offered the names of the services that are offered
     * @param silenceLimit a server that is silent for so long has gone
     */
    private record Terms(boolean leasesEnd, Set<String> offered, Duration silenceLimit) {}

    /** Over hosts another provider may still reach the server. */
    private static final Duration HOSTS_SILENCE_LIMIT = Duration.ofSeconds(2);

    private static final System.Logger LOG = System.getLogger(RobotServicesActor.class.getName());
    private static final Duration LAST_ANSWERS = Duration.ofMillis(1);

    private final SubsumptionTable table;
    private final ServiceObserver observer;
    private final Terms terms;
    private final RobotConnections connections;
    private final long incarnation = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
    private final Map<Integer, Drive> drives = new HashMap<>(); // by robot; the last one
    private boolean leaving;

    /** Creates the services for callers in this process: their leases are never over. */
    public RobotServicesActor(Settings settings) {
        this(settings, new Terms(false, names(settings.table()), DriverLimits.SILENCE_LIMIT));
    }

    private RobotServicesActor(Settings settings, Terms terms) {
        this.table = settings.table();
        this.observer = settings.observer();
        this.terms = terms;
        this.connections = new RobotConnections(settings, terms.silenceLimit());
    }

    /**
     * Creates the services for callers on other hosts. They connect to all robots of the table now, and stop when they
     * have lost them, so that another provider takes over. On the space of the actor.
     *
     * @param offered names of services of the table
     * @throws PlayerException if a robot cannot be reached
     */
    static RobotServicesActor forHosts(Settings settings, Set<String> offered) {
        var actor = new RobotServicesActor(settings, new Terms(true, offered, HOSTS_SILENCE_LIMIT));
        actor.connections.connectAll();
        return actor;
    }

    private static Set<String> names(SubsumptionTable table) {
        return table.services().stream().map(Service::name).collect(Collectors.toCollection(LinkedHashSet::new));
    }

    /** @throws IllegalArgumentException if no state of the table has the service */
    static Service named(SubsumptionTable table, String service) {
        return table.service(service)
                .orElseThrow(() -> new IllegalArgumentException(
                        "there is no service " + service + ", expected one of " + String.join(", ", names(table))));
    }

    @Override
    protected void stopped() {
        connections.closeAll();
    }

    // ---- calls

    @Override
    public Promise<Stamp> stamp() {
        checkReachable();
        return Promise.of(now());
    }

    @Override
    public Promise<ServiceEnd> drive(Lease lease, int robot, String service, int stateColour) {
        var drive = new Drive(lease, robot, offered(service));
        ColourRule rule = drive.service.findsColours() ? ruleIn(stateColour) : ColourRule.NONE;
        return begin(drive, (devices, secondsInCharge) -> {
            rule.pick(devices.blobs(), secondsInCharge).ifPresent(colour -> {
                observer.colourSent(robot, colour);
                drive.seen = Optional.of(colour);
            });
            return drive.seen.isEmpty();
        });
    }

    private ColourRule ruleIn(int stateColour) {
        return table.state(stateColour)
                .map(table::ruleIn)
                .orElse((blobs, seconds) -> ColourFinder.inOrder(blobs, table::priority)
                        .filter(colour -> table.state(colour).isPresent())
                        .findFirst());
    }

    @Override
    public Promise<ServiceEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
        Promise<ServiceEnd> ended;
        try {
            ended = begin(new Drive(lease, robot, offered(service)), reporter(robot, service, reports));
        } catch (RuntimeException refused) {
            reports.finish(); // the error is that of the call
            throw refused;
        }
        return ended.whenComplete((end, error) -> reports.finish());
    }

    private ServiceCycle.Finder reporter(int robot, String service, Callback<ColourReport> reports) {
        boolean findsColours = offered(service).findsColours();
        return (devices, secondsInCharge) -> {
            if (reports.isCancelled()) {
                LOG.log(Level.WARNING, "robot {0}: {1} stops, as it has no listener any more", robot + 1, service);
                return false;
            }
            if (findsColours) {
                coloursToSend(devices).forEach(colour -> {
                    observer.colourSent(robot, colour);
                    reports.next(new ColourReport(robot, colour, secondsInCharge));
                });
            }
            return true;
        };
    }

    /** The colours to send, each once even if several blobs have it. */
    private IntStream coloursToSend(PlayerRobot robot) {
        return ColourFinder.inOrder(robot.blobs(), table::priority)
                .filter(colour ->
                        colour != NamedColours.BLACK || table.state(colour).isPresent())
                .distinct();
    }

    @Override
    public Promise<Renewal> renew(Lease lease, int robot) {
        Drive drive = drives.get(robot);
        boolean held = drive != null && drive.lease.isSame(lease);
        if (held) {
            drive.renew(lease);
        }
        return Promise.of(new Renewal(now(), held));
    }

    @Override
    public Promise<@Nullable Void> stop(Lease lease, int robot) {
        Drive drive = drives.get(robot);
        return drive != null && drive.lease.isSame(lease) ? drive.stop() : Promise.done();
    }

    /** Stops all services, and starts no more; their callers look for another provider at once. */
    Promise<?> leave() {
        leaving = true;
        return Promise.allSettled(
                List.copyOf(drives.values()).stream().map(Drive::lose).toList());
    }

    private void checkReachable() {
        if (leaving) {
            throw new PlayerException("the robots are not driven from here any more");
        }
    }

    private Service offered(String service) {
        Service named = named(table, service);
        if (!terms.offered().contains(service)) {
            throw new IllegalArgumentException("the service " + service + " is not offered here, expected one of "
                    + String.join(", ", terms.offered()));
        }
        return named;
    }

    private Stamp now() {
        return new Stamp(incarnation, nowNanos());
    }

    private long nowNanos() {
        return context().space().clock().nanos();
    }

    // ---- leases

    /** Starts a service by a lease, as soon as the robot's previous service has stopped. */
    private Promise<ServiceEnd> begin(Drive drive, ServiceCycle.Finder finder) {
        checkReachable();
        Drive before = drives.get(drive.robot);
        if (!drive.mayBegin() || (before != null && drive.isOlderThan(before))) {
            return Promise.of(ServiceEnd.LOST);
        }
        if (before != null) {
            before.giveWayTo(drive);
        }
        drives.put(drive.robot, drive);
        drive.watch();
        if (before == null) {
            drive.begin(finder);
        } else {
            before.ended.onSettled((stopped, error) -> {
                drive.begin(finder);
            });
        }
        return drive.ended.thenApply(ended -> new ServiceEnd(drive.seen, drive.lost));
    }

    /** A service that drives a robot by a lease, or waits until the robot's previous service has stopped. */
    private final class Drive {
        final Lease lease;
        final int robot;
        final Service service;
        Optional<Integer> seen = Optional.empty();

        /** Settled when zero speed has been sent, or the service will not start. */
        final Deferred<@Nullable Void> ended = new Deferred<>();

        private long overNanos; // unless leases never end
        private boolean goesOn = true;
        private boolean lost;
        private @Nullable RunningService running;

        Drive(Lease lease, int robot, Service service) {
            this.lease = lease;
            this.robot = robot;
            this.service = service;
            this.overNanos = overNanos(lease);
        }

        private static long overNanos(Lease lease) {
            return lease.stamp().nanos() + LEASE.toNanos();
        }

        /** Whether the lease was given by this provider, and is not over. */
        boolean mayBegin() {
            return !terms.leasesEnd() || (lease.stamp().provider() == incarnation && !isOver());
        }

        boolean isOlderThan(Drive other) {
            return lease.holder() == other.lease.holder() && lease.number() <= other.lease.number();
        }

        private boolean isOver() {
            return terms.leasesEnd() && nowNanos() - overNanos >= 0;
        }

        void renew(Lease renewed) {
            if (renewed.stamp().provider() == incarnation && !isOver() && overNanos(renewed) - overNanos > 0) {
                overNanos = overNanos(renewed);
            }
        }

        /** Ends the service when the lease is over. */
        void watch() {
            if (terms.leasesEnd()) {
                context().after(Duration.ofNanos(Math.max(0, overNanos - nowNanos())), () -> {
                    if (ended.isDone()) {
                        return;
                    }
                    if (isOver()) {
                        observer.leaseLost(robot, service);
                        lose();
                    } else {
                        watch();
                    }
                });
            }
        }

        void giveWayTo(Drive next) {
            if (lease.holder() != next.lease.holder() && !isOver()) {
                throw new PlayerException("robot " + (robot + 1) // the caller tries again
                        + " is driven for another arbitrator, whose lease is not over");
            }
            if (goesOn) {
                lose();
            }
        }

        Promise<@Nullable Void> lose() {
            lost = true;
            return stop();
        }

        /** Ends the service now instead of at the next reading. */
        Promise<@Nullable Void> stop() {
            goesOn = false;
            if (running != null) {
                running.connection.wake();
            }
            return ended;
        }

        void begin(ServiceCycle.Finder finder) {
            try {
                if (goesOn) {
                    drive(finder);
                } else {
                    hasEnded(null);
                }
            } catch (RuntimeException refused) {
                hasEnded(refused);
            }
        }

        private void drive(ServiceCycle.Finder finder) {
            RobotConnection connection = connections.connect(robot);
            if (service.usesLaser()) {
                connection.robots().getFirst().useLaser(); // the table may give this service to other robots only
            }
            running = new RunningService(this, connection, finder, !connections.takeReconnected(robot));
            running.run().onSettled((stopped, error) -> {
                hasEnded(error);
            });
        }

        private void hasEnded(@Nullable Throwable error) {
            drives.remove(robot, this);
            connections.serviceEnded(
                    robot, error instanceof PlayerException, context().space());
            if (error == null) {
                ended.resolve(null);
            } else {
                ended.reject(error);
            }
            if (terms.leasesEnd() && error instanceof PlayerException && !leaving) { // another one may reach them
                leave().onSettled((stopped, failed) -> context().after(LAST_ANSWERS, context()::stop));
            }
        }

        /** Sends a speed, if the lease allows it. */
        void command(PlayerRobot devices, Velocity velocity) {
            boolean mayHalt = velocity.equals(Velocity.STOP) && nowNanos() - overNanos < HALT.toNanos();
            if (!isOver() || mayHalt) {
                observer.commanded(robot, service, velocity);
                devices.drive(velocity);
            }
        }
    }

    // ---- driving

    /**
     * A running service: one cycle for each new reading, until it is stopped. A service that takes over runs its first
     * cycle on the newest reading at once, so that the robot neither stops nor keeps the old speed between two
     * services.
     */
    private final class RunningService {
        private final Drive drive;
        private final RobotConnection connection;
        private final PlayerRobot robot;
        private final ServiceCycle cycle;
        private final ServiceCycle.Finder finder;

        private boolean started;
        private boolean firstCycle = true;

        /**
         * Starts the service.
         *
         * @param startsNow whether the service counts as started now, instead of from its first reading on
         */
        RunningService(Drive drive, RobotConnection connection, ServiceCycle.Finder finder, boolean startsNow) {
            this.drive = drive;
            this.connection = connection;
            this.robot = connection.robots().getFirst();
            this.cycle = new ServiceCycle(drive.service, robot, velocity -> drive.command(robot, velocity), observer);
            this.finder = finder;
            if (startsNow) {
                notifyStarted();
            }
        }

        /** @return settled when zero speed has been sent; no cycle follows */
        Promise<@Nullable Void> run() {
            return context()
                    .space()
                    .repeatWhile(() -> drive.goesOn, this::nextCycle)
                    .whenComplete((done, error) -> halt(error));
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
            if (dataAreReady && drive.goesOn && robot.hasData() && cycle.isDue()) {
                boolean takesOver = !started;
                if (takesOver) {
                    notifyStarted();
                }
                boolean endsItself = !cycle.run(takesOver ? ServiceCycle.Finder.NONE : finder);
                if (endsItself) { // otherwise goesOn stays as it is: the cycle may have stopped the service
                    drive.goesOn = false;
                }
            }
        }

        private void halt(@Nullable Throwable error) {
            drive.goesOn = false;
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
}
