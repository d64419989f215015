package io.troupe.services.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.promise.Home;
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

    /** The caller does not wait for the answer to that call any more. */
    Promise<@Nullable Void> giveUp(Call call);

    /**
     * Takes a callback that the next call passes on: as an argument of this message it has got its way back to its
     * reader.
     */
    void adopt(@Nullable Callback<@Nullable Object> callback, Adopted into);

    /** Stands for a callback among the arguments of a call, until the caller's actor has taken it. */
    final class Adopted {
        @Nullable
        Callback<@Nullable Object> callback; // set and read on the connection's space only
    }

    /** A method, and its arguments with {@link Adopted} in the place of callbacks. Equal to nothing but itself. */
    final class Call {
        final Method method;
        private final List<@Nullable Object> arguments;
        private final @Nullable Answer answer; // null: a one-way call

        Call(Method method, List<@Nullable Object> arguments, @Nullable Answer answer) {
            this.method = method;
            this.arguments = arguments;
            this.answer = answer;
        }

        @Nullable
        Object[] toInvoke() {
            return arguments.stream()
                    .map(each -> each instanceof Adopted adopted ? adopted.callback : each)
                    .toArray();
        }

        boolean isOneWay() {
            return answer == null;
        }

        /** Whether it was cancelled, or nobody waits for its answer any more. */
        boolean wasGivenUp() {
            return answer != null && answer.isAbandoned();
        }

        @Override
        public String toString() {
            return describe(method);
        }
    }

    /**
     * What a caller is given at once: settled as the connection answers. When the caller cancels it, or sets it a time
     * limit that passes while nobody else waits, the connection learns of that.
     */
    final class Answer extends Promise<@Nullable Object> {
        private final ActorSpace home;
        private final Method method;
        private final boolean madeOutside;
        private @Nullable Promise<@Nullable Object> asked;
        private Runnable giveUp = () -> {};

        private Answer(ActorSpace home, Method method) {
            this.home = home;
            this.method = method;
            this.madeOutside = ActorSpace.current() != home;
        }

        /** Asks the connection. */
        static Promise<@Nullable Object> ask(
                Caller caller, ActorSpace home, Method method, List<@Nullable Object> arguments) {
            var answer = new Answer(home, method);
            var call = new Call(method, arguments, answer);
            Promise<@Nullable Object> asked = caller.ask(call);
            answer.asked = asked;
            answer.giveUp = () -> caller.giveUp(call).exceptionally(closed -> null);
            answer.follow(asked);
            return answer;
        }

        boolean isAbandoned() {
            return isGivenUp();
        }

        @Override
        protected void cancelled() {
            if (asked != null) {
                asked.cancel(); // skipped if it has not begun
            }
            giveUp.run();
        }

        @Override
        protected void timedOut() {
            if (isGivenUp()) {
                cancel();
            }
        }

        @Override
        protected Home home() {
            return home;
        }

        @Override
        protected boolean isLocal() {
            return false;
        }

        @Override
        protected boolean madeOutside() {
            return madeOutside;
        }

        @Override
        protected void run() {
            throw new IllegalStateException("the answer to a call is never queued");
        }

        @Override
        public String toString() {
            return "the answer to " + describe(method);
        }
    }

    private static String describe(Method method) {
        return method.getDeclaringClass().getSimpleName() + "." + method.getName()
                + Arrays.stream(method.getParameterTypes())
                        .map(Class::getSimpleName)
                        .collect(Collectors.joining(", ", "(", ")"));
    }
}
