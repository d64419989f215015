package io.troupe.services.component;

import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.bus.BusTopic;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/** A component with one input and one output topic that is scripted by a test. */
public final class ScriptedComponent<I, O> implements ComponentCommunication<I, O>, Conversion<I, O> {
    /** A value of the application that uses {@link #counter}. */
    record Number(int value) {}

    static final BusTopic<Number> IN = new BusTopic<>("counter/in", Number.class);
    static final BusTopic<Number> OUT = new BusTopic<>("counter/out", Number.class);

    public final List<String> calls = new ArrayList<>();
    public Supplier<@Nullable Promise<@Nullable Void>> invoke = Promise::done;
    public Supplier<Promise<@Nullable Void>> terminate = Promise::done;
    public Supplier<Promise<@Nullable Void>> health = Promise::done;
    public Consumer<I> data = input -> {};
    public Function<ApplicationData<?>, I> toComponent;
    public Function<O, ApplicationData<?>> toApplication;
    Supplier<ComponentCommunication<I, O>> communication = () -> this;
    private @Nullable Signals<? super O> signals;

    public ScriptedComponent(
            Function<ApplicationData<?>, I> toComponent, Function<O, ApplicationData<?>> toApplication) {
        this.toComponent = toComponent;
        this.toApplication = toApplication;
    }

    /** A component whose input and output are texts; the application's values are numbers. */
    static ScriptedComponent<String, String> counter() {
        var counter = new ScriptedComponent<String, String>(
                input -> text((Number) input.value()),
                output -> new ApplicationData<>(OUT, new Number(Integer.parseInt(output))));
        counter.data = input -> {
            counter.calls.add(input);
            if (input.equals("13")) {
                throw new IllegalStateException("13 is bad luck");
            }
            if (input.equals("666")) {
                throw new StackOverflowError("too deep");
            }
        };
        return counter;
    }

    private static String text(Number number) {
        if (number.value() < 0) {
            throw new IllegalArgumentException("a count is " + number.value() + ", expected 0 or more");
        }
        return String.valueOf(number.value());
    }

    public Component<I, O> component(String service, BusTopic<?> in, BusTopic<?> out) {
        return new Component<>(
                service,
                List.of(),
                List.of(in),
                List.of(out),
                () -> communication.get(),
                this,
                Buffering.STREAM,
                Buffering.STREAM);
    }

    /** The signals of the latest run. */
    public Signals<? super O> signals() {
        return signals;
    }

    /** A promise that the test settles later, or never. */
    public static Deferred<@Nullable Void> later() {
        return new Deferred<>();
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super O> newSignals) {
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
    public void data(I input) {
        data.accept(input);
    }

    @Override
    public List<ApplicationData<?>> toApplication(O output) {
        return List.of(toApplication.apply(output));
    }

    @Override
    public I toComponent(ApplicationData<?> input) {
        return toComponent.apply(input);
    }
}
