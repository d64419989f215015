package io.troupe.services.component;

import io.troupe.actor.promise.Promise;
import io.troupe.services.broker.Provider;
import io.troupe.services.broker.ProviderException;
import io.troupe.services.bus.Address;
import io.troupe.services.bus.BusPort;
import java.time.Duration;
import org.jspecify.annotations.Nullable;

/**
 * A component that is controlled by messages over the bus: its interface may be in another process.
 *
 * <p><b>Role.</b> Register it with a broker in place of the interface itself.
 * <p><b>Errors.</b> Those of {@link BusPort#ask}, and a {@link ProviderException} with the component's own report when it is not well.
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
        return port.ask(
                        component,
                        Control.INVOKE,
                        new Control.Invoke(port.address().toString()),
                        limit)
                .thenAccept(done -> {});
    }

    @Override
    public Promise<@Nullable Void> stop() {
        return port.ask(
                        component,
                        Control.TERMINATE,
                        new Control.Terminate(port.address().toString()),
                        limit)
                .thenAccept(done -> {});
    }

    @Override
    public Promise<@Nullable Void> check() {
        return port.ask(
                        component,
                        Control.HEALTH,
                        new Control.AskHealth(port.address().toString()),
                        limit)
                .thenAccept(report -> {
                    if (!report.isWell()) {
                        throw new ProviderException(report.problem());
                    }
                });
    }
}
