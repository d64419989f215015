package io.troupe.actor.micrometer;

import static org.assertj.core.api.Assertions.assertThat;

import io.micrometer.core.instrument.FunctionCounter;
import io.micrometer.core.instrument.Gauge;
import io.micrometer.core.instrument.Meter;
import io.micrometer.core.instrument.Tag;
import io.micrometer.core.instrument.TimeGauge;
import io.micrometer.core.instrument.simple.SimpleMeterRegistry;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceMetrics;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;

class ActorSpaceMetricsTest {
    private final SimpleMeterRegistry registry = new SimpleMeterRegistry();

    /** Answers some questions. */
    interface Oracle {
        Promise<String> ask(Promise<String> answer);

        void note(String line);
    }

    private static final class Silent implements Oracle {
        @Override
        public Promise<String> ask(Promise<String> answer) {
            return answer;
        }

        @Override
        public void note(String line) {
            throw new IllegalStateException(line);
        }
    }

    /** The meters by name, without their common prefix. */
    private Map<String, Double> figures() {
        var figures = new HashMap<String, Double>();
        for (Meter meter : registry.getMeters()) {
            String name = meter.getId().getName().replaceFirst("^troupe\\.space\\.", "");
            figures.put(
                    name,
                    meter.match(
                            Gauge::value,
                            counter -> 0.0,
                            timer -> 0.0,
                            summary -> 0.0,
                            task -> 0.0,
                            gauge -> gauge.value(TimeUnit.SECONDS),
                            FunctionCounter::count,
                            timer -> 0.0,
                            other -> 0.0));
        }
        return figures;
    }

    @Test
    void meters_haveTheFiguresOfTheSpace() {
        try (var test = new TestSpace()) {
            ActorSpace space = test.space();
            new ActorSpaceMetrics(space).bindTo(registry);
            Oracle oracle = test.spawn(Oracle.class, Silent::new);
            oracle.note("not noted");
            oracle.ask(Promise.of("")).cancel();
            test.runQueued();
            test.run(() -> oracle.ask(new Deferred<>()).completeOnTimeout("late", Duration.ofSeconds(1)));
            test.advance(Duration.ofSeconds(1));
            Oracle other = test.spawn(Oracle.class, Silent::new);
            test.space().stop(other);
            other.note("too late");
            test.runQueued();
            test.space().delay(Duration.ofSeconds(1));
            test.space().execute(() -> {});
            SpaceMetrics metrics = test.space().metrics();
            assertThat(figures())
                    .containsExactlyInAnyOrderEntriesOf(Map.of(
                            "served", (double) metrics.served(),
                            "errors", 1.0,
                            "dead.letters", 1.0,
                            "abandoned", 1.0,
                            "expired", 1.0,
                            "waiting", 2.0,
                            "actors", 1.0,
                            "timers", 0.0,
                            "latency", 0.0));
            assertThat(metrics.served()).isPositive();
            test.runQueued();
            assertThat(figures()).containsEntry("timers", 1.0).containsEntry("waiting", 0.0);
            test.takeProblems();
            test.takeDeadLetters();
        }
    }

    @Test
    void meters_areTaggedWithTheirSpace_andRemovedWhenItIsClosed() {
        var settings = SpaceSettings.named("shop").withoutThread();
        ActorSpace space = ActorSpace.create(settings);
        ActorSpace other = ActorSpace.create(settings.withOffloadLimit(1));
        new ActorSpaceMetrics(space).bindTo(registry);
        var tagged = new SimpleMeterRegistry();
        new ActorSpaceMetrics(other, List.of(Tag.of("host", "ship"))).bindTo(tagged);
        assertThat(registry.getMeters())
                .hasSize(9)
                .allSatisfy(meter -> assertThat(meter.getId().getTag("space")).isEqualTo("shop"));
        assertThat(tagged.get("troupe.space.latency").tag("host", "ship").meter())
                .isInstanceOf(TimeGauge.class);
        space.close();
        assertThat(registry.getMeters()).isEmpty();
        assertThat(tagged.getMeters()).hasSize(9);
        other.close();
    }
}
