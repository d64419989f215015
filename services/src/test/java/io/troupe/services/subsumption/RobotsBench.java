package io.troupe.services.subsumption;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Clock;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.common.text.NamedColours;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Velocity;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;

/** Base of tests with two fake robots: records which services drive them, and the states of an arbitrator. */
abstract class RobotsBench {
    static final Service WF = Service.WALL_FOLLOWER;
    static final Service SW = Service.SPACE_WANDERER;
    static final DeviceCommand.Velocity FOLLOWER_AHEAD = FakeRobots.ahead(0.2);
    static final DeviceCommand.Velocity WANDERER_AHEAD = FakeRobots.ahead(0.5);

    final TestSpace test = new TestSpace();
    final FakeRobots robots = new FakeRobots(test, 2);
    final Charge charge = new Charge();
    final List<String> events = Collections.synchronizedList(new ArrayList<>());
    final List<Throwable> failures = new ArrayList<>(); // that the broker reports

    /** Records which services drive which robot. */
    static final class Charge implements ServiceObserver {
        private final Map<Integer, List<Service>> inCharge = new TreeMap<>();
        private final Map<Integer, List<Velocity>> commanded = new TreeMap<>();
        int most; // services that a robot had at the same time
        int coloursSent;

        @Override
        public void serviceStarted(int robot, Service service) {
            var services = inCharge.computeIfAbsent(robot, each -> new ArrayList<>());
            services.add(service);
            most = Math.max(most, services.size());
        }

        @Override
        public void cycleEnded(int robot, Service service) {}

        @Override
        public void serviceEnded(int robot, Service service) {
            inCharge.get(robot).remove(service);
        }

        @Override
        public void commanded(int robot, Service service, Velocity velocity) {
            assertThat(of(robot)).containsExactly(service);
            commanded.computeIfAbsent(robot, each -> new ArrayList<>()).add(velocity);
        }

        @Override
        public void colourSent(int robot, int colour) {
            coloursSent++;
        }

        /** The speeds that were sent to a robot, as the services have reported them. */
        List<Velocity> commanded(int robot) {
            return List.copyOf(commanded.getOrDefault(robot, List.of()));
        }

        List<Service> of(int robot) {
            return List.copyOf(inCharge.getOrDefault(robot, List.of()));
        }
    }

    /** Records states and messages as events. */
    final class Events implements Arbitrator.StateListener {
        @Override
        public void stateStarted(State state, @Nullable Integer seenBy) {
            events.add("state " + state.number() + " by " + seenBy);
        }

        @Override
        public void colourReceived(int robot, int colour) {
            events.add(robot + " " + NamedColours.name(colour));
        }

        @Override
        public void colourTooLate(int robot, int colour) {
            events.add("too late");
        }
    }

    /** Services that take calls and never report anything. */
    static class SilentServices extends Actor implements RobotServices {
        @Override
        public Promise<Stamp> stamp() {
            throw new UnsupportedOperationException();
        }

        @Override
        public Promise<ServiceEnd> drive(Lease lease, int robot, String service, int stateColour) {
            throw new UnsupportedOperationException();
        }

        @Override
        public Promise<ServiceEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
            return new Deferred<>();
        }

        @Override
        public Promise<Renewal> renew(Lease lease, int robot) {
            throw new UnsupportedOperationException();
        }

        @Override
        public Promise<@Nullable Void> stop(Lease lease, int robot) {
            return Promise.done();
        }
    }

    @AfterEach
    void nothingIsLeft() {
        robots.close();
        test.runQueued();
        assertThat(failures).isEmpty();
        test.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        assertThat(charge.most).as("services of a robot at the same time").isLessThanOrEqualTo(1);
    }

    RobotServicesActor.Settings settings(SubsumptionTable table) {
        return RobotServicesActor.Settings.defaults()
                .withPort(FakeRobots.PORT)
                .withTable(table)
                .withObserver(charge);
    }

    /** The robots of services that are called through a broker. */
    LeasedRobots published(SubsumptionTable table) {
        return LeasedRobots.of(connected(table));
    }

    /** The services of a broker, each through its connection. */
    Map<String, RobotServices> connected(SubsumptionTable table) {
        var settings = settings(table);
        return SubsumptionRun.publishAndConnect(
                        test.space(), table, () -> new RobotServicesActor(settings), failures::add)
                .actors();
    }

    /** A call of robots, on the space. */
    <T extends @Nullable Object> Promise<T> call(Supplier<? extends Promise<T>> call) {
        var called = new ArrayList<Promise<T>>();
        test.run(() -> {
            try {
                called.add(call.get());
            } catch (RuntimeException refused) {
                called.add(Promise.failed(refused));
            }
        });
        return called.getFirst();
    }

    SubsumptionRun.Settings run(Mode mode, int port, SubsumptionTable table) {
        return SubsumptionRun.Settings.defaults()
                .withMode(mode)
                .withRobots(settings(table).withPort(port))
                .withClock(Clock.system())
                .withListener(new Events());
    }

    /** A table of one state. */
    static SubsumptionTable table(Service... services) {
        return SubsumptionTable.forRobots(services.length)
                .state(NamedColours.BLUE, services)
                .allowFinal()
                .build();
    }

    /** The states as "number by robot". */
    List<String> states() {
        return List.copyOf(events).stream()
                .filter(event -> event.startsWith("state "))
                .map(event -> event.substring("state ".length()))
                .toList();
    }

    void assertInCharge(Service first, Service second) {
        assertThat(List.of(charge.of(0), charge.of(1))).containsExactly(List.of(first), List.of(second));
    }

    void assertLastCommands(DeviceCommand.Velocity first, DeviceCommand.Velocity second) {
        assertThat(List.of(robots.lastCommand(0), robots.lastCommand(1))).containsExactly(first, second);
    }
}
