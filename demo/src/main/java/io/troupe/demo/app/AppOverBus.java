package io.troupe.demo.app;

import io.troupe.actor.Clock;
import io.troupe.broker.BrokerEvent;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.services.component.application.ApplicationNode;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationSettings;
import java.nio.file.Path;
import java.time.Duration;
import java.util.function.BooleanSupplier;
import java.util.function.Function;

/**
 * Runs one node of an application that several processes run together, in real time: the application itself on its
 * first node, on the others their components.
 *
 * <p><b>Threads.</b> As {@link AppRun}.
 */
final class AppOverBus {
    private static final Duration POLL = Duration.ofMillis(50);

    private final Path file;
    private final ApplicationPlan plan;
    private final Function<BusSettings, Bus> opener;
    private final AppReport report;

    /** @param opener opens the bus, under the name of this node */
    AppOverBus(Path file, ApplicationPlan plan, Function<BusSettings, Bus> opener, AppReport report) {
        this.file = file;
        this.plan = plan;
        this.opener = opener;
        this.report = report;
    }

    /**
     * Runs until {@code stop} returns true; on the first node no longer than the given time. Rethrows the failure that
     * ended the application.
     */
    void run(double seconds, BooleanSupplier stop) throws InterruptedException {
        Clock clock = Clock.system();
        long beganNanos = clock.nanos();
        report.watch(() -> (clock.nanos() - beganNanos) / 1_000);
        try (var space = new AppSpace(file, clock);
                var bus = opener.apply(BusSettings.on(space.space()).withObserver(new Losses(report)))) {
            if (plan.nodes().getFirst().equals(bus.node())) {
                runApplication(space, bus, () -> stop.getAsBoolean() || clock.nanos() - beganNanos >= seconds * 1e9);
            } else {
                serve(space, bus, stop);
            }
        }
    }

    private void runApplication(AppSpace space, Bus bus, BooleanSupplier stop) throws InterruptedException {
        var application = space.start(plan, bus, report);
        try {
            space.awaitStarted(application);
            while (!stop.getAsBoolean() && !space.hasFailed()) {
                Thread.sleep(POLL);
            }
        } finally {
            space.stop(application);
        }
        space.rethrowFailure();
        report.summary(plan.name());
    }

    private void serve(AppSpace space, Bus bus, BooleanSupplier stop) throws InterruptedException {
        var settings = ApplicationSettings.defaults()
                .withBroker(BrokerSettings.defaults().withObserver(event -> onBroker(event, bus.node())))
                .withComponentObserver(report)
                .withObserver(event -> {});
        var node = space.call(() -> ApplicationNode.open(plan, bus, settings));
        report.serves(bus.node(), plan.componentsOn(bus.node()), plan.name());
        try {
            while (!stop.getAsBoolean() && !space.hasFailed()) {
                Thread.sleep(POLL);
            }
        } finally {
            space.stop(node::closeAsync);
        }
        space.rethrowFailure();
    }

    /** Reports what becomes of the components of this node; those of other nodes are reported there. */
    private void onBroker(BrokerEvent event, String node) {
        switch (event) {
            case BrokerEvent.Started(ServiceRecord provider)
            when isOn(node, provider) -> report.state("started", provider.provider());
            case BrokerEvent.Stopped(ServiceRecord provider)
            when isOn(node, provider) -> report.state("stopped", provider.provider());
            case BrokerEvent.StopFailed(ServiceRecord provider, Throwable why)
            when isOn(node, provider) -> report.problem(provider.provider(), "could not be terminated", why);
            default -> {
                // on the way to one of these, or reported as a problem of the component
            }
        }
    }

    private static boolean isOn(String node, ServiceRecord provider) {
        return provider.provider().node().equals(node);
    }

    /** Reports losses. Control messages are left out: their senders get the error, and report it. */
    private record Losses(AppReport report) implements BusObserver {
        @Override
        public void lost(Loss loss) {
            if (!(loss instanceof Loss.Undeliverable message && message.message() instanceof BusMessage.Control)) {
                report.lost(loss);
            }
        }

        @Override
        public void disconnected(String why) {
            report.connection("cut off", why);
        }

        @Override
        public void connected() {
            report.connection("connected", "to the other nodes again");
        }
    }
}
