package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.bus.Address;
import io.troupe.bus.Bus;
import io.troupe.bus.BusEngine;
import io.troupe.bus.BusSettings;
import io.troupe.bus.BytePipe;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/**
 * Compiles and runs the samples of docs/guide/07-actors-as-services.md, about the broker of
 * docs/guide/08-bus-and-broker.md, and of the API pages of the broker.
 */
class BrokerGuideTest {
    /** A component that only records its calls. */
    private final class Camera implements Provider {
        @Override
        public Promise<@Nullable Void> start() {
            shown.add("camera starts");
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> stop() {
            shown.add("camera stops");
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> check() {
            return Promise.done();
        }
    }

    private final List<String> shown = new ArrayList<>();
    private final TestSpace test = new TestSpace();
    private final ActorSpace space = test.space();

    @AfterEach
    void close() {
        test.runQueued();
        test.close();
    }

    private void show(Object what) {
        shown.add(String.valueOf(what));
    }

    @Test
    void registry_startsOnDemand_andTellsUsers() {
        var left = new Camera();
        var right = new Camera();
        var events = new ArrayList<BrokerEvent>();
        BrokerObserver observer = events::add;

        Broker broker = Broker.open(space, BrokerSettings.defaults().withObserver(observer));
        broker.register("camera", List.of("senses", "colour"), new Address("robot", "left"), left);
        broker.register("camera", List.of("senses"), new Address("robot", "right"), right);

        broker.find(Need.ofCapability("finder", "colour")).then(cameras -> show(cameras.size()));
        broker.require(Need.ofService("finder", "camera")).then(camera -> show(camera.provider()));
        test.runQueued();
        assertThat(shown).containsExactly("1", "camera starts", "robot/left");

        shown.clear();
        broker.connect(Need.ofService("finder", "camera"), new Broker.Connection() {
            public void use(ServiceRecord camera) {
                show("use " + camera.provider());
            }

            public void lost(MissingServiceException why) {
                show(why.getMessage());
            }
        });
        test.runQueued();
        broker.withdraw(new Address("robot", "left"));
        test.runQueued();
        assertThat(shown).containsExactly("use robot/left", "camera starts", "use robot/right", "camera stops");

        shown.clear();
        broker.require(Need.ofService("robot 2", "camrea"))
                .exceptionally(error -> {
                    show(error.getMessage());
                    throw new IllegalStateException("the application ends", error);
                })
                .handle((camera, error) -> null);
        test.runQueued();
        assertThat(shown)
                .containsExactly("\"robot 2\" needs the service \"camrea\", which no provider offers; "
                        + "did you mean \"camera\"? registered: camera (senses; well)");

        broker.closeAsync().then(left2 -> show(left2.size() + " did not stop"));
        test.runQueued();
        assertThat(shown).endsWith("camera stops", "0 did not stop");
    }

    interface Compass {
        void headings(Callback<Double> reader);

        Promise<Double> heading();
    }

    interface Helm {
        void turns(Callback<Double> reader);
    }

    /** Publishes headings; subscribes to turns. */
    static final class ShipCompass extends Actor implements Compass {
        private final List<Callback<Double>> readers = new ArrayList<>();
        private final ActorServices services;
        private @Nullable ActorConnection<Helm> helm;
        private double headingDegrees;

        ShipCompass(ActorServices services) {
            this.services = services;
        }

        @Override
        protected void started() {
            helm = services.connect(Helm.class, Need.ofService("compass", "helm"));
            helm.actor().turns((degrees, error) -> turn(degrees));
        }

        private void turn(double degrees) {
            headingDegrees += degrees;
            readers.forEach(reader -> reader.next(headingDegrees));
        }

        @Override
        public void headings(Callback<Double> reader) {
            readers.add(reader);
            reader.next(headingDegrees);
        }

        @Override
        public Promise<Double> heading() {
            return Promise.of(headingDegrees);
        }

        @Override
        protected void stopped() {
            helm.close();
        }
    }

    /** Publishes turns; subscribes to headings. */
    static final class ShipHelm extends Actor implements Helm {
        private final List<Callback<Double>> readers = new ArrayList<>();
        private final ActorServices services;
        private @Nullable ActorConnection<Compass> compass;
        private double headingDegrees = 90;

        ShipHelm(ActorServices services) {
            this.services = services;
        }

        @Override
        protected void started() {
            compass = services.connect(Compass.class, Need.ofService("helm", "compass"));
            compass.actor().headings((degrees, error) -> steer(degrees));
        }

        private void steer(double degrees) {
            headingDegrees = degrees;
            if (headingDegrees < 90) {
                readers.forEach(reader -> reader.next(30.0));
            }
        }

        @Override
        public void turns(Callback<Double> reader) {
            readers.add(reader);
            steer(headingDegrees);
        }

        @Override
        protected void stopped() {
            compass.close();
        }
    }

    @Test
    void twoActors_arePublisherAndSubscriberOfEachOther() {
        Broker broker = Broker.open(space, BrokerSettings.defaults().withObserver(event -> {}));

        var services = broker.services();
        services.publish(space, Compass.class, "compass", List.of("senses"), () -> new ShipCompass(services));
        services.publish(space, Helm.class, "helm", List.of("steers"), () -> new ShipHelm(services));

        var compass = services.connect(Compass.class, Need.ofService("captain", "compass"));
        compass.actor().heading().then(degrees -> show(degrees));
        test.runQueued();
        assertThat(test.get(compass.actor().heading())).isEqualTo(90.0); // headings 0, 30, 60 and 90; then it stops
        assertThat(test.get(broker.registered()))
                .extracting(ServiceRecord::health)
                .containsOnly(Health.WELL);
        compass.close();
        test.get(broker.closeAsync());
    }

    @Test
    void serviceThatTakesLong_hasNoLimit_andItsReplacementTakesOver() {
        Broker broker = Broker.open(space, BrokerSettings.defaults().withObserver(event -> {}));
        var services = broker.services();
        services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));

