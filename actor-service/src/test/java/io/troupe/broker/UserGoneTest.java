package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import java.util.List;
import org.junit.jupiter.api.Test;

/** A connection ends when the actor that opened it stops. */
class UserGoneTest {
    /** An actor that connects when its method is called. */
    interface Joiner {
        void join();
    }

    @Test
    void actorThatHasConnected_andStops_isConnectedNoMore() {
        try (var test = new BrokerBench()) {
            test.offer("parrot", "a");
            var user = test.test.spawn(Joiner.class, () -> new User(test));
            user.join();
            test.test.crank();
            test.test.space().stop(user);
            test.test.crank();
            test.test.get(test.broker.replace(
                    BrokerBench.at("a"), "parrot", List.of(), BrokerBench.at("b"), test.provider("b")));
            assertThat(test.diary).containsExactly("start a", "user uses a", "start b", "stop a");
            assertThat(test.events(BrokerEvent.UserGone.class)).hasSize(1);
        }
    }

    @Test
    void providerThatFails_whenItsUserHasStopped_isNotFollowedByAnother() {
        try (var test = new BrokerBench()) {
            var a = test.offer("parrot", "a");
            test.offer("parrot", "b");
            var user = test.test.spawn(Joiner.class, () -> new User(test));
            user.join();
            test.test.crank();
            test.test.space().stop(user);
            test.test.crank();
            a.die("power");
            test.seconds(100);
            assertThat(test.diary).containsExactly("start a", "user uses a");
            assertThat(test.events(BrokerEvent.FailedOver.class)).isEmpty();
            assertThat(test.events(BrokerEvent.Lost.class)).isEmpty();
            assertThat(test.events(BrokerEvent.UserGone.class)).hasSize(1);
        }
    }

    @Test
    void providerThatFails_isNotStartedAgain_forAUserThatHasStoppedMeanwhile() {
        try (var test = new BrokerBench()) {
            var a = test.offer("parrot", "a");
            var user = test.test.spawn(Joiner.class, () -> new User(test));
            user.join();
            test.test.crank();
            a.die("power");
            test.test.crank(); // the client waits for another start
            test.test.space().stop(user);
            test.seconds(100);
            assertThat(test.diary).containsExactly("start a", "user uses a");
        }
    }

    @Test
    void usersThatCameAndWent_areForgotten_whenOthersConnect() {
        try (var test = new BrokerBench()) {
            test.offer("parrot", "a");
            for (int i = 0; i < 200; i++) {
                var user = test.test.spawn(Joiner.class, () -> new User(test));
                user.join();
                test.test.crank();
                test.test.space().stop(user);
                test.test.crank();
            }
            assertThat(test.events(BrokerEvent.UserGone.class)).hasSizeGreaterThan(100);
        }
    }

    private static final class User extends Actor implements Joiner, Broker.Connection {
        private final BrokerBench bench;

        User(BrokerBench bench) {
            this.bench = bench;
        }

        @Override
        public void join() {
            bench.broker.connect(Need.ofService("robot 1", "parrot"), this);
        }

        @Override
        public void use(ServiceRecord provider) {
            bench.diary.add("user uses " + provider.provider().name());
        }

        @Override
        public void lost(MissingServiceException why) {}
    }
}
