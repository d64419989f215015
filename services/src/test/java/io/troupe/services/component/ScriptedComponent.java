package io.troupe.services.component;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.bus.BusTopic;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A component that is scripted by a test. Its input and output are texts; the application's values are numbers. */
final class ScriptedComponent {
    /** A value of the application. */
    record Number(int value) {}

    static final BusTopic<Number> IN = new BusTopic<>("counter/in", Number.class);
    static final BusTopic<Number> OUT = new BusTopic<>("counter/out", Number.class);

    final List<String> calls = new ArrayList<>();
    final List<ComponentCommunication.Signals<? super String>> runs = new ArrayList<>();
    Supplier<Promise<@Nullable Void>> invoke = Promise::done;
    Supplier<Promise<@Nullable Void>> terminate = Promise::done;
    Supplier<Promise<@Nullable Void>> health = Promise::done;
    Conversion<String, String> conversion = new Texts();

    Component<String, String> component() {
        return new Component<>(
                "counting",
                List.of("counts"),
                List.of(IN),
                List.of(OUT),
                Communication::new,
                conversion,
                Buffering.STREAM,
                Buffering.STREAM);
    }

    ComponentCommunication.Signals<? super String> signals() {
        return runs.getLast();
    }

    /** A promise that the test settles later. */
    static Deferred<@Nullable Void> later() {
        return new Deferred<>();
    }

    private final class Communication implements ComponentCommunication<String, String> {
        @Override
        public Promise<@Nullable Void> invoke(Signals<? super String> signals) {
            calls.add("invoke");
            runs.add(signals);
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
        public void data(String input) {
            calls.add(input);
            if (input.equals("13")) {
                throw new IllegalStateException("13 is bad luck");
            }
            if (input.equals("666")) {
                throw new StackOverflowError("too deep");
            }
        }
    }

    static class Texts implements Conversion<String, String> {
        @Override
        public List<ApplicationData<?>> toApplication(String output) {
            return List.of(new ApplicationData<>(OUT, new Number(Integer.parseInt(output))));
        }

        @Override
        public String toComponent(ApplicationData<?> input) {
            int value = ((Number) input.value()).value();
            if (value < 0) {
                throw new IllegalArgumentException("a count is " + value + ", expected 0 or more");
            }
            return String.valueOf(value);
        }
    }
}
