package io.troupe.bus.nats;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BusTopic;
import io.troupe.bus.Loss;
import io.troupe.bus.Operation;
import java.time.Duration;
import java.util.Objects;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

/** Compiles the samples of the pages on the bus over hosts, and runs them at a real server. */
class NatsSamplesTest extends NatsTest {
    record Temperature(double celsius) {}

    record Setpoint(double celsius) {}

    record Accepted(boolean heats) {}

    record Velocity(double forwardMps, double turnRadps) {}

    static final BusTopic<Temperature> OUTSIDE = new BusTopic<>("house/outside", Temperature.class);

    static final BusTopic<Velocity> DRIVE =
            new BusTopic<>("robot1/drive", Velocity.class).withCapacity(1).withMaxAge(Duration.ofMillis(300));

    static final Operation<Setpoint, Accepted> HEAT =
            new Operation<>("heat", Setpoint.class, Accepted.class, Operation.Kind.CONTROL);

    private void show(Object what) {
        events.add(String.valueOf(what));
    }

    @Test
    void nodeOfARobot_answersAnother() throws Exception {
        try (var server = NatsServer.start()) {
            String address = server.address();

            Bus bus = NatsBus.open("robot1", NatsSettings.at(address), BusSettings.on(space));
            BusPort port = bus.attach("driver");
            port.answer(HEAT, setpoint -> Promise.of(new Accepted(setpoint.celsius() > 15)));

            var asked = open("base", NatsSettings.at(address))
                    .attach("asker")
                    .ask(new Address("robot1", "driver"), HEAT, new Setpoint(21), LONG);
            assertThat(asked.get(LONG).heats()).isTrue();
            bus.close();
        }
    }

    @Test
    void publication_reachesAnotherNode_byTheEngineOfNats_andByAnyEngine() throws Exception {
        try (var server = NatsServer.start()) {
            String address = server.address();
            var base = open("base", NatsSettings.at(address)).attach("display");
            base.answer(SPELL, NatsTest::spell);
            base.subscribe(OUTSIDE, (temperature, from) -> show(from + ": " + temperature.celsius()));
            var probe = open("probe", NatsSettings.at(address)).attach("probe");
            assertThat(answer(probe, base.address())).as("it has subscribed").isEqualTo("number 7");

            try (Bus bus = NatsBus.open("robot1", NatsSettings.at(address), BusSettings.on(space))) {
                bus.attach("sensor").publish(OUTSIDE, new Temperature(-3));
            }
            assertThat(next(events)).isEqualTo("robot1/sensor: -3.0");

            BusEngine engine = new NatsEngine(NatsSettings.at(address));
            try (Bus bus = Bus.open("robot", engine, BusSettings.on(space))) {
                bus.attach("sensor").publish(OUTSIDE, new Temperature(-3));
            }
            assertThat(next(events)).isEqualTo("robot/sensor: -3.0");
        }
    }

    @Test
    void settings_areAValue_thatDoesNotShowThePassword() {
        String password = "secret";

        var settings =
                NatsSettings.at("nats://base:4222").withUser("robot1", password).withApplication("warehouse");

        assertThat(settings).hasToString("nats://base:4222, application warehouse, user robot1");
    }

    @Test
    void twoProcesses_driveARobot_andKnowWhenTheyAreCutOff() throws Exception {
        try (var server = NatsServer.start()) {
            String address = server.address();

            var settings = BusSettings.on(space).withObserver(new BusObserver() {
                @Override
                public void lost(Loss loss) {
                    show(loss);
                }

                @Override
                public void disconnected(String why) {
                    show("stop: " + why);
                }
            });
            Bus robot = NatsBus.open("robot1", NatsSettings.at(address), settings);
            BusPort wheels = robot.attach("wheels");
            wheels.subscribe(DRIVE, (velocity, from) -> show(velocity.forwardMps() + " m/s"));

            wheels.answer(SPELL, NatsTest::spell);
            Bus base = open("base", NatsSettings.at(address));
            var probe = base.attach("probe");
            assertThat(answer(probe, wheels.address())).as("it has subscribed").isEqualTo("number 7");

            BusPort driver = base.attach("driver");
            driver.publish(DRIVE, new Velocity(0.2, 0));

            assertThat(next(events)).isEqualTo("0.2 m/s");
            server.kill();
            assertThat(next(events)).isIn("stop: it is disconnected from " + address, "disconnected");
            robot.close();
        }
    }

    /** An engine that receives from elsewhere. */
    private static final class Radio implements BusEngine {
        private @Nullable Listener listener;

        void receive(byte[] received) {
            Listener listener = Objects.requireNonNull(this.listener);

            listener.frame(received);
        }

        @Override
        public void start(String node, long incarnation, Listener itsListener) {
            listener = itsListener;
        }

        @Override
        public String whyDisconnected() {
            return "it only receives";
        }

        @Override
        public int maxFrameBytes() {
            return 1_000;
        }

        @Override
        public void send(String node, long number, byte[] frame) {}

        @Override
        public void reply(String node, long incarnation, long number, byte[] frame) {}

        @Override
        public void publish(String topic, byte[] frame) {}

        @Override
        public void subscribe(String topic) {}

        @Override
        public void unsubscribe(String topic) {}

        @Override
        public void close() {}
    }

    @Test
    void engine_passesWhatItReceives() throws Exception {
        var radio = new Radio();
        open("robot", radio, settings);
        radio.receive(new byte[] {1, 2, 3});
        assertThat(next(losses)).startsWith("a frame of 3 bytes cannot be read");
    }
}
