package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Clock;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorConnection;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.bus.BusPort;
import io.troupe.bus.internal.OwnName;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import java.util.function.Supplier;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Runs the services of a table on its robots, in one of the three modes, until closed: with services in this process,
 * or with the arbitrator alone, which finds them on other hosts.
 *
 * {@snippet :
 * try (var run = SubsumptionRun.overHosts(node, Mode.PROMISE, SubsumptionTable.ofThePaper(), listener)) {
 *     while (goesOn()) {
 *         run.check();
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> All work is done on one separate thread: an actor space's, or a plain thread in synchronous mode.
 * Observer and listener are called on it.
 *
 * <p><b>Order.</b> In one process all follows the robots' clock, so that a run can be repeated. Over hosts it is in
 * real time. There, too, a robot never has two drivers: each drives only while this process renews its lease, and
 * another one is called when the first has confirmed that it has stopped, or its lease is certainly over. The first one
 * is called 2.3 s after the start of this run at the earliest: then the leases of an earlier run are over.
 *
 * <p><b>Errors.</b> In one process an error of a service ends the run. Over hosts a service whose provider is gone is
 * continued by another provider, in the same state; {@link #overHosts} and {@link #check} throw a
 * {@link MissingServiceException} if a service of the table has no provider: after 2 s at the start, for 5 s later. If
 * this process is killed, frozen or cut off, the robots stop within 2.5 s.
 *
 * <p><b>Source.</b> Paper, sections 3.4 to 3.6.
 */
public final class SubsumptionRun implements AutoCloseable {
    /** What to run in this process. */
    public static final class Settings extends io.troupe.actor.Settings<Settings> {
        private static final Settings DEFAULTS = new Settings();

        private Mode mode = Mode.PROMISE;
        private RobotServicesActor.Settings robots = RobotServicesActor.Settings.defaults();
        private Clock clock = Clock.system();
        private Arbitrator.StateListener listener = (state, seenByIndex) -> {};
        private SynchronousRound round = SynchronousRound.ONE_SERVICE_A_READING;
        private @Nullable CallObserver callObserver;

        private Settings() {}

        /** Promise mode with the paper's robots on the machine's clock, the paper's synchronous round, no listener. */
        public static Settings defaults() {
            return DEFAULTS;
        }

        @Override
        protected void check() {
            if (mode == Mode.SYNC && robots.reconnects()) {
                throw new IllegalArgumentException("the mode is " + mode
                        + " and reconnects, expected callback or promise: the synchronous model connects once");
            }
        }

        /** One of the paper's three modes. */
        public Settings withMode(Mode newMode) {
            Objects.requireNonNull(newMode, "mode");
            return with(copy -> copy.mode = newMode);
        }

        /** Where the robots are; reconnection is not supported in synchronous mode, which connects once. */
        public Settings withRobots(RobotServicesActor.Settings newRobots) {
            Objects.requireNonNull(newRobots, "robots");
            return with(copy -> copy.robots = newRobots);
        }

        /** The robots' time. */
        public Settings withClock(Clock newClock) {
            Objects.requireNonNull(newClock, "clock");
            return with(copy -> copy.clock = newClock);
        }

        /** Is notified of every state that starts. */
        public Settings withListener(Arbitrator.StateListener newListener) {
            Objects.requireNonNull(newListener, "listener");
            return with(copy -> copy.listener = newListener);
        }

        /** What the synchronous mode does at a reading; ignored in the other modes. */
        public Settings withRound(SynchronousRound newRound) {
            Objects.requireNonNull(newRound, "round");
            return with(copy -> copy.round = newRound);
        }

        /** Observes the calls of the actors, of which the synchronous mode has none; null = none. */
        public Settings withCallObserver(@Nullable CallObserver newObserver) {
            return with(copy -> copy.callObserver = newObserver);
        }

        public Mode mode() {
            return mode;
        }

        public RobotServicesActor.Settings robots() {
            return robots;
        }

        public Clock clock() {
            return clock;
        }

        public Arbitrator.StateListener listener() {
            return listener;
        }

        public SynchronousRound round() {
            return round;
        }

        public @Nullable CallObserver callObserver() {
            return callObserver;
        }
    }

    /** Notified of what happens over hosts, on the thread of the arbitrator. */
    public interface HostsListener extends Arbitrator.StateListener, LeasedRobots.Listener {
        /** A provider has reported what it does with a robot. */
        void reported(DriverReport report, String node);

        /** Observes the calls of the arbitrator; null = none. */
        default @Nullable CallObserver callObserver() {
            return null;
        }
    }

    private static final System.Logger LOG = System.getLogger(SubsumptionRun.class.getName());

    /** The arbitrator, in messages about what it needs. */
    static final String CALLER = "arbitrator";

    /**
     * A service answers when it ends, which may take hours. The calls to all robots of the first state may be queued
     * before the provider has started.
     */
    static final ConnectionSettings LIMITS =
            ConnectionSettings.defaults().withoutAnswerLimit().withCapacity(Integer.MAX_VALUE);

    /**
     * A service that ends is noticed at once, so health checks are only of use on another space; a failure ends the
     * run, so nothing is restarted.
     */
    private static final BrokerSettings BROKER =
            BrokerSettings.defaults().withoutChecks().withoutRestart();

    /** How long providers may take to answer the request for their offers; shorter than the wait for leases. */
    private static final Duration DISCOVERY = Duration.ofSeconds(2);
    /** A provider may take its time to start. */
    private static final Duration START_LIMIT = Duration.ofMinutes(2);

    private static final Duration STOP_LIMIT = Duration.ofSeconds(3);

    private final AtomicReference<@Nullable Throwable> failure;
    private final Runnable closing;

    private SubsumptionRun(AtomicReference<@Nullable Throwable> failure, Runnable closing) {
        this.failure = failure;
        this.closing = closing;
    }

    /**
     * Connects to the robots and starts the services of the first state, in this process.
     *
     * @return when they have started, so that the next reading is the first that they get
     * @throws RuntimeException if that fails, for example a {@link io.troupe.player.PlayerException}
     */
    public static SubsumptionRun start(Settings settings) throws InterruptedException {
        return start(settings, () -> new RobotServicesActor(settings.robots()));
    }

    /**
     * Starts a run.
     *
     * @param provider creates the robot services; not used in synchronous mode
     */
    static SubsumptionRun start(Settings settings, Supplier<? extends RobotServices> provider)
            throws InterruptedException {
        var failure = new AtomicReference<@Nullable Throwable>();
        Consumer<Throwable> failed = error -> failure.compareAndSet(null, error);
        Runnable closing = settings.mode() == Mode.SYNC
                ? SynchronousLoop.start(settings, failed)::close
                : ActorRun.inProcess(settings, provider, failed)::close;
        return started(new SubsumptionRun(failure, closing));
    }

    /**
     * Finds a provider on other hosts for each service of the table, and starts the services of the first state.
     *
     * @param mode promise or callback
     * @throws MissingServiceException if a service has no provider; the message is one line
     */
    public static SubsumptionRun overHosts(RobotNode node, Mode mode, SubsumptionTable table, HostsListener listener)
            throws InterruptedException {
        var failure = new AtomicReference<@Nullable Throwable>();
        var run = ActorRun.overHosts(node, mode, table, listener, error -> failure.compareAndSet(null, error));
        return started(new SubsumptionRun(failure, run::close));
    }

    private static SubsumptionRun started(SubsumptionRun run) {
        try {
            run.check();
            return run;
        } catch (RuntimeException impossible) {
            run.close();
            throw impossible;
        }
    }

    /** Throws the error that has ended the run, if there is one. Any thread may call it. */
    public void check() {
        Throwable error = failure.get();
        if (error instanceof RuntimeException unchecked) {
            throw unchecked;
        }
        if (error != null) {
            throw new IllegalStateException("the services failed", error);
        }
    }

    /** Stops the robots and disconnects. */
    @Override
    public void close() {
        closing.run();
    }

    /** The connections to the services of a table, by their names. */
    record Connected(Map<String, ActorConnection<RobotServices>> byService) {
        static Connected to(SubsumptionTable table, ActorServices actors) {
            Map<String, ActorConnection<RobotServices>> byService = new LinkedHashMap<>();
            for (Service service : table.services()) {
                var need = Need.ofCapability(CALLER, service.name());
                byService.put(service.name(), actors.connect(RobotServices.class, need, LIMITS));
            }
            return new Connected(byService);
        }

        Map<String, RobotServices> actors() {
            Map<String, RobotServices> actors = new LinkedHashMap<>();
            byService.forEach((name, connection) -> actors.put(name, connection.actor()));
            return actors;
        }

        /** Fulfilled when each service of the table has a provider. */
        Promise<?> ready() {
            return Promise.all(
                    byService.values().stream().map(ActorConnection::first).toList());
        }

        void close() {
            byService.values().forEach(ActorConnection::close);
        }
    }

    /**
     * Publishes robot services at a broker on a space, with the services of the table as capabilities, and connects to
     * each of these through the broker.
     *
     * @param failed receives the cause if the services cannot start or end
     */
    static Connected publishAndConnect(
            ActorSpace space,
            SubsumptionTable table,
            Supplier<? extends RobotServices> provider,
            Consumer<Throwable> failed) {
        var broker = Broker.open("robots", space, BROKER.withObserver(event -> observe(event, failed)));
        ActorServices actors = broker.services();
        List<String> names = table.services().stream().map(Service::name).toList();
        actors.publish(space, RobotServices.class, RobotServices.SERVICE, names, provider);
        return Connected.to(table, actors);
    }

    private static void observe(BrokerEvent event, Consumer<Throwable> failed) {
        switch (event) {
            case BrokerEvent.StartFailed(var provider, Throwable why) -> failed.accept(why);
            case BrokerEvent.Failed(var provider, Throwable why) -> failed.accept(why);
            default -> {}
        }
        if (!(event instanceof BrokerEvent.LeftRunning)) { // a run ends with its space, and does not close the broker
            BrokerObserver.logging().on(event);
        }
    }

    /**
     * Runs the two asynchronous modes: the robot services are actors that are published at a broker, here or on other
     * hosts, and the arbitrator calls them through it. In one process broker, services and arbitrator share a separate
     * space and the robots' clock, so a run is deterministic.
     */
    private static final class ActorRun {
        private final ActorSpace space;
        private final SubsumptionTable table;
        private final Consumer<Throwable> failed;
        private final @Nullable BusPort port; // over hosts
        private @Nullable Connected connected;
        private @Nullable LeasedRobots robots;
        private volatile boolean closing;

        private ActorRun(
                SpaceSettings settings,
                @Nullable CallObserver calls,
                SubsumptionTable table,
                @Nullable BusPort port,
                Consumer<Throwable> failed) {
            this.table = table;
            this.failed = failed;
            this.port = port;
            SpaceSettings reporting = settings.withOnError((where, error) -> report(error));
            this.space = ActorSpace.create(calls == null ? reporting : reporting.withCallObserver(calls));
        }

        /** Returns when the services of the first state have started, or have failed to start. */
        static ActorRun inProcess(
                Settings settings, Supplier<? extends RobotServices> provider, Consumer<Throwable> failed)
                throws InterruptedException {
            var named = SpaceSettings.named("robots").withClock(settings.clock());
            var run = new ActorRun(
                    named, settings.callObserver(), settings.robots().table(), null, failed);
            return run.started(() -> {
                Connected services = publishAndConnect(run.space, run.table, provider, why -> {
                    if (!run.closing) {
                        run.report(why);
                    }
                });
                run.spawnArbitrator(
                        settings.mode(),
                        LeasedRobots.of(services.actors()),
                        settings.listener(),
                        services.ready()); // calls that wait for a provider would arrive in the connections' order
                var begun = new CountDownLatch(1);
                run.space.onIdle(begun::countDown);
                begun.await();
            });
        }

        /** Returns when each service has a provider, and the leases of an earlier arbitrator are over. */
        static ActorRun overHosts(
                RobotNode node, Mode mode, SubsumptionTable table, HostsListener listener, Consumer<Throwable> failed)
                throws InterruptedException {
            BusPort port = node.bus().attach(new OwnName("$arbitrator"));
            var run = new ActorRun(SpaceSettings.named("arbitrator"), listener.callObserver(), table, port, failed);
            Promise<?> earlierLeasesOver = run.space.delay(LeasedRobots.CERTAINLY_OVER);
            run.space.execute(() -> DriverReport.subscribe(port, listener::reported));
            return run.started(() -> {
                // the choice among providers is made when all have had time to answer, not by who was the first
                await(run.space.delay(DISCOVERY));
                for (Service service : table.services()) {
                    await(node.broker().require(Need.ofCapability(CALLER, service.name())));
                }
                var services = Connected.to(table, node.actors());
                run.connected = services;
                await(services.ready());
                await(earlierLeasesOver);
                run.robots = LeasedRobots.overHosts(services.actors(), run.space, node.broker(), listener);
                run.spawnArbitrator(mode, run.robots, listener, Promise.done());
            });
        }

        /** A part of a start. */
        private interface Steps {
            void run() throws InterruptedException;
        }

        private ActorRun started(Steps steps) throws InterruptedException {
            try {
                steps.run();
                return this;
            } catch (RuntimeException | InterruptedException impossible) {
                close();
                throw impossible;
            }
        }

        private static void await(Promise<?> promise) throws InterruptedException {
            try {
                promise.get(START_LIMIT);
            } catch (TimeoutException overdue) {
                throw new IllegalStateException("the services have not started within " + START_LIMIT, overdue);
            }
        }

        private void spawnArbitrator(
                Mode mode, LeasedRobots leased, Arbitrator.StateListener listener, Promise<?> ready) {
            Arbitrator arbitrator = space.spawn(Arbitrator.class, () -> new Arbitrator(mode, leased, table, listener));
            ready.thenRun(arbitrator::live).exceptionally(error -> {
                report(error);
                return null;
            });
            arbitrator.failure().exceptionally(error -> {
                report(error);
                return null;
            });
        }

        private void report(Throwable error) {
            if (closing && (port != null || error instanceof ServiceCallException)) {
                LOG.log(Level.DEBUG, "closed", error); // calls that are under way end with their connection
            } else {
                failed.accept(error);
            }
        }

        void close() {
            closing = true;
            if (port == null) {
                space.close(); // the services end with it
                return;
            }
            if (robots != null) {
                stop(robots);
            }
            if (connected != null) {
                connected.close();
            }
            space.close();
            port.close();
        }

        /** Stops the robots of other hosts, and waits for that. */
        private void stop(LeasedRobots driven) {
            Deferred<@Nullable Void> stopped = Deferred.unbound();
            space.execute(() -> Promise.allSettled(IntStream.range(0, table.robots())
                            .mapToObj(driven::stop)
                            .toList())
                    .handle((all, error) -> stopped.resolve(null)));
            try {
                stopped.get(STOP_LIMIT);
            } catch (TimeoutException unreachable) {
                LOG.log(Level.WARNING, "not all robots have confirmed their stop within {0}", STOP_LIMIT);
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
            }
        }
    }
}
