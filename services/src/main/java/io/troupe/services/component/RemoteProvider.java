package io.troupe.services.component;

import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.Provider;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.bus.Address;
import io.troupe.services.bus.BusPort;
import io.troupe.services.bus.BusTimeoutException;
import io.troupe.services.bus.Operation;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * A component that is controlled by messages over the bus: its interface may be in another process.
 *
 * <p><b>Role.</b> Register it with a broker in place of the interface itself.
 *
 * <p><b>Order.</b> It does not hear of the component's death: that is found out with the next {@link #check}.
 *
 * <p><b>Errors.</b> Those of {@link BusPort#ask}, but an overdue {@link ProviderException} when the limit is over, so
 * that a broker tells a component that starts late to stop, and one that does not answer for its health is suspect
 * first; and a {@link ProviderException} with the component's own report when it is not well.
 */
public final class RemoteProvider implements Provider {
    private final BusPort port;
    private final Address component;
    private final Duration limit;

    /**
     * @param port from which the control messages are sent
     * @param limit how long each may take
     */
    public RemoteProvider(BusPort port, Address component, Duration limit) {
        this.port = port;
        this.component = component;
        this.limit = limit;
    }

    @Override
    public Promise<@Nullable Void> start() {
        return ask(Control.INVOKE, new Control.Invoke(port.address().toString()))
                .thenAccept(done -> {});
    }

    @Override
    public Promise<@Nullable Void> stop() {
        return ask(Control.TERMINATE, new Control.Terminate(port.address().toString()))
                .thenAccept(done -> {});
    }

    @Override
    public Promise<@Nullable Void> check() {
        return ask(Control.HEALTH, new Control.AskHealth(port.address().toString()))
                .thenAccept(report -> {
                    if (!report.isWell()) {
                        throw new ProviderException(report.problem());
                    }
                });
    }

    /** The component works on what it was asked for although the limit is over, and a broker has to know that. */
    private <Q extends Record, A extends Record> Promise<A> ask(Operation<Q, A> operation, Q question) {
        return port.ask(component, operation, question, limit)
                .exceptionallyCompose(error -> Promise.failed(
                        error instanceof BusTimeoutException
                                ? ProviderException.overdue(String.valueOf(error.getMessage()), error)
                                : error));
    }
}
