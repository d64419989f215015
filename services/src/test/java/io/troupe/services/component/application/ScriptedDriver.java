package io.troupe.services.component.application;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics;
import io.troupe.services.component.kinds.RobotTopics.SonarReading;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * A component that outputs one fixed velocity for each sonar reading, answers control signals as scripted by a test,
 * and can output the velocity without a reading.
 */
final class ScriptedDriver {
    private final String name;
    private final Velocity wanted;
    final List<String> calls = new ArrayList<>();
    private ComponentCommunication.@Nullable Signals<? super Velocity> signals;
    Supplier<Promise<@Nullable Void>> invoke = Promise::done;
    Supplier<Promise<@Nullable Void>> terminate = Promise::done;
    Supplier<Promise<@Nullable Void>> health = Promise::done;

    ScriptedDriver(String name, Velocity wanted) {
        this.name = name;
        this.wanted = wanted;
    }

    /** A promise that the test settles later, or never. */
    static Deferred<@Nullable Void> later() {
        return new Deferred<>();
    }

    Component<?, ?> component() {
        return new Component<>(
                "driving",
                List.of(),
                List.of(RobotTopics.sonar(name)),
                List.of(RobotTopics.velocity(name)),
                Communication::new,
                new Ranges(),
                Buffering.STREAM,
                Buffering.STREAM);
    }

    /** Outputs the velocity without a reading. */
    void drive() {
        if (signals == null) {
            throw new IllegalStateException(name + " was not invoked");
        }
        signals.data(wanted);
    }

    private final class Communication implements ComponentCommunication<SonarReading, Velocity> {
        @Override
        public Promise<@Nullable Void> invoke(Signals<? super Velocity> newSignals) {
            calls.add("invoke");
            signals = newSignals;
            return invoke.get();
        }

        @Override
        public Promise<@Nullable Void> terminate() {
            calls.add("terminate");
            return terminate.get();
        }

        @Override
        public Promise<@Nullable Void> health() {
            return health.get();
        }

        @Override
        public void data(SonarReading input) {
            drive();
        }
    }

    private final class Ranges implements Conversion<SonarReading, Velocity> {
        @Override
        public List<ApplicationData<?>> toApplication(Velocity output) {
            return List.of(new ApplicationData<>(RobotTopics.velocity(name), output));
        }

        @Override
        public SonarReading toComponent(ApplicationData<?> input) {
            return (SonarReading) input.value();
        }
    }
}
