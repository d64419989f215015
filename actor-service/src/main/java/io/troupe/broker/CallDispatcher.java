package io.troupe.broker;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.internal.loop.Home;
import io.troupe.actor.promise.Promise;
import java.lang.reflect.Method;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/** The actor of a connection: queues calls and sends them to the current provider. */
interface CallDispatcher {
    void tell(Call call);

    Promise<@Nullable Object> ask(Call call);

    /** The caller no longer waits for the answer to that call. */
    Promise<@Nullable Void> cancel(Call call);

    /**
     * Takes over a callback that the next call passes on. As an argument of this message, the callback is bound to the
     * caller's space.
     */
    void bind(@Nullable Callback<@Nullable Object> callback, BoundCallback into);

    /**
     * Placeholder for a callback among the arguments of a call, until the connection's actor has taken over the
     * callback.
     */
    final class BoundCallback {
        @Nullable
        Callback<@Nullable Object> callback; // accessed on the connection's space only
    }

    /** A method and its arguments, with {@link BoundCallback} in place of callbacks. Compared by identity. */
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
                    .map(each -> each instanceof BoundCallback bound ? bound.callback : each)
                    .toArray();
        }

        /** Ends the callbacks of a call that was not sent; on the connection's space. */
        void failCallbacks(Throwable why) {
            for (Object each : arguments) {
                if (each instanceof BoundCallback bound && bound.callback != null) {
                    bound.callback.fail(why);
                }
            }
        }

        boolean isOneWay() {
            return answer == null;
        }

        /** Returns whether the call was cancelled, or its answer has no listener any more. */
        boolean isCancelled() {
            return answer != null && answer.isAbandoned();
        }

        @Override
        public String toString() {
            return describe(method);
        }
    }

    /**
     * The promise that a caller gets at once; settled by the connection's answer. If the caller cancels it, or if its
     * time limit passes and it has no other listener, the connection is notified.
     */
    final class Answer extends Promise<@Nullable Object> {
        private final ActorSpace home;
        private final Method method;
        private final boolean madeOutside;
        private @Nullable Promise<@Nullable Object> asked;
        private Runnable onCancel = () -> {};

        private Answer(ActorSpace home, Method method) {
            this.home = home;
            this.method = method;
            this.madeOutside = ActorSpace.current() != home;
        }

        /** Sends the request to the connection. */
        static Promise<@Nullable Object> ask(
                CallDispatcher dispatcher, ActorSpace home, Method method, List<@Nullable Object> arguments) {
            var answer = new Answer(home, method);
            var call = new Call(method, arguments, answer);
            Promise<@Nullable Object> asked = dispatcher.ask(call);
            answer.asked = asked;
            answer.onCancel = () -> dispatcher.cancel(call).exceptionally(closed -> null);
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
            onCancel.run();
        }

        @Override
        protected void timedOut() {
            if (isGivenUp()) {
                cancel();
            }
        }

        @Override
        protected @Nullable Home home() {
            return home.home();
        }

        @Override
        protected boolean madeOutside() {
            return madeOutside;
        }

        @Override
        public String toString() {
            return "the answer to " + describe(method);
        }
    }

    private static String describe(Method method) {
        return method.getDeclaringClass().getSimpleName() + "." + method.getName()
                + Arrays.stream(SuspendingCalls.parameters(method))
                        .map(Class::getSimpleName)
                        .collect(Collectors.joining(", ", "(", ")"));
    }
}
