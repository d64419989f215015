package io.troupe.services.bus;

class InProcessBusContractTest extends BusContract {
    private final InProcessBus bus = InProcessBus.open("robots", settings());

    @Override
    Bus near() {
        return bus;
    }

    @Override
    Bus far() {
        return bus;
    }

    @Override
    BusMetrics nearMetrics() {
        return bus.metrics();
    }

    @Override
    BusMetrics farMetrics() {
        return bus.metrics();
    }

    @Override
    void arrive() {} // nothing is under way
}
