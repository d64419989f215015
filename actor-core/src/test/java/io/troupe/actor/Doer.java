package io.troupe.actor;

import java.util.function.Consumer;
import java.util.function.Function;
import org.jspecify.annotations.Nullable;

/** An actor that does what its test gives it, on the thread of its space. */
public class Doer extends Actor {
    public void run(Consumer<Doer> task) {
        task.accept(this);
    }

    public <T extends @Nullable Object> Promise<T> ask(Function<Doer, Promise<T>> task) {
        return task.apply(this);
    }
}
