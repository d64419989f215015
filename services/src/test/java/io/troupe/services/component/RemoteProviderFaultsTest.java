package io.troupe.services.component;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Promise;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.broker.Health;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ProviderException;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.BusPort;
import io.troupe.bus.BusTimeoutException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.NullSource;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Components controlled over the bus that are slow, hang, or end. The limit of their control messages is shorter than
 * the limits of the broker.
 */
class RemoteProviderFaultsTest extends ComponentBench {
    private static final Duration LIMIT = Duration.ofSeconds(1);
    private static final Need COUNTING = Need.ofService("user", "counting");

    private final Broker broker = Broker.open(
            test.space(),
            BrokerSettings.defaults()
                    .withCheckEvery(Duration.ofSeconds(1))
                    .withCheckLimit(Duration.ofSeconds(5))
                    .withMissedChecks(3)
                    .withObserver(event -> {}));
    private final BusPort control = bus.attach("control");
    private final List<String> heard = new ArrayList<>();
    private final ScriptedComponent<String, String> first = ScriptedComponent.counter();
    private final ComponentInterface<?, ?> firstInterface = offer("first", first);
    private final ComponentInterface<?, ?> secondInterface = offer("second", ScriptedComponent.counter());

    @AfterEach
    void brokerIsShutDown() {
        test.get(broker.shutDown());
    }

    private ComponentInterface<?, ?> offer(String name, ScriptedComponent<String, String> script) {
        var component = script.component("counting", ScriptedComponent.IN, ScriptedComponent.OUT);
        var provider = open(name, component, notes);
        test.get(broker.register("counting", List.of(), provider.address(), remote(provider)));
        return provider;
    }

    private RemoteProvider remote(ComponentInterface<?, ?> provider) {
        return new RemoteProvider(control, provider.address(), LIMIT);
    }

    private void connect() {
        test.get(broker.connect(COUNTING, new Broker.Connection() {
            @Override
            public void use(ServiceRecord provider) {
                heard.add("use " + provider.provider().name());
            }

            @Override
            public void lost(MissingServiceException why) {
                heard.add("lost");
            }
        }));
        assertThat(heard).containsExactly("use first");
    }

    private void seconds(int count) {
        for (int i = 0; i < count; i++) {
            test.runQueued();
            test.advance(Duration.ofSeconds(1));
        }
    }

    private Health health(int component) {
        return test.get(broker.registered()).get(component).health();
    }

    @Test
    void startThatTakesTooLong_isTerminated_andNeverRunsBesideTheNextProvider() {
        var slow = ScriptedComponent.later();
        first.invoke = () -> slow;
        var required = broker.require(COUNTING);
        seconds(1);
        assertThat(test.get(required).provider().name()).isEqualTo("second");
        assertThat(first.calls).containsExactly("invoke", "terminate");
        test.run(() -> slow.resolve(null));
        assertThat(first.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(firstInterface.state()).isEqualTo(ComponentState.TERMINATED);
        assertThat(secondInterface.state()).isEqualTo(ComponentState.RUNNING);
        assertThat(notes.take()).doesNotContain("first RUNNING").contains("second RUNNING");
    }

    @Test
    void healthThatHangs_makesItSuspect_andFailedOnlyAfterSoManyMisses() {
        connect();
        first.health = ScriptedComponent::later;
        seconds(2); // checked after one second, overdue after another
        assertThat(health(0)).isEqualTo(Health.SUSPECT);
        first.health = Promise::done;
        seconds(1);
        assertThat(health(0)).as("it answers in time again").isEqualTo(Health.WELL);
        first.health = ScriptedComponent::later;
        seconds(2);
        assertThat(health(0)).isEqualTo(Health.SUSPECT);
        seconds(3);
        assertThat(health(0)).isEqualTo(Health.SUSPECT);
        assertThat(heard).containsExactly("use first");
        seconds(1);
        assertThat(health(0)).isEqualTo(Health.FAILED);
        assertThat(heard).containsExactly("use first", "use second");
        assertThat(first.calls).containsExactly("invoke", "terminate");
    }

    @ParameterizedTest
    @NullSource
    @ValueSource(strings = {"", " "})
    void failureWithoutAMessage_isAFailure(String message) {
        connect();
        first.health = () -> Promise.failed(new IllegalStateException(message));
        seconds(1);
        assertThat(health(0)).isEqualTo(Health.FAILED);
        assertThat(heard).containsExactly("use first", "use second");
    }

    @Test
    void componentThatHasLeftTheBus_isFailedOverWithTheNextCheck() {
        connect();
        test.run(firstInterface::close);
        assertThat(heard).as("nobody has told the broker").containsExactly("use first");
        seconds(1);
        assertThat(heard).containsExactly("use first", "use second");
        assertThat(health(0)).isEqualTo(Health.FAILED);
    }

    @Test
    void timeOut_isOverdue_andNamesWhoWasAskedForWhat() {
        first.invoke = ScriptedComponent::later;
        var remote = remote(firstInterface);
        var started = remote.start();
        test.runQueued();
        test.advance(LIMIT);
        assertThat(test.error(started))
                .isInstanceOfSatisfying(
                        ProviderException.class,
                        error -> assertThat(error.mayHaveRun()).isTrue())
                .hasMessage("here/control asked here/first for component/invoke: no answer within PT1S")
                .hasCauseInstanceOf(BusTimeoutException.class);
        test.get(remote.stop());
    }
}
