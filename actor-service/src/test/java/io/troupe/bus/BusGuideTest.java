package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Compiles and runs the samples of the API pages of the bus. */
class BusGuideTest {
    record Temperature(double celsius) {}

    record Setpoint(double celsius) {}

    record Accepted(boolean heats) {}

    static final BusTopic<Temperature> OUTSIDE = new BusTopic<>("house/outside", Temperature.class);

    static final Operation<Setpoint, Accepted> HEAT =
            new Operation<>("heat", Setpoint.class, Accepted.class, Operation.Kind.CONTROL);

    record Velocity(double forwardMps, double turnRadps) {}

    static final BusTopic<Velocity> DRIVE =
            new BusTopic<>("robot1/drive", Velocity.class).withCapacity(1).withMaxAge(Duration.ofMillis(300));

    private final List<String> shown = new ArrayList<>();

    private void show(Object what) {
        shown.add(String.valueOf(what));
    }

    @Test
    void ports_publishAndSubscribe_askAndAnswer() {
        try (var test = new TestSpace()) {
            var space = test.space();

            Bus bus = Bus.inProcess("house", BusSettings.on(space));
            BusPort sensor = bus.attach("sensor");
            BusPort display = bus.attach("display");
            display.subscribe(OUTSIDE, (temperature, from) -> show(from + ": " + temperature.celsius()));
            sensor.publish(OUTSIDE, new Temperature(-3));

            test.runQueued();
            assertThat(shown).containsExactly("house/sensor: -3.0");
            shown.clear();

            bus.attach("heating").answer(HEAT, setpoint -> Promise.of(new Accepted(setpoint.celsius() > 15)));
            var heating = new Address("house", "heating");
            var limit = Duration.ofSeconds(1);
            display.ask(heating, HEAT, new Setpoint(21), limit).then(accepted -> show(accepted.heats()));

            test.runQueued();
            assertThat(shown).containsExactly("true");
            bus.close();
        }
    }

    @Test
    void values_areForwarded_withTheirAge() {
        var wheels = new BusTopic<>("robot1/wheels", Velocity.class).withMaxAge(Duration.ofMillis(300));
        try (var test = new TestSpace();
                var bus = Bus.inProcess("robot1", BusSettings.on(test.space()))) {
            BusPort hub = bus.attach("hub");
            hub.forward(DRIVE, wheels, (velocity, from) -> show(from + ": " + velocity.forwardMps()));
            hub.subscribe(wheels, (velocity, from) -> show(velocity.forwardMps()));
            bus.attach("driver").publish(DRIVE, new Velocity(0.2, 0));
            test.runQueued();
            assertThat(shown).containsExactly("robot1/driver: 0.2", "0.2");
        }
    }

    @Test
    void commands_keepOnlyTheLatest_andNoneThatIsOld() {
        try (var test = new TestSpace();
                var bus = Bus.inProcess("robot1", BusSettings.on(test.space()).withObserver(loss -> show(loss)))) {
            var wheels = bus.attach("wheels");
            wheels.subscribe(DRIVE, (velocity, from) -> show(velocity.forwardMps()));
            var driver = bus.attach("driver");
            driver.publish(DRIVE, new Velocity(0.1, 0));
            driver.publish(DRIVE, new Velocity(0.2, 0));
            test.runQueued();
            assertThat(shown).last().isEqualTo("0.2");
            assertThat(shown).doesNotContain("0.1");
            shown.clear();
            driver.publish(DRIVE, new Velocity(0.3, 0));
            test.clock().advance(Duration.ofSeconds(1));
            test.runQueued();
            assertThat(shown)
                    .containsExactly("robot1/wheels does not receive publication on robot1/drive from robot1/driver"
                            + " (number 3): it is 1000 ms old");
        }
    }

    @Test
    void slowSubscriber_losesTheOldestValues_andTheObserverIsNotified() {
        try (var test = new TestSpace()) {
            var space = test.space();

            var settings = BusSettings.on(space).withCapacity(2).withObserver(loss -> show(loss));
            Bus bus = Bus.inProcess("house", settings);

            bus.attach("display").subscribe(OUTSIDE, (temperature, from) -> {});
            BusPort sensor = bus.attach("sensor");
            for (int i = 0; i < 3; i++) {
                sensor.publish(OUTSIDE, new Temperature(i));
            }
            show(bus.metrics().dropped());

            test.runQueued();
            assertThat(shown)
                    .containsExactly(
                            "house/display is too slow: its oldest publication on house/outside from house/sensor"
                                    + " (number 1) was dropped, 1 so far",
                            "1");
            bus.close();
        }
    }
}
