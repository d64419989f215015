package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.time.Clock;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicReference;
import org.jspecify.annotations.Nullable;

/**
 * The robots of a table under their services, in one of the three modes, until it is closed.
 *
 * <p><b>Threads.</b> One of its own does everything: an actor space, or in synchronous mode a plain thread. Observer and listener are called there.
 * <p><b>Source.</b> Paper, sections 3.4 to 3.6.
 */
public final class SubsumptionRun implements AutoCloseable {
    /**
     * What to run.
     *
     * @param host where the robots are, with {@code port}: a world in this JVM or a Player server
     * @param clock the robots' time
     */
    public record Settings(
            Mode mode,
            String host,
            int port,
            SubsumptionTable table,
            Clock clock,
            ServiceObserver observer,
            Arbitrator.StateListener listener) {}

    private final ActorSpace space;
    private final AtomicReference<@Nullable Throwable> failure = new AtomicReference<>();

    private SubsumptionRun(Clock clock) {
        space = ActorSpace.create(SpaceSettings.named("robots")
                .withClock(clock)
                .withOnError((where, error) -> failure.compareAndSet(null, error)));
    }

    /**
     * Connects to the robots and puts the services of the first state in charge.
     *
     * @return when that has been done, so that the next reading is the first that they see
     * @throws RuntimeException what makes it impossible, for example a {@link io.troupe.player.PlayerException}
     */
    public static SubsumptionRun start(Settings settings) throws InterruptedException {
        if (settings.mode() != Mode.PROMISE) {
            throw new IllegalArgumentException("the mode is " + settings.mode() + ", expected " + Mode.PROMISE);
        }
        var run = new SubsumptionRun(settings.clock());
        try {
            run.begin(settings);
            run.check();
            return run;
        } catch (RuntimeException impossible) {
            run.close();
            throw impossible;
        }
    }

    private void begin(Settings settings) throws InterruptedException {
        var serviceSettings =
                new RobotServices.Settings(settings.host(), settings.port(), settings.table(), settings.observer());
        RobotServices services = space.spawn(RobotServices.class, () -> new RobotServices(serviceSettings));
        Arbitrator arbitrator =
                space.spawn(Arbitrator.class, () -> new Arbitrator(services, settings.table(), settings.listener()));
        arbitrator.ended().exceptionally(error -> {
            failure.compareAndSet(null, error);
            return null;
        });
        arbitrator.live();
        var begun = new CountDownLatch(1);
        space.onIdle(begun::countDown);
        begun.await();
    }

    /** Throws what has ended the run, if anything has; any thread may ask. */
    public void check() {
        Throwable error = failure.get();
        if (error instanceof RuntimeException unchecked) {
            throw unchecked;
        }
        if (error != null) {
            throw new IllegalStateException("the services failed", error);
        }
    }

    /** Stops driving and disconnects. */
    @Override
    public void close() {
        space.close();
    }
}
