package io.troupe.demo.app;

import io.troupe.actor.Clock;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.ComponentState;
import io.troupe.services.component.application.ApplicationNode;
import io.troupe.services.component.application.ApplicationPlan;
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
        var node = space.call(() -> ApplicationNode.open(plan, bus, new NodeObserver(report)));
        report.serves(bus.node(), plan.componentsOn(bus.node()), plan.name());
        try {
            while (!stop.getAsBoolean() && !space.hasFailed()) {
                Thread.sleep(POLL);
            }
        } finally {
            space.stop(node::stop);
        }
        space.rethrowFailure();
    }

    /** Reports the states of components too, because there is no broker on this node that does. */
    private record NodeObserver(AppReport report) implements ComponentObserver {
        @Override
        public void changed(Address component, ComponentState state) {
            switch (state) {
                case RUNNING -> report.state("started", component);
                case TERMINATED -> report.state("stopped", component);
                default -> {
                    // on the way to one of these, or reported as a problem
                }
            }
        }

        @Override
        public void dropped(Address component, ApplicationData<?> lost, long total) {
            report.dropped(component, lost, total);
        }

        @Override
        public void problem(Address component, String what, Throwable why) {
            report.problem(component, what, why);
        }

        @Override
        public void info(Address component, String what) {
            report.info(component, what);
        }
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
