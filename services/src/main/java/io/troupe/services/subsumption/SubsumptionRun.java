package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Callback;
import io.troupe.actor.Clock;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorServices;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerObserver;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.broker.ServiceRecord;
import java.lang.System.Logger.Level;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * Runs the services of a table on its robots, in one of the three modes, until closed.
 *
 * <p><b>Threads.</b> All work is done on one separate thread: an actor space's, or a plain thread in synchronous mode.
 * Observer and listener are called on it.
 *
 * <p><b>Source.</b> Paper, sections 3.4 to 3.6.
 */
public final class SubsumptionRun implements AutoCloseable {
    /**
     * What to run.
     *
     * @param host where the robots are, with {@code port}: a world in this JVM or a Player server
     * @param clock the robots' time
     * @param reconnects whether each service has a separate connection with its robot (section 3.5); not supported in
     *     synchronous mode, which connects once
     * @param round what the synchronous mode does at a reading; ignored in the other modes
     * @param callObserver observes the calls of the actors, of which the synchronous mode has none; null = none
     */
    public record Settings(
            Mode mode,
            String host,
            int port,
            SubsumptionTable table,
            Clock clock,
            ServiceObserver observer,
            Arbitrator.StateListener listener,
            boolean reconnects,
            SynchronousRound round,
            @Nullable CallObserver callObserver) {
        public Settings {
            if (mode == Mode.SYNC && reconnects) {
                throw new IllegalArgumentException("the mode is " + mode
                        + " and reconnects, expected callback or promise: the synchronous model connects once");
            }
        }

        /** Creates settings without reconnection, with the paper's synchronous round. */
        public Settings(
                Mode mode,
                String host,
                int port,
                SubsumptionTable table,
                Clock clock,
                ServiceObserver observer,
                Arbitrator.StateListener listener) {
            this(
                    mode,
                    host,
                    port,
                    table,
                    clock,
                    observer,
                    listener,
                    false,
                    SynchronousRound.ONE_SERVICE_A_READING,
                    null);
        }

        public Settings withReconnection(boolean newReconnects) {
            return new Settings(mode, host, port, table, clock, observer, listener, newReconnects, round, callObserver);
        }

        public Settings withRound(SynchronousRound newRound) {
            return new Settings(mode, host, port, table, clock, observer, listener, reconnects, newRound, callObserver);
        }

        public Settings withCallObserver(@Nullable CallObserver newObserver) {
            return new Settings(mode, host, port, table, clock, observer, listener, reconnects, round, newObserver);
        }
    }

    private static final System.Logger LOG = System.getLogger(SubsumptionRun.class.getName());

    /** The arbitrator, in messages about what it needs. */
    static final String CALLER = "arbitrator";

    /**
     * A service answers when it ends, which may take hours. The calls to all robots of the first state may be queued
     * before the provider has started.
     */
    private static final ConnectionSettings LIMITS =
            ConnectionSettings.defaults().withoutAnswerLimit().withCapacity(Integer.MAX_VALUE);

    /**
     * A service that ends is noticed at once, so health checks are only of use on another space; a failure ends the
     * run, so nothing is restarted.
     */
    private static final BrokerSettings BROKER =
            BrokerSettings.defaults().withoutChecks().withoutRestart();

    private final AtomicReference<@Nullable Throwable> failure;
    private final Runnable closing;

    private SubsumptionRun(AtomicReference<@Nullable Throwable> failure, Runnable closing) {
        this.failure = failure;
        this.closing = closing;
    }

    /**
     * Connects to the robots and starts the services of the first state.
     *
     * @return when they have started, so that the next reading is the first that they get
     * @throws RuntimeException if that fails, for example a {@link io.troupe.player.PlayerException}
     */
    public static SubsumptionRun start(Settings settings) throws InterruptedException {
        var robots = new RobotServicesActor.Settings(
                settings.host(), settings.port(), settings.table(), settings.observer(), settings.reconnects());
        return start(settings, () -> new RobotServicesActor(robots));
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
                : ActorRun.start(settings, provider, failed)::close;
        var run = new SubsumptionRun(failure, closing);
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
        rethrow(failure.get());
    }

