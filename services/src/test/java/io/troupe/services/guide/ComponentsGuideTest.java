package io.troupe.services.guide;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Need;
import io.troupe.broker.ProviderException;
import io.troupe.bus.Bus;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.services.behaviour.SpaceWanderer;
import io.troupe.services.behaviour.WallFollower;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.ComponentInterface;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.application.Application;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationSettings;
import io.troupe.services.component.kinds.BehaviourComponent;
import io.troupe.services.component.kinds.PlayerComponent;
import io.troupe.services.subsumption.FakeRobots;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Runs the samples about components and applications in docs/guide/09-components.md. */
class ComponentsGuideTest {
    private final TestSpace test = new TestSpace();
    private final Bus bus = Bus.inProcess("house", BusSettings.on(test.space()));
    private final Broker broker =
            Broker.open(test.space(), BrokerSettings.defaults().withObserver(event -> {}));
    private final List<String> shown = new ArrayList<>();

    record Temperature(double celsius) {}

    record Label(String text) {}

    static final BusTopic<Temperature> TEMPERATURE = new BusTopic<>("hall/temperature", Temperature.class);
    static final BusTopic<Label> LABEL = new BusTopic<>("hall/label", Label.class);

    /** A third-party package with its own data format and a callback. */
    private static final class Thermometer {
        private boolean on;
        private String label = "";
        private Consumer<Double> reader = fahrenheit -> {};

        void switchOn(Consumer<Double> newReader) {
            on = true;
            reader = newReader;
        }

        void switchOff() {
            on = false;
        }
    }

    private record ThermometerCommunication(Thermometer thermometer) implements ComponentCommunication<String, Double> {
        @Override
        public Promise<@Nullable Void> invoke(Signals<? super Double> signals) {
            thermometer.switchOn(fahrenheit -> signals.data(fahrenheit));
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> terminate() {
            thermometer.switchOff();
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> health() {
            return thermometer.on ? Promise.done() : Promise.failed(new ProviderException("the thermometer is off"));
        }

        @Override
        public void data(String label) {
            thermometer.label = label;
        }
    }

    static final class Celsius implements Conversion<String, Double> {
        @Override
        public List<ApplicationData<?>> toApplication(Double fahrenheit) {
            return List.of(new ApplicationData<>(TEMPERATURE, new Temperature((fahrenheit - 32) / 1.8)));
        }

        @Override
        public String toComponent(ApplicationData<?> label) {
            return ((Label) label.value()).text();
        }
    }

    @AfterEach
    void nothingIsLeft() {
        test.get(broker.closeAsync());
        bus.close();
        test.runQueued();
        test.close();
    }

    private void show(String text) {
        shown.add(text);
    }

    @Test
    void foreignPackage_becomesAService() {
        var thermometer = new Thermometer();
        test.run(() -> {
            var component = new Component<>(
                    "thermometer",
                    List.of("senses"),
                    List.of(LABEL),
                    List.of(TEMPERATURE),
                    () -> new ThermometerCommunication(thermometer),
                    new Celsius(),
                    Buffering.LATEST,
                    Buffering.STREAM);
            var hall = ComponentInterface.open(bus, "hall", component, ComponentObserver.logging());
            broker.register("thermometer", List.of("senses"), hall.address(), hall::newLife);
        });
        test.run(() -> {
            BusPort display = bus.attach("display");
            display.subscribe(TEMPERATURE, (temperature, from) -> show(from + ": " + temperature.celsius()));
            display.publish(LABEL, new Label("outside"));
        });
        test.get(broker.require(Need.ofCapability("guide", "senses")));
        test.run(() -> thermometer.reader.accept(212.0));
        assertThat(shown).last().isEqualTo("house/hall: 100.0");
        test.run(() -> bus.attach("other").publish(LABEL, new Label("inside")));
        assertThat(thermometer.label).isEqualTo("inside");
    }

    @Test
    void applicationInCode_drivesTwoRobots() {
        var robots = new FakeRobots(test, 2);
        var started = new ArrayList<Application>();
        test.run(() -> {
            var plan = ApplicationPlan.named("two-robots")
                    .with("robots", robots())
                    .with("follower", follower())
                    .with("wanderer", wanderer())
                    .needing("two-robots", "player")
                    .needing("robot1", "wallFollower")
                    .needing("robot2", "spaceWanderer");
            var application = Application.start(plan, bus, ApplicationSettings.defaults());
            started.add(application);
        });
        test.get(started.getFirst().started());
        robots.tick(100);
        assertThat(robots.lastCommand(0)).isEqualTo(FakeRobots.ahead(0.2));
        assertThat(robots.lastCommand(1)).isEqualTo(FakeRobots.ahead(0.5));
        test.get(started.getFirst().closeAsync());
        robots.close();
    }

    private static Component<?, ?> robots() {
        return PlayerComponent.of(PlayerComponent.Settings.of("localhost", FakeRobots.PORT, List.of(1, 2))
                .withCamera(true));
    }

    private static Component<?, ?> follower() {
        return BehaviourComponent.of(
                "follower", "wallFollower", List.of("drives"), () -> WallFollower.behaviour(CornerStyle.FORWARD));
    }

    private static Component<?, ?> wanderer() {
        return BehaviourComponent.of("wanderer", "spaceWanderer", List.of("drives"), SpaceWanderer::behaviour);
    }
}
