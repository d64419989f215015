package io.troupe.demo.monitor;

import static java.util.Objects.requireNonNull;

import io.troupe.broker.BrokerEvent;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.BusObserver;
import io.troupe.bus.Loss;
import io.troupe.petri.wiring.ProtocolEvent;
import io.troupe.petri.wiring.WiringMonitor;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

/**
 * Follows an application: its components at the broker and what they publish, and each request on its bus, each through
 * its {@link LifecycleWirings declaration}.
 *
 * <p><b>Threads.</b> Any thread; one lock guards it.
 *
 * <p><b>Cost.</b> Memory for each provider and open request.
 *
 * <p><b>Errors.</b> The first violation is kept for {@link #check}. Providers are known by their names: one that gets
 * the name of another before that has stopped cannot be followed.
 */
public final class AppMonitor {
    private record Subject(LifecycleWirings kind, String name) {}

    private final boolean keepsEvents;
    private final Map<LifecycleWirings, WiringMonitor> starts = new EnumMap<>(LifecycleWirings.class);
    private final Map<Subject, WiringMonitor> subjects = new LinkedHashMap<>(); // guarded by this, as is the rest
    private final Map<LifecycleWirings, List<List<ProtocolEvent>>> over = new LinkedHashMap<>();
    private Optional<String> problem = Optional.empty();
    private long count;

    public AppMonitor() {
        this(false);
    }

    /** @param keepsEvents whether {@link #runs} is called */
    AppMonitor(boolean keepsEvents) {
        this.keepsEvents = keepsEvents;
        for (var kind : LifecycleWirings.values()) {
            var start = WiringMonitor.of(kind.wiring()).observing(kind.steps());
            starts.put(kind, keepsEvents ? start.keepingEvents() : start);
        }
    }

    /** One line that reports an application in which all was allowed. */
    public synchronized String summary() {
        return "monitor: " + count + " events of providers, components and messages, all as declared";
    }

    /** @throws IllegalStateException if there was a violation; the message is its story */
    public synchronized void check() {
        problem.ifPresent(story -> {
            throw new MonitorException(story);
        });
    }

    /** An application has left its declarations. */
    public static final class MonitorException extends IllegalStateException {
        private static final long serialVersionUID = 1;

        MonitorException(String story) {
            super(story);
        }
    }

    /** The sequences of events of all subjects of a kind. */
    synchronized List<List<ProtocolEvent>> runs(LifecycleWirings kind) {
        var found = new ArrayList<>(over.getOrDefault(kind, List.of()));
        subjects.forEach((subject, monitor) -> {
            if (subject.kind() == kind) {
                found.add(monitor.events());
            }
        });
        return found;
    }

    private synchronized void did(LifecycleWirings kind, String name, String step) {
        if (problem.isPresent()) {
            return;
        }
        var monitor = subjects.computeIfAbsent(
                new Subject(kind, name),
                each -> requireNonNull(starts.get(kind)).again());
        monitor.did(kind.component(), step);
        count++;
        problem = monitor.violation().map(violation -> kind.component() + " " + name + ": " + violation);
    }

    /** A message to all or to one, that is not answered; of a provider, it is part of its life. */
    private synchronized void sent(BusMessage message) {
        String from = message.from().toString();
        if (subjects.containsKey(new Subject(LifecycleWirings.PROVIDER, from))) {
            did(LifecycleWirings.PROVIDER, from, "sends");
        }
    }

    private synchronized void forget(String request) {
        var monitor = subjects.remove(new Subject(LifecycleWirings.REQUEST, request));
        if (keepsEvents && monitor != null) {
            over.computeIfAbsent(LifecycleWirings.REQUEST, each -> new ArrayList<>())
                    .add(monitor.events());
        }
    }

    /** An event of the broker. */
    public void onBroker(BrokerEvent event) {
        switch (event) {
            case BrokerEvent.Registered(ServiceRecord provider) -> provider(provider, "is registered");
            case BrokerEvent.Starting(ServiceRecord provider) -> provider(provider, "is being started");
            case BrokerEvent.Started(ServiceRecord provider) -> provider(provider, "has started");
            case BrokerEvent.StartFailed(ServiceRecord provider, Throwable why) ->
                provider(provider, "could not be started");
            case BrokerEvent.Suspect(ServiceRecord provider, Throwable why) -> provider(provider, "is suspect");
            case BrokerEvent.Recovered(ServiceRecord provider) -> provider(provider, "has recovered");
            case BrokerEvent.Failed(ServiceRecord provider, Throwable why) -> provider(provider, "has failed");
            case BrokerEvent.Stopped(ServiceRecord provider) -> provider(provider, "has stopped");
            case BrokerEvent.StopFailed(ServiceRecord provider, Throwable why) ->
                provider(provider, "could not be stopped");
            case BrokerEvent.Withdrawn(ServiceRecord provider) -> provider(provider, "leaves");
            case BrokerEvent.Replaced(ServiceRecord old, ServiceRecord by) -> provider(old, "leaves");
            default -> {
                // about clients and calls, or after the end of the broker
            }
        }
    }

    private void provider(ServiceRecord provider, String step) {
        did(LifecycleWirings.PROVIDER, provider.provider().toString(), step);
    }

    /** Observes the messages on a bus, and passes everything on. */
    public BusObserver bus(BusObserver inner) {
        return new BusObserver() {
            @Override
            public void passed(BusMessage message) {
                switch (message.purpose()) {
                    case Purpose.Request request ->
                        did(
                                LifecycleWirings.REQUEST,
                                message.sequence() + " of " + message.from() + " for " + request.operation(),
                                "is sent");
                    case Purpose.Reply reply ->
                        answered(reply.request() + " of " + reply.to() + " for " + reply.operation(), "is answered");
                    case Purpose.Rejection no ->
                        answered(no.request() + " of " + no.to() + " for " + no.operation(), "is rejected");
                    case Purpose.Publication publication -> sent(message);
                    case Purpose.Notice notice -> sent(message);
                }
                inner.passed(message);
            }

            @Override
            public void lost(Loss loss) {
                inner.lost(loss);
            }

            @Override
            public void failed(BusMessage request, Throwable error) {
                inner.failed(request, error);
            }

            @Override
            public void disconnected(String why) {
                inner.disconnected(why);
            }

            @Override
            public void connected() {
                inner.connected();
            }
        };
    }

    private void answered(String request, String step) {
        did(LifecycleWirings.REQUEST, request, step);
        did(LifecycleWirings.REQUEST, request, "is forgotten");
        forget(request);
    }
}
