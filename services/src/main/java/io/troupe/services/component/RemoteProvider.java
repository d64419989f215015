package io.troupe.services.component;

import io.troupe.actor.Promise;
import io.troupe.broker.Provider;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Address;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTimeoutException;
import io.troupe.bus.Operation;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * Controls a component by messages over the bus; the component's interface may be in another process.
 *
 * <p><b>Role.</b> Registered with a broker in place of the interface itself.
 *
 * <p><b>Order.</b> It is not notified when the component fails; a failure is found by the next {@link #check}. Its
 * messages name the life that it has started, so that a late one does not end, or vouch for, a later life.
 *
 * <p><b>Errors.</b> Those of {@link BusPort#ask}, except for two. When the limit is over, the promise is rejected with
 * {@link ProviderException#overdue}: the broker then stops a component that starts late, and first treats one that does
 * not answer a health check as suspect. If the component is not healthy, the promise is rejected with a
 * {@link ProviderException} that has the component's report.
 */
public final class RemoteProvider implements Provider {
    private final BusPort port;
    private final Address component;
    private final Duration limit;
    private final Duration checkLimit;
    private volatile long life; // of the component, as the last start has reported it; 0 = unknown

    /**
     * @param port port from which the control messages are sent
     * @param component address of the component
     * @param limit time limit of each control message
     */
    public RemoteProvider(BusPort port, Address component, Duration limit) {
        this(port, component, limit, limit);
    }

    /**
     * With limits below those of the broker.
     *
     * @param limit time limit of a start and of a termination
     * @param checkLimit time limit of a health check
     */
    public RemoteProvider(BusPort port, Address component, Duration limit, Duration checkLimit) {
        this.port = port;
        this.component = component;
        this.limit = limit;
        this.checkLimit = checkLimit;
    }

    @Override
    public Promise<@Nullable Void> start() {
        life = 0;
        return ask(Control.INVOKE, new Control.Invoke(port.address().toString()), limit)
                .thenAccept(done -> life = done.life());
    }

    @Override
    public Promise<@Nullable Void> stop() {
        return ask(Control.TERMINATE, new Control.Terminate(port.address().toString(), life), limit)
                .thenAccept(done -> {});
    }

    @Override
    public Promise<@Nullable Void> check() {
        return ask(Control.HEALTH, new Control.AskHealth(port.address().toString(), life), checkLimit)
                .thenAccept(report -> {
                    if (!report.isHealthy()) {
                        throw new ProviderException(report.problem());
                    }
                });
    }

    /** Converts a timeout to an overdue error, since the component may still complete the request after the limit. */
    private <Q extends Record, A extends Record> Promise<A> ask(Operation<Q, A> operation, Q request, Duration within) {
        return port.ask(component, operation, request, within)
                .exceptionallyCompose(error -> Promise.failed(
                        error instanceof BusTimeoutException
                                ? ProviderException.overdue(String.valueOf(error.getMessage()), error)
                                : error));
    }
}
