package io.troupe.actor.testkit;

import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.internal.SuspendingCalls;
import io.troupe.actor.internal.loop.PlainText;
import java.lang.reflect.Method;
import java.lang.reflect.ParameterizedType;
import java.lang.reflect.Proxy;
import java.lang.reflect.Type;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.Deque;
import java.util.List;
import java.util.Objects;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A test double for an actor: records the calls it receives, and answers requests on demand of the test.
 *
 * <p><b>Role.</b> Created by {@link TestSpace#probe}; {@link #actor} is passed to the code under test. It is an
 * ordinary actor of that space. A call is written with the texts of its arguments, {@code greet(Ann)}, each of 1,000
 * characters at most, and {@code callback} for a {@link Callback}. A suspend function of Kotlin is a request like those
 * that return a promise.
 *
 * {@snippet :
 * Probe<Shop> shop = test.probe(Shop.class);
 * Clerk clerk = test.spawn(Clerk.class, () -> new Clerk(shop.actor()));
 * Promise<String> advice = clerk.advise("lamp");
 * shop.expectCall("price(lamp)");
 * shop.answer(20);
 * assertThat(test.get(advice)).isEqualTo("wait");
 * }
 *
 * <p><b>Threads.</b> The test's thread, outside of {@link TestSpace#runQueued}. Each method first runs everything that
 * is queued in the space.
 *
 * <p><b>Order.</b> Calls are in the order in which they were handled; requests are answered in that order too.
 *
 * <p><b>Errors.</b> A wrong or missing call is an {@link AssertionError} that lists the calls so far.
 */
public final class Probe<A> {
    private static final int MOST_CHARACTERS = 1_000; // of an argument

    private record Call(String text, List<@Nullable Object> arguments) {}

    private record OpenRequest(String text, Method method, Deferred<@Nullable Object> answer) {}

    private final TestSpace test;
    private final Class<A> type;
    private final A actor;
    private final List<Call> calls = new ArrayList<>();
    private final Deque<OpenRequest> unanswered = new ArrayDeque<>();
    private int expected;

    Probe(TestSpace test, Class<A> type) {
        if (!type.isInterface()) {
            throw new IllegalArgumentException("a probe stands in for an interface, and " + type.getName()
                    + " is a class: spawn a subclass of it");
        }
        this.test = test;
        this.type = type;
        this.actor = test.spawn(type, this::standIn);
    }

    /** The proxy to pass to the code under test. */
    public A actor() {
        return actor;
    }

    /** All calls so far. */
    public List<String> calls() {
        test.runQueued();
        return texts();
    }

    /**
     * Asserts that the next call is this one; each call is expected once, in order.
     *
     * @param call as it is written in {@link #calls}
     * @return its arguments, unchanged
     */
    public List<@Nullable Object> expectCall(String call) {
        test.runQueued();
        if (expected == calls.size()) {
            throw failure("expected the call " + call + ", but no further one came");
        }
        var next = calls.get(expected);
        if (!next.text.equals(call)) {
            throw failure("expected the call " + call + ", but the next one was " + next.text);
        }
        expected++;
        return next.arguments;
    }

    /** Asserts that there were no further calls. */
    public void expectNoCall() {
        test.runQueued();
        if (expected < calls.size()) {
            throw failure("expected no further call, but " + calls.get(expected).text + " came");
        }
    }

    /**
     * Fulfils the oldest pending request, even if its caller has cancelled it, and runs what follows from that. A
     * suspend function of Kotlin without a result is answered by null.
     */
    public void answer(@Nullable Object value) {
        OpenRequest request = oldest("answer(" + show(value) + ")");
        Class<?> wanted = answerType(request.method);
        if (value != null && !wanted.isInstance(value)) {
            throw failure("answer(" + show(value) + ") is a " + value.getClass().getName() + ", and " + request.text
                    + " answers a " + wanted.getName());
        }
        unanswered.remove();
        request.answer.resolve(value == null && SuspendingCalls.isUnit(wanted) ? SuspendingCalls.unit() : value);
        test.runQueued();
    }

    /** Rejects the oldest pending request; see {@link #answer}. */
    public void reject(Throwable error) {
        Objects.requireNonNull(error, "error");
        OpenRequest request = oldest("reject(" + show(error) + ")");
        unanswered.remove();
        request.answer.reject(error);
        test.runQueued();
    }

    /** Removes and returns the pending requests. They are never answered, and no longer fail the test. */
    public List<String> takeUnanswered() {
        test.runQueued();
        return removeUnanswered();
    }

    @Override
    public String toString() {
        return "probe of " + type.getSimpleName();
    }

    List<String> removeUnanswered() {
        var taken = unanswered.stream().map(OpenRequest::text).toList();
        unanswered.clear();
        return taken;
    }

    private OpenRequest oldest(String what) {
        test.runQueued();
        OpenRequest request = unanswered.peek();
        if (request == null) {
            throw failure(what + " came when no request waited for an answer");
        }
        return request;
    }

    private List<String> texts() {
        return calls.stream().map(Call::text).toList();
    }

    private AssertionError failure(String what) {
        return new AssertionError(this + ": " + what + "; calls so far: " + texts());
    }

    private A standIn() {
        return type.cast(Proxy.newProxyInstance(
                type.getClassLoader(),
                new Class<?>[] {type},
                (self, method, arguments) -> method.getDeclaringClass() == Object.class
                        ? switch (method.getName()) {
                            case "equals" -> self == arguments[0];
                            case "hashCode" -> System.identityHashCode(self);
                            default -> toString();
                        }
                        : handle(method, arguments)));
    }

    private @Nullable Object handle(Method method, @Nullable Object @Nullable [] given) {
        boolean isSuspending = SuspendingCalls.isSuspending(method);
        List<@Nullable Object> arguments = given == null
                ? List.of()
                : Collections.unmodifiableList(
                        Arrays.asList(Arrays.copyOf(given, SuspendingCalls.parameters(method).length)));
        String text = SuspendingCalls.nameOf(method)
                + arguments.stream().map(Probe::show).collect(Collectors.joining(", ", "(", ")"));
        calls.add(new Call(text, arguments));
        if (!isSuspending && method.getReturnType() != Promise.class) {
            return null;
        }
        var answer = new Deferred<@Nullable Object>();
        unanswered.add(new OpenRequest(text, method, answer));
        return isSuspending
                ? SuspendingCalls.await(answer, Objects.requireNonNull(given)[arguments.size()]) // its continuation
                : answer;
    }

    /** The text of a value, arrays with their elements, whatever the {@code toString} of a user's class does. */
    static String show(@Nullable Object value) {
        if (value == null || !value.getClass().isArray()) {
            return value instanceof Callback ? "callback" : PlainText.of(value, MOST_CHARACTERS);
        }
        var elements = new Object() {
            @Override
            public String toString() {
                String inBrackets = Arrays.deepToString(new Object[] {value});
                return inBrackets.substring(1, inBrackets.length() - 1);
            }
        };
        return PlainText.of(elements, MOST_CHARACTERS);
    }

    /** The type of the answer, as far as it is known at run time. */
    private static Class<?> answerType(Method method) {
        Type answer = SuspendingCalls.isSuspending(method)
                ? SuspendingCalls.result(method)
                : method.getGenericReturnType() instanceof ParameterizedType promise
                        ? promise.getActualTypeArguments()[0]
                        : Object.class;
        if (answer instanceof ParameterizedType generic) {
            answer = generic.getRawType();
        }
        return answer instanceof Class<?> known ? known : Object.class;
    }
}