    static void rethrow(@Nullable Throwable error) {
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

    /**
     * Robot services that are called through a broker.
     *
     * @param ready fulfilled when each service of the table has a provider
     */
    record Connected(RobotServices services, Promise<?> ready) {}

    /**
     * Publishes robot services at a broker on a space, with the services of the table as capabilities, and connects to
     * each of these through the broker.
     *
     * @param failed receives the cause if the services cannot start or end, or if a one-way call does not reach them:
     *     such a call has no promise that could be rejected
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
        Map<String, RobotServices> byService = new LinkedHashMap<>();
        List<Promise<ServiceRecord>> ready = new ArrayList<>();
        for (String name : names) {
            var connection = actors.connect(RobotServices.class, Need.ofCapability(CALLER, name), LIMITS);
            byService.put(name, connection.actor());
            ready.add(connection.first());
        }
        return new Connected(new RoutedServices(byService), Promise.all(ready));
    }

    private static void observe(BrokerEvent event, Consumer<Throwable> failed) {
        switch (event) {
            case BrokerEvent.StartFailed(var provider, Throwable why) -> failed.accept(why);
            case BrokerEvent.Failed(var provider, Throwable why) -> failed.accept(why);
            case BrokerEvent.Undelivered(var need, var call, Throwable why) -> failed.accept(why);
            default -> {}
        }
        if (!(event instanceof BrokerEvent.Abandoned)) { // a run ends with its space, and does not close the broker
            BrokerObserver.logging().on(event);
        }
    }

    /**
     * Runs the two asynchronous modes: the robot services are an actor that is published at a broker, and the
     * arbitrator calls them through it. Broker, services and arbitrator share a separate space and the robots' clock,
     * so a run is deterministic.
     */
    private static final class ActorRun implements AutoCloseable {
        private final ActorSpace space;
        private final Consumer<Throwable> failed;
        private volatile boolean closing;

        private ActorRun(Settings settings, Consumer<Throwable> failed) {
            this.failed = failed;
            var space = SpaceSettings.named("robots")
                    .withClock(settings.clock())
                    .withOnError((where, error) -> report(error));
            CallObserver calls = settings.callObserver();
            this.space = ActorSpace.create(calls == null ? space : space.withCallObserver(calls));
        }

        /** Returns when the services of the first state have started, or have failed to start. */
        static ActorRun start(Settings settings, Supplier<? extends RobotServices> provider, Consumer<Throwable> failed)
                throws InterruptedException {
            var run = new ActorRun(settings, failed);
            try {
                run.startActors(settings, provider);
                return run;
            } catch (RuntimeException | InterruptedException impossible) {
                run.close();
                throw impossible;
            }
        }

        private void startActors(Settings settings, Supplier<? extends RobotServices> provider)
                throws InterruptedException {
            Connected connected = publishAndConnect(space, settings.table(), provider, why -> {
                if (!closing) {
                    report(why);
                }
            });
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class,
                    () -> new Arbitrator(settings.mode(), connected.services(), settings.table(), settings.listener()));
            // calls of connections without a provider would wait, and arrive in the order of the connections
            connected.ready().thenRun(arbitrator::live).exceptionally(error -> {
                report(error);
                return null;
            });
            arbitrator.failure().exceptionally(error -> {
                report(error);
                return null;
            });
            var started = new CountDownLatch(1);
            space.onIdle(started::countDown);
            started.await();
        }

        private void report(Throwable error) {
            if (closing && error instanceof ServiceCallException) {
                LOG.log(Level.DEBUG, "closed", error); // calls that are under way end with their connection
            } else {
                failed.accept(error);
            }
        }

        @Override
        public void close() {
            closing = true;
            space.close();
        }
    }

    /**
     * Robot services behind one interface, each through a separate connection to its provider: {@code drive} goes to
     * the connection for its service, and {@code stop} to the one that drives the robot. Used on one space.
     */
    private static final class RoutedServices implements RobotServices {
        private final Map<String, RobotServices> byService;
        private final Map<Integer, RobotServices> driving = new HashMap<>(); // by robot; the last one

        /** @param byService at least one */
        RoutedServices(Map<String, RobotServices> byService) {
            this.byService = new LinkedHashMap<>(byService);
        }

        @Override
        public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
            return route(robot, service).drive(robot, service, stateColour);
        }

        @Override
        public void drive(int robot, String service, Callback<ColourReport> reports) {
            route(robot, service).drive(robot, service, reports);
        }

        private RobotServices route(int robot, String service) {
            // any provider rejects a service that is not in the table, by its name
            RobotServices to = byService.getOrDefault(
                    service, byService.values().iterator().next());
            driving.put(robot, to);
            return to;
        }

        @Override
        public Promise<@Nullable Void> stop(int robot) {
            RobotServices by = driving.get(robot);
            return by == null ? Promise.done() : by.stop(robot);
        }
    }
}
