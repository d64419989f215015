package io.troupe.demo.app;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.demo.terminal.WorldLoader;
import io.troupe.player.PlayerPorts;
import io.troupe.player.wire.TcpServer;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationReader;
import io.troupe.services.component.application.ApplicationSettings;
import io.troupe.services.component.kinds.ComponentKinds;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.sim.Simulation;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.view.WallClockPacer;
import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.BooleanSupplier;
import org.jspecify.annotations.Nullable;

/**
 * Runs an application on a simulated world, in lock step.
 *
 * <p><b>Threads.</b> The calling thread advances the world. The application, its bus and its broker run on one actor
 * space in simulated time. At any time one of the two waits for the other.
 */
final class AppRun {
    /**
     * Stops a robot half a second after its last command, from any client. Our components request a limit for each of
     * their commands, which may be shorter. This one is for programs that request none, such as an external process
     * that is killed while another client has the robot open.
     */
    static final WorldSettings WORLD = WorldSettings.DEFAULT.withWatchdogMicros(500_000);

    private static final String TCP = "${tcp}";
    /** Wall-clock limits: simulated time does not advance while services start and stop. */
    private static final Duration START_LIMIT = Duration.ofSeconds(60);

    private static final Duration STOP_LIMIT = Duration.ofSeconds(20);

    private final Path file;
    private final ComponentKinds kinds;
    private final Scenario scenario;
    private final AppReport report;

    AppRun(Path file, ComponentKinds kinds, Scenario scenario, AppReport report) {
        this.file = file;
        this.kinds = kinds;
        this.scenario = scenario;
        this.report = report;
    }

    /**
     * Runs for the given simulated time, or until {@code stop} returns true. Rethrows the failure that ended the
     * application.
     */
    void run(double seconds, boolean realtime, BooleanSupplier stop) throws IOException, InterruptedException {
        String declaration = ApplicationReader.text(file);
        int port = WorldLoader.robotPort(scenario, scenario.world().file());
        var failure = new AtomicReference<@Nullable Throwable>();
        try (var simulation = Simulation.open(scenario, WORLD);
                var tcp = declaration.contains(TCP) ? tcp(simulation, port) : null;
                var space = ActorSpace.create(SpaceSettings.named("application")
                        .withClock(simulation.clock())
                        .withOnError((where, error) -> failure.compareAndSet(null, error)))) {
            Map<String, String> values = new LinkedHashMap<>();
            values.put("port", String.valueOf(port));
            if (tcp != null) {
                values.put("tcp", String.valueOf(tcp.port()));
            }
            var plan = ApplicationReader.parse(declaration, file, kinds, values);
            report.watch(simulation.latest(), simulation::timeMicros);
            Application application = start(space, plan);
            try {
                await(application.started().toCompletableFuture(), START_LIMIT, "to start");
                application.ended().handle((ended, error) -> error == null || failure.compareAndSet(null, error));
                move(
                        simulation,
                        StrictMath.round(seconds * 1e6),
                        realtime,
                        () -> stop.getAsBoolean() || failure.get() != null);
            } finally {
                space.execute(application::stop);
                await(application.ended().handle((ended, error) -> true).toCompletableFuture(), STOP_LIMIT, "to stop");
            }
            rethrow(failure.get());
            report.summary(plan.name(), scenario.world().name());
        }
    }

    private static TcpServer tcp(Simulation simulation, int port) {
        simulation.disconnectSilentClients(true); // a process may hang; the others must continue
        return TcpServer.open(PlayerPorts.find(port).orElseThrow(), 0);
    }

    private Application start(ActorSpace space, ApplicationPlan plan) throws InterruptedException {
        var bus = Bus.inProcess("troupe", BusSettings.on(space));
        var broker = Broker.open(space, BrokerSettings.DEFAULT.withObserver(report::onBroker));
        var settings = ApplicationSettings.DEFAULT.withObservers(report, report::onApplication);
        var listener = bus.attach(":report");
        for (var component : plan.components().values()) {
            component.publishes().stream()
                    .filter(topic -> topic.type().equals(ColourSeen.class))
                    .forEach(topic ->
                            listener.subscribe(topic, (seen, from) -> report.saw(from.name(), (ColourSeen) seen)));
        }
        var started = new CompletableFuture<Application>();
        space.execute(() -> {
            try {
                started.complete(Application.start(plan, bus, broker, settings));
            } catch (RuntimeException thrown) {
                started.completeExceptionally(thrown);
            }
        });
        return await(started, START_LIMIT, "to begin");
    }

    private <T extends @Nullable Object> T await(CompletableFuture<T> future, Duration limit, String what)
            throws InterruptedException {
        try {
            return future.get(limit.toMillis(), TimeUnit.MILLISECONDS);
        } catch (TimeoutException e) {
            throw new IllegalStateException(file + " has not been able " + what + " in " + limit, e);
        } catch (ExecutionException e) {
            rethrow(e.getCause());
            throw new IllegalStateException("an error without a cause", e);
        }
    }

    private static void rethrow(@Nullable Throwable failure) {
        if (failure instanceof RuntimeException unchecked) {
            throw unchecked;
        }
        if (failure != null) {
            throw new IllegalStateException("the application has failed", failure);
        }
    }

    private void move(Simulation simulation, long endMicros, boolean realtime, BooleanSupplier stop) {
        var pacer = new WallClockPacer();
        while (simulation.timeMicros() < endMicros && !stop.getAsBoolean()) {
            var snapshot = simulation.tick();
            report.moved(snapshot);
            if (realtime) {
                pacer.await(snapshot.timeMicros());
            }
        }
    }
}
