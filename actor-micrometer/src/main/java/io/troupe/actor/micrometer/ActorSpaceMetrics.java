package io.troupe.actor.micrometer;

import io.micrometer.core.instrument.FunctionCounter;
import io.micrometer.core.instrument.Gauge;
import io.micrometer.core.instrument.Meter;
import io.micrometer.core.instrument.MeterRegistry;
import io.micrometer.core.instrument.Tag;
import io.micrometer.core.instrument.Tags;
import io.micrometer.core.instrument.TimeGauge;
import io.micrometer.core.instrument.binder.MeterBinder;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceMetrics;
import java.util.ArrayList;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.TimeUnit;
import java.util.function.ToDoubleFunction;

/**
 * The figures of an actor space, as meters.
 *
 * {@snippet :
 * new ActorSpaceMetrics(space).bindTo(registry);
 * }
 *
 * <p><b>Role.</b> The meters are those of {@link SpaceMetrics}: the counters {@code troupe.space.served},
 * {@code .errors}, {@code .dead.letters}, {@code .abandoned} and {@code .expired}, and the gauges {@code .waiting},
 * {@code .latency}, {@code .actors} and {@code .timers}, all with the tag {@code space}, the name of the space. They
 * are removed from the registry when the space is closed.
 *
 * <p><b>Threads.</b> Any thread. <b>Cost.</b> None while no meter is read.
 */
public final class ActorSpaceMetrics implements MeterBinder {
    private static final String PREFIX = "troupe.space.";

    private final ActorSpace space;
    private final SpaceMetrics metrics;
    private final Tags tags;

    public ActorSpaceMetrics(ActorSpace space) {
        this(space, List.of());
    }

    /** @param tags of all meters, in addition to the name of the space */
    public ActorSpaceMetrics(ActorSpace space, Iterable<Tag> tags) {
        this.space = Objects.requireNonNull(space, "space");
        this.metrics = space.metrics();
        this.tags = Tags.concat(tags, "space", space.toString());
    }

    @Override
    public void bindTo(MeterRegistry registry) {
        List<Meter> meters = new ArrayList<>();
        meters.add(counter(registry, "served", "entries processed", SpaceMetrics::served));
        meters.add(counter(registry, "errors", "errors reported to error handlers", SpaceMetrics::errors));
        meters.add(counter(registry, "dead.letters", "messages that were not delivered", SpaceMetrics::deadLetters));
        meters.add(counter(
                registry,
                "abandoned",
                "requests that were not begun: their callers had given them up",
                SpaceMetrics::abandoned));
        meters.add(counter(registry, "expired", "time limits of promises that have passed", SpaceMetrics::expired));
        meters.add(gauge(registry, "waiting", "entries before the last probe", SpaceMetrics::waiting));
        meters.add(gauge(registry, "actors", "actors that have started and not stopped", SpaceMetrics::actors));
        meters.add(gauge(registry, "timers", "timers that are set", SpaceMetrics::timers));
        meters.add(TimeGauge.builder(
                        PREFIX + "latency",
                        metrics,
                        TimeUnit.NANOSECONDS,
                        each -> each.latency().toNanos())
                .description("how long the last probe was queued")
                .tags(tags)
                .strongReference(true)
                .register(registry));
        space.whenClosed().toCompletableFuture().thenRun(() -> meters.forEach(registry::remove));
    }

    private FunctionCounter counter(
            MeterRegistry registry, String name, String description, ToDoubleFunction<SpaceMetrics> value) {
        return FunctionCounter.builder(PREFIX + name, metrics, value)
                .description(description)
                .tags(tags)
                .register(registry);
    }

    private Gauge gauge(MeterRegistry registry, String name, String description, ToDoubleFunction<SpaceMetrics> value) {
        return Gauge.builder(PREFIX + name, metrics, value)
                .description(description)
                .tags(tags)
                .strongReference(true)
                .register(registry);
    }
}
