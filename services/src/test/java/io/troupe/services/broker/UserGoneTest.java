package io.troupe.services.broker;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import java.util.List;
import org.junit.jupiter.api.Test;

/** A connection ends with the actor that made it. */
class UserGoneTest {
    /** Connects when it is told to. */
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