        var patient = ConnectionSettings.defaults()
                .withWaitLimit(Duration.ofSeconds(20))
                .withoutAnswerLimit();
        var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"), patient)
                .actor();
        greeter.greet("Ada").then(text -> show(text));
        test.runQueued();

        services.replace(
                new Address("test-space", "greeter"),
                space,
                Greeter.class,
                "greeter",
                List.of(),
                () -> name -> Promise.of("good morning " + name));
        test.runQueued();
        greeter.greet("Ada").then(text -> show(text));
        test.runQueued();
        assertThat(shown).containsExactly("hello Ada", "good morning Ada");
        test.get(broker.closeAsync());
    }

    @Test
    void fiveLines_publishAnActor_andCallItByItsName() throws Exception {
        var space = ActorSpace.create(SpaceSettings.named("ship"));
        var broker = Broker.open(space, BrokerSettings.defaults());
        var services = broker.services();
        services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
        var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"))
                .actor();
        show(greeter.greet("Ada").get(Duration.ofSeconds(10)));

        assertThat(shown).containsExactly("hello Ada");
        broker.closeAsync().get(Duration.ofSeconds(10));
        space.close();
    }

    @Test
    void observer_isNotifiedOfAFailover() {
        BrokerObserver observer = event -> {
            if (event instanceof BrokerEvent.FailedOver change) {
                show(change.from().provider() + " > " + change.to().provider());
            }
        };
        var settings = BrokerSettings.defaults()
                .withCheckEvery(Duration.ofMillis(500))
                .withMissedChecks(2)
                .withStartLimit(Duration.ofSeconds(20))
                .withObserver(observer);
        Broker broker = Broker.open(space, settings);
        var services = broker.services();
        services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
        services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hi " + name));
        var greeter = services.connect(Greeter.class, Need.ofService("guest", "greeter"));
        test.get(greeter.whenReady());
        test.get(broker.withdraw(new Address("test-space", "greeter")));
        assertThat(shown).containsExactly("test-space/greeter > test-space/greeter#2");
        greeter.close();
        test.get(broker.closeAsync());
    }

    interface Greeter {
        Promise<String> greet(String name);
    }

    @Test
    void reserve_comesAfterTheOthers() {
        var pipe = new BytePipe(space);
        try (Bus bus = pipe.open("a", BusSettings.on(space));
                Bus main = pipe.open("b", BusSettings.on(space))) {
            var reserve = Broker.over(
                    bus, space, BrokerSettings.defaults(), Sharing.defaults().withRank(1));
            var first = Broker.over(main, space, BrokerSettings.defaults());
            for (var broker : List.of(reserve, first)) {
                broker.services()
                        .publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
            }
            test.runQueued();
            assertThat(test.get(reserve.find(Need.ofService("guest", "greeter"))))
                    .extracting(each -> each.provider().node())
                    .containsExactly("b", "a");
            test.get(reserve.closeAsync());
            test.get(first.closeAsync());
        }
    }

    @Test
    void actor_ofAnotherProcess_isCalledLikeOneOfThisProcess() {
        var pipe = new BytePipe(space);
        BusEngine engine = pipe.engine();
        var bus = Bus.open("ship", engine, BusSettings.on(space));
        var broker = Broker.over(bus, space, BrokerSettings.defaults());
        var services = broker.services();
        services.publish(space, Greeter.class, "greeter", List.of(), () -> name -> Promise.of("hello " + name));
        test.runQueued();
        try (Bus shore = pipe.open("shore", BusSettings.on(space))) {
            var there = Broker.over(shore, space, BrokerSettings.defaults().withObserver(event -> {}));
            var onShore = there.services();
            var greeter = onShore.connect(Greeter.class, Need.ofService("guest", "greeter"))
                    .actor();
            assertThat(test.get(greeter.greet("Ada"))).isEqualTo("hello Ada");
            test.get(there.closeAsync());
        }
        test.get(broker.closeAsync());
        bus.close();
    }
}
