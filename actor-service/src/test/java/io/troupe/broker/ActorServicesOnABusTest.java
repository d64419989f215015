package io.troupe.broker;

import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BytePipe;

/** The contract of actor services in a process that could reach others: nothing differs for its own actors. */
class ActorServicesOnABusTest extends ActorServicesTest {
    @Override
    ActorServices open() {
        Bus bus = new BytePipe(test.space()).open("node", BusSettings.on(test.space()));
        broker = Broker.over(bus, test.space(), WITHOUT_RESTART.withObserver(this::record));
        return broker.services();
    }
}
