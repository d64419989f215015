package io.troupe.services.subsumption;

import io.troupe.bus.BusException;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTopic;
import io.troupe.services.behaviour.Velocity;

/**
 * What a provider of robot services on another host does with a robot: the events of a {@link ServiceObserver}, as a
 * value on the topic {@link #TOPIC}. The address of its publisher has the node.
 *
 * @param robotIndex Player index, from 0
 * @param service the name of the service; empty if a colour was sent
 * @param colour {@code 0x00RRGGBB}; 0 unless a colour was sent
 */
public record DriverReport(int robotIndex, String service, Event event, int colour) {
    /** The events of a {@link ServiceObserver}. */
    public enum Event {
        STARTED,
        CYCLE_ENDED,
        ENDED,
        COLOUR_SENT,
        LEASE_LOST
    }

    /** All reports of all providers. */
    public static final BusTopic<DriverReport> TOPIC = new BusTopic<>("robots/driver", DriverReport.class);

    /** Receives the reports of all providers. */
    @FunctionalInterface
    public interface Listener {
        /** @param node the provider's node */
        void reported(DriverReport report, String node);
    }

    /** Subscribes to the reports of all providers. */
    static void subscribe(BusPort port, Listener listener) {
        port.subscribe(TOPIC, (report, from) -> listener.reported(report, from.node()));
    }

    /** Notifies an observer of this report. */
    public void notify(ServiceObserver observer, SubsumptionTable table) {
        if (event == Event.COLOUR_SENT) {
            observer.colourSent(robotIndex, colour);
            return;
        }
        table.service(service).ifPresent(named -> {
            switch (event) {
                case STARTED -> observer.serviceStarted(robotIndex, named);
                case CYCLE_ENDED -> observer.cycleEnded(robotIndex, named);
                case ENDED -> observer.serviceEnded(robotIndex, named);
                case LEASE_LOST -> observer.leaseLost(robotIndex, named);
                case COLOUR_SENT -> {} // above
            }
        });
    }

    /** Publishes what an observer is notified of, and passes it on. */
    static final class Publisher implements ServiceObserver {
        private final BusPort port;
        private final ServiceObserver next;

        Publisher(BusPort port, ServiceObserver next) {
            this.port = port;
            this.next = next;
        }

        @Override
        public void serviceStarted(int robot, Service service) {
            next.serviceStarted(robot, service);
            publish(robot, service.name(), Event.STARTED, 0);
        }

        @Override
        public void cycleStarted(int robot, Service service) {
            next.cycleStarted(robot, service);
        }

        @Override
        public void commanded(int robot, Service service, Velocity velocity) {
            next.commanded(robot, service, velocity);
        }

        @Override
        public void cycleEnded(int robot, Service service) {
            next.cycleEnded(robot, service);
            publish(robot, service.name(), Event.CYCLE_ENDED, 0);
        }

        @Override
        public void serviceEnded(int robot, Service service) {
            next.serviceEnded(robot, service);
            publish(robot, service.name(), Event.ENDED, 0);
        }

        @Override
        public void leaseLost(int robot, Service service) {
            next.leaseLost(robot, service);
            publish(robot, service.name(), Event.LEASE_LOST, 0);
        }

        @Override
        public void colourSent(int robot, int colour) {
            next.colourSent(robot, colour);
            publish(robot, "", Event.COLOUR_SENT, colour);
        }

        private void publish(int robot, String service, Event event, int colour) {
            try {
                port.publish(TOPIC, new DriverReport(robot, service, event, colour));
            } catch (BusException closed) {
                System.getLogger(DriverReport.class.getName())
                        .log(System.Logger.Level.DEBUG, "not reported: the bus is closed", closed);
            }
        }
    }
}
