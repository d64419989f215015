package io.troupe.services.component.application;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import io.troupe.broker.Broker;
import io.troupe.broker.BrokerSettings;
import io.troupe.bus.Bus;
import io.troupe.bus.BusSettings;
import io.troupe.player.wire.DeviceCommand;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ComponentState;
import io.troupe.services.component.RecordingObserver;
import io.troupe.services.component.kinds.PlayerComponent;
import io.troupe.services.subsumption.FakeRobots;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Providers of an application that hang or answer late: a robot has only one driver at a time. */
class ApplicationFaultsTest {
    private static final DeviceCommand.Velocity SLOW = new DeviceCommand.Velocity(0.1, 0, 0, true);
    private static final DeviceCommand.Velocity FAST = new DeviceCommand.Velocity(0.3, 0, 0, true);

    private final TestSpace test = new TestSpace();
    private final FakeRobots robots = new FakeRobots(test, 1);
    private final ScriptedDriver first = new ScriptedDriver("first", new Velocity(0.1, 0));
    private final ScriptedDriver next = new ScriptedDriver("next", new Velocity(0.3, 0));
    private final List<String> connected = new ArrayList<>();
    private Application application;

    @AfterEach
    void nothingIsLeft() {
        var stopped = application.stop();
        stopped.handle((ended, error) -> true);
        for (int second = 0; second < 20 && !stopped.isDone(); second++) {
            test.advance(Duration.ofSeconds(1)); // the limit for a hanging provider
        }
        assertThat(stopped.isDone()).isTrue();
        test.crank();
        robots.close();
        assertThat(robots.connections()).as("connections left open").isZero();
        test.close();
    }

    private void start() {
        var plan = ApplicationPlan.named("one-robot")
                .with("robots", PlayerComponent.of(new PlayerComponent.Settings("localhost", 7001, List.of(1), false)))
                .with("first", first.component())
                .with("next", next.component())
                .needing("one-robot", "player")
                .needing("robot1", "driving");
        test.run(() -> {
            application = Application.start(
                    plan,
                    Bus.inProcess("here", BusSettings.on(test.space())),
                    Broker.open(test.space(), BrokerSettings.DEFAULT.withObserver(event -> {})),
                    ApplicationSettings.DEFAULT.withObservers(new RecordingObserver(), this::note));
            application.started().handle((runs, error) -> error);
        });
    }

    private void note(ApplicationEvent event) {
        if (event instanceof ApplicationEvent.Connected it && it.need().by().equals("robot1")) {
            connected.add(it.provider().provider().name());
        }
    }

    /** The command that the robot receives in one tick. */
    private List<DeviceCommand.Velocity> commandsOfOneTick() {
        int before = robots.commands(0).size();
        robots.tick(100);
        return List.copyOf(robots.commands(0).subList(before, robots.commands(0).size()));
    }

    @Test
    void providerWhoseHealthHangs_isFailedOver_andTheRobotObeysTheNextOnly() {
        first.health = ScriptedDriver::later;
        first.terminate = ScriptedDriver::later; // control hangs, but the driver still outputs velocities
        start();
        test.get(application.started().thenApply(runs -> true));
        for (int tick = 1; tick < 60; tick++) {
            test.advance(Duration.ofMillis(100));
            assertThat(commandsOfOneTick()).as("commands of tick %d", tick).containsExactly(SLOW);
        }
        assertThat(connected).as("after two misses").containsExactly("first");
        test.advance(Duration.ofMillis(100)); // the third missed check: sent after 5 s, overdue after 6 s
        assertThat(connected).containsExactly("first", "next");
        int before = robots.commands(0).size();
        for (int tick = 61; tick < 120; tick++) {
            test.run(first::drive);
            assertThat(commandsOfOneTick()).as("commands of tick %d", tick).containsExactly(FAST);
            test.advance(Duration.ofMillis(100));
        }
        assertThat(robots.commands(0).subList(before, robots.commands(0).size()))
                .hasSize(59)
                .containsOnly(FAST);
        assertThat(first.calls).containsExactly("invoke", "terminate");
        assertThat(application.ended().isDone()).isFalse();
    }

    @Test
    void providerThatStartsLate_isNotWired_andIsTerminatedAgain() {
        var late = ScriptedDriver.later();
        first.invoke = () -> late;
        start();
        test.advance(Duration.ofSeconds(9));
        assertThat(connected).isEmpty();
        test.advance(Duration.ofSeconds(1));
        test.get(application.started().thenApply(runs -> true));
        assertThat(connected).containsExactly("next");
        test.run(() -> late.resolve(null));
        assertThat(first.calls).containsExactly("invoke", "terminate", "terminate");
        assertThat(application.componentInterface("first").state()).isEqualTo(ComponentState.TERMINATED);
        for (int tick = 1; tick <= 5; tick++) {
            test.run(first::drive);
            assertThat(commandsOfOneTick()).as("commands of tick %d", tick).containsExactly(FAST);
        }
        assertThat(robots.commands(0)).hasSize(5).containsOnly(FAST);
        assertThat(connected).containsExactly("next");
    }
}
