package io.troupe.services.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.promise.Promise;
import java.lang.reflect.Method;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/** The actor behind a connection. */
interface Caller {
    void tell(Call call);

    Promise<@Nullable Object> ask(Call call);

    /** Takes a callback that the next call passes on: as an argument of this message it has got its way back to its reader. */
    void adopt(@Nullable Callback<@Nullable Object> callback, Adopted into);

    /** Stands for a callback among the arguments of a call, until the caller's actor has taken it. */
    final class Adopted {
        @Nullable
        Callback<@Nullable Object> callback; // set and read on the connection's space only
    }

    /** A method, and its arguments with {@link Adopted} in the place of callbacks. */
    record Call(Method method, List<@Nullable Object> arguments) {
        @Nullable
        Object[] toInvoke() {
            return arguments.stream()
                    .map(each -> each instanceof Adopted adopted ? adopted.callback : each)
                    .toArray();
        }

        @Override
        public String toString() {
            return method.getDeclaringClass().getSimpleName() + "." + method.getName()
                    + Arrays.stream(method.getParameterTypes())
                            .map(Class::getSimpleName)
                            .collect(Collectors.joining(", ", "(", ")"));
        }
    }
}
