package io.troupe.services.component.application;

import io.troupe.services.broker.Broker;
import io.troupe.services.broker.MissingServiceException;
import io.troupe.services.broker.Need;
import io.troupe.services.broker.ServiceRecord;
import io.troupe.services.bus.BusPort;
import java.util.List;
import java.util.function.Consumer;

/**
 * Connection of one need in a running application: connects the topics of the user with those of the provider that the
 * broker selects.
 */
final class Usage implements Broker.Connection {
    /** Listener for a need that is not met any more. */
    interface Losses {
        void lost(Usage usage, MissingServiceException why);

        /** The provider cannot be connected, because another one feeds the same topic. */
        void clash(ApplicationException why);
    }

    private final Need need;
    private final TopicWiring wiring;
    private final Consumer<ApplicationEvent> observer;
    private final Losses losses;
    private List<BusPort.Subscription> open = List.of();
    private int timesMet;

    Usage(Need need, TopicWiring wiring, Consumer<ApplicationEvent> observer, Losses losses) {
        this.need = need;
        this.wiring = wiring;
        this.observer = observer;
        this.losses = losses;
    }

    Need need() {
        return need;
    }

    /**
     * Number of providers it has been connected with. If the number is the same as at a loss, there has been no
     * provider since.
     */
    int timesMet() {
        return timesMet;
    }

    @Override
    public void use(ServiceRecord provider) {
        var wires = wiring.wiresBetween(need.by(), provider.provider().name());
        try {
            wiring.release(need);
            wiring.claim(need, wires);
        } catch (ApplicationException clash) {
            losses.clash(clash);
            return;
        }
        disconnect(); // in the same turn, so that every value sees exactly one provider
        open = wiring.open(wires);
        timesMet++;
        observer.accept(new ApplicationEvent.Connected(need, provider, wires));
    }

    @Override
    public void lost(MissingServiceException why) {
        disconnect();
        wiring.release(need);
        losses.lost(this, why);
    }

    void disconnect() {
        open.forEach(BusPort.Subscription::close);
        open = List.of();
    }
}
