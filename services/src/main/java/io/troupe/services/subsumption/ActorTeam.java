package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import java.util.concurrent.CountDownLatch;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/** Runs the two asynchronous modes: the robot services and the arbitrator are actors on a separate space. */
final class ActorTeam implements AutoCloseable {
    private final ActorSpace space;

    private ActorTeam(ActorSpace space) {
        this.space = space;
    }

    /** Returns when the services of the first state have started, or have failed to start. */
    static ActorTeam start(SubsumptionRun.Settings settings, Consumer<Throwable> failed) throws InterruptedException {
        var space = ActorSpace.create(SpaceSettings.named("robots")
                .withClock(settings.clock())
                .withOnError((where, error) -> failed.accept(error)));
        var team = new ActorTeam(space);
        try {
            team.startActors(settings, failed);
            return team;
        } catch (RuntimeException | InterruptedException impossible) {
            team.close();
            throw impossible;
        }
    }

    private void startActors(SubsumptionRun.Settings settings, Consumer<Throwable> failed) throws InterruptedException {
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
    private Promise<@Nullable Void> startArbitrator(SubsumptionRun.Settings settings, RobotServices services) {
        if (settings.mode() == Mode.CALLBACK) {
            CallbackArbitrator arbitrator = space.spawn(
                    CallbackArbitrator.class,
                    () -> new CallbackArbitrator(services, settings.table(), settings.listener()));
            arbitrator.live();
            return arbitrator.failure();
        }
        Arbitrator arbitrator =
                space.spawn(Arbitrator.class, () -> new Arbitrator(services, settings.table(), settings.listener()));
        arbitrator.live();
        return arbitrator.failure();
    }

    @Override
    public void close() {
        space.close();
    }
}
