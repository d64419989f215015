package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.ActorConnection;
import io.troupe.broker.ConnectionSettings;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.bus.BusPort;
import java.lang.System.Logger.Level;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * Runs the arbitrator of a table over robot services on other hosts, until closed. A service whose provider is gone is
 * continued by another provider, in the same state.
 *
 * {@snippet :
 * try (var run = HostedRun.start(node, Mode.PROMISE, SubsumptionTable.ofThePaper(), listener)) {
 *     while (goesOn()) {
 *         run.check();
 *     }
 * }
 * }
 *
 * <p><b>Threads.</b> The arbitrator runs on a separate thread; the listener is called on it.
 *
 * <p><b>Order.</b> In real time. A robot never has two drivers: each drives only while this process renews its lease,
 * and another one is called when the first has confirmed that it has stopped, or its lease is certainly over. The first
 * one is called 2.3 s after the start of this run at the earliest: then the leases of an earlier run are over.
 *
 * <p><b>Errors.</b> {@link #start} and {@link #check} throw a {@link MissingServiceException} if a service of the table
 * has no provider: after 2 s at the start, for 5 s later. Any other error of a service ends the run as it does in one
 * process. If this process is killed, frozen or cut off, the robots stop within 2.5 s.
 */
public final class HostedRun implements AutoCloseable {
    /** Notified of what happens, on the thread of the arbitrator. */
    public interface Listener extends Arbitrator.StateListener {
        /** A provider has reported what it does with a robot. */
        void reported(DriverReport report, String node);

        /** The provider that drives a robot is gone, and another one is looked for; it is not a change of state. */
        default void driverLost(int robot, String service, Throwable why) {}

        /** A robot is driven again. */
        default void drivenAgain(int robot, String service) {}

        /** Observes the calls of the arbitrator; null = none. */
        default @Nullable CallObserver callObserver() {
            return null;
        }
    }

    private static final System.Logger LOG = System.getLogger(HostedRun.class.getName());

    /** How long providers may take to answer the request for their offers; shorter than the wait for leases. */
    private static final Duration DISCOVERY = Duration.ofSeconds(2);
    /** A provider may take its time to start. */
    private static final Duration START_LIMIT = Duration.ofMinutes(2);

    private static final Duration STOP_LIMIT = Duration.ofSeconds(3);

    /** A service answers when it ends, which may take hours. */
    static final ConnectionSettings LIMITS = ConnectionSettings.defaults().withoutAnswerLimit();

    private final RobotNode node;
    private final SubsumptionTable table;
    private final ActorSpace space;
    private final BusPort port;
    private final AtomicReference<@Nullable Throwable> failure = new AtomicReference<>();
    private final List<ActorConnection<?>> connections = new ArrayList<>();
    /** An arbitrator before this one may have ended just now, and its leases hold on. */
    private final Promise<?> earlierLeasesOver;

    private volatile boolean closing;
    private @Nullable RobotServices services;

    private HostedRun(RobotNode node, SubsumptionTable table, Listener listener) {
        this.node = node;
        this.table = table;
        var settings = SpaceSettings.named("arbitrator").withOnError((where, error) -> report(error));
        CallObserver calls = listener.callObserver();
        this.space = ActorSpace.create(calls == null ? settings : settings.withCallObserver(calls));
        this.port = node.bus().attach(SubsumptionRun.CALLER);
        this.earlierLeasesOver = space.delay(FailoverServices.CERTAINLY_OVER);
        space.execute(() -> DriverReport.subscribe(port, listener::reported));
    }

    /**
     * Finds a provider for each service of the table, and starts the services of the first state.
     *
     * @param mode promise or callback
     * @throws MissingServiceException if a service has no provider; the message is one line
     */
    public static HostedRun start(RobotNode node, Mode mode, SubsumptionTable table, Listener listener)
            throws InterruptedException {
        if (mode == Mode.SYNC) {
            throw new IllegalArgumentException("the mode is " + mode + ", expected callback or promise");
        }
        var run = new HostedRun(node, table, listener);
        try {
            run.findProviders();
            run.startArbitrator(mode, listener);
            return run;
        } catch (RuntimeException | InterruptedException impossible) {
            run.close();
            throw impossible;
        }
    }

    /** The choice among providers is made when all of them have had time to answer, not by who was the first. */
    private void findProviders() throws InterruptedException {
        await(space.delay(DISCOVERY), START_LIMIT);
        for (Service service : table.services()) {
            await(node.broker().require(Need.ofCapability(SubsumptionRun.CALLER, service.name())), START_LIMIT);
        }
    }

    private void startArbitrator(Mode mode, Listener listener) throws InterruptedException {
        Map<String, LeasedRobotServices> byService = new LinkedHashMap<>();
        List<Promise<?>> ready = new ArrayList<>();
        for (Service service : table.services()) {
            var need = Need.ofCapability(SubsumptionRun.CALLER, service.name());
            var connection = node.actors().connect(LeasedRobotServices.class, need, LIMITS);
            connections.add(connection);
            byService.put(service.name(), connection.actor());
            ready.add(connection.first());
        }
        await(Promise.all(ready), START_LIMIT);
        await(earlierLeasesOver, START_LIMIT);
        RobotServices found =
                space.spawn(RobotServices.class, () -> new FailoverServices(byService, node.broker(), listener));
        services = found;
        Arbitrator arbitrator = space.spawn(Arbitrator.class, () -> new Arbitrator(mode, found, table, listener));
        arbitrator.live();
        arbitrator.failure().exceptionally(error -> {
            report(error);
            return null;
        });
    }

    private static void await(Promise<?> promise, Duration limit) throws InterruptedException {
        try {
            promise.get(limit);
        } catch (TimeoutException overdue) {
            throw new IllegalStateException("the services have not started within " + limit, overdue);
        }
    }

    private void report(Throwable error) {
        if (closing) {
            LOG.log(Level.DEBUG, "closed", error); // calls that are under way end with their connection
        } else {
            failure.compareAndSet(null, error);
        }
    }

    /** Throws the error that has ended the run, if there is one. Any thread may call it. */
    public void check() {
        SubsumptionRun.rethrow(failure.get());
    }

    /** Stops the robots, and waits for that. */
    @Override
    public void close() {
        closing = true;
        RobotServices called = services;
        if (called != null) {
            var stopped = new ArrayList<Promise<?>>();
            for (int robot = 0; robot < table.robots(); robot++) {
                stopped.add(called.stop(robot));
            }
            try {
                Promise.allSettled(stopped).get(STOP_LIMIT);
            } catch (TimeoutException unreachable) {
                LOG.log(Level.WARNING, "not all robots have confirmed their stop within {0}", STOP_LIMIT);
            } catch (InterruptedException interrupted) {
                Thread.currentThread().interrupt();
            }
        }
        connections.forEach(ActorConnection::close);
        space.close();
        port.close();
    }
}
