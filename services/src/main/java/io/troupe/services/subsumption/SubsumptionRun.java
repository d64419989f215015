package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.time.Clock;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;
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
            SynchronousRound round) {
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
            this(mode, host, port, table, clock, observer, listener, false, SynchronousRound.ONE_SERVICE_A_READING);
        }

        public Settings withReconnection(boolean newReconnects) {
            return new Settings(mode, host, port, table, clock, observer, listener, newReconnects, round);
        }

        public Settings withRound(SynchronousRound newRound) {
            return new Settings(mode, host, port, table, clock, observer, listener, reconnects, newRound);
        }
    }

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
        var failure = new AtomicReference<@Nullable Throwable>();
        Consumer<Throwable> failed = error -> failure.compareAndSet(null, error);
        Runnable closing = settings.mode() == Mode.SYNC
                ? SynchronousLoop.start(settings, failed)::close
                : ActorRun.start(settings, failed)::close;
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

    /** Runs the two asynchronous modes: the robot services and the arbitrator are actors on a separate space. */
    private static final class ActorRun implements AutoCloseable {
        private final ActorSpace space;

        private ActorRun(ActorSpace space) {
            this.space = space;
        }

        /** Returns when the services of the first state have started, or have failed to start. */
        static ActorRun start(Settings settings, Consumer<Throwable> failed) throws InterruptedException {
            var space = ActorSpace.create(SpaceSettings.named("robots")
                    .withClock(settings.clock())
                    .withOnError((where, error) -> failed.accept(error)));
            var run = new ActorRun(space);
            try {
                run.startActors(settings, failed);
                return run;
            } catch (RuntimeException | InterruptedException impossible) {
                run.close();
                throw impossible;
            }
        }

        private void startActors(Settings settings, Consumer<Throwable> failed) throws InterruptedException {
            var serviceSettings = new RobotServices.Settings(
                    settings.host(), settings.port(), settings.table(), settings.observer(), settings.reconnects());
            RobotServices services = space.spawn(RobotServices.class, () -> new RobotServices(serviceSettings));
            startArbitrator(settings, services).exceptionally(error -> {
                failed.accept(error);
                return null;
            });
            var started = new CountDownLatch(1);
            space.onIdle(started::countDown);
            started.await();
        }

        /** Starts the mode's arbitrator; the promise is rejected when a service fails. */
        private Promise<@Nullable Void> startArbitrator(Settings settings, RobotServices services) {
            if (settings.mode() == Mode.CALLBACK) {
                CallbackArbitrator arbitrator = space.spawn(
                        CallbackArbitrator.class,
                        () -> new CallbackArbitrator(services, settings.table(), settings.listener()));
                arbitrator.live();
                return arbitrator.failure();
            }
            Arbitrator arbitrator = space.spawn(
                    Arbitrator.class, () -> new Arbitrator(services, settings.table(), settings.listener()));
            arbitrator.live();
            return arbitrator.failure();
        }

        @Override
        public void close() {
            space.close();
        }
    }
}
