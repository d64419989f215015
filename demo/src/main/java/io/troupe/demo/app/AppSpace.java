package io.troupe.demo.app;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Clock;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.demo.monitor.AppMonitor;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationSettings;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.Callable;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.BiConsumer;
import org.jspecify.annotations.Nullable;

/**
 * The actor space of an application, and the calls to it from the thread of the command.
 *
 * <p><b>Threads.</b> The thread of the command. <b>Errors.</b> The first failure is kept, and rethrown unwrapped.
 */
final class AppSpace implements AutoCloseable {
    /** Wall-clock limits: simulated time does not advance while services start and stop. */
    private static final Duration START_LIMIT = Duration.ofSeconds(60);

    private static final Duration STOP_LIMIT = Duration.ofSeconds(20);

    private final Path file;
    private final AtomicReference<@Nullable Throwable> failure = new AtomicReference<>();
    private final ActorSpace space;

    /** @param file names the application in errors */
    AppSpace(Path file, Clock clock) {
        this(file, clock, null);
    }

    /** @param calls observes the calls of actors; null = none */
    AppSpace(Path file, Clock clock, @Nullable CallObserver calls) {
        this.file = file;
        var settings = SpaceSettings.named("application")
                .withClock(clock)
                .withOnError((where, error) -> failure.compareAndSet(null, error));
        this.space = ActorSpace.create(calls == null ? settings : settings.withCallObserver(calls));
    }

    ActorSpace space() {
        return space;
    }

    /** Starts an application that reports to {@code report}. */
    Application start(ApplicationPlan plan, Bus bus, AppReport report) throws InterruptedException {
        return start(plan, bus, report, null);
    }

    /** @param monitor follows the providers and components; null = none */
    Application start(ApplicationPlan plan, Bus bus, AppReport report, @Nullable AppMonitor monitor)
            throws InterruptedException {
        var settings = ApplicationSettings.defaults()
                .withBroker(BrokerSettings.defaults().withObserver(event -> {
                    if (monitor != null) {
                        monitor.onBroker(event);
                    }
                    report.onBroker(event);
                }))
                .withComponentObserver(report)
                .withObserver(report::onApplication);
        BusPort listener = bus.attach(":report");
        for (var component : plan.components().values()) {
            for (var topic : component.publishes()) {
                listen(listener, topic, ColourSeen.class, report::saw);
                if (!plan.nodes().isEmpty()) {
                    listen(listener, topic, PositionReading.class, (from, at) -> report.moved(topic.name(), at));
                }
            }
        }
        return call(() -> Application.start(plan, bus, settings));
    }

    private static <T extends Record> void listen(
            BusPort listener, BusTopic<?> topic, Class<T> type, BiConsumer<String, T> receiver) {
        if (topic.type().equals(type)) {
            listener.subscribe(topic, (value, from) -> receiver.accept(from.name(), type.cast(value)));
        }
    }

    /** Waits until all needs of an application are met; a later failure is kept. */
    void awaitStarted(Application application) throws InterruptedException {
        await(application.started().toCompletableFuture(), START_LIMIT, "to start");
        application.ended().onRejected(error -> failure.compareAndSet(null, error));
    }

    /** Stops an application, and waits until it has ended. */
    void stop(Application application) throws InterruptedException {
        space.execute(application::closeAsync);
        await(application.ended().handle((ended, error) -> true).toCompletableFuture(), STOP_LIMIT, "to stop");
    }

    /** Calls on the space. */
    <T> T call(Callable<T> action) throws InterruptedException {
        var result = new CompletableFuture<T>();
        space.execute(() -> {
            try {
                result.complete(action.call());
            } catch (Exception thrown) {
                result.completeExceptionally(thrown);
            }
        });
        return await(result, START_LIMIT, "to begin");
    }

    /** Calls on the space, and waits until what was begun there has ended. */
    void stop(Callable<Promise<@Nullable Void>> action) throws InterruptedException {
        await(call(() -> action.call().handle((ended, error) -> true).toCompletableFuture()), STOP_LIMIT, "to stop");
    }

    boolean hasFailed() {
        return failure.get() != null;
    }

    void rethrowFailure() {
        rethrow(failure.get());
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

    @Override
    public void close() {
        space.close();
    }
}
