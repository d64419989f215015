package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorTypeException;
import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Objects;
import java.util.concurrent.CountDownLatch;
import java.util.function.Supplier;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.EnumSource;
import org.junit.jupiter.params.provider.MethodSource;

/**
 * One interface with every kind of method means the same wherever its actor is called: by its own proxy, from another
 * space, through a broker, and over hosts.
 */
@Timeout(600)
class MethodsEverywhereTest extends HostsBench {
    /** What is inherited with a type argument. */
    interface Base<T> {
        Promise<String> put(T value);

        default Promise<String> again(T value) {
            return Promise.of("the default again " + value + " on " + ActorSpace.current());
        }
    }

    /** Every kind of method. */
    interface Everything extends Base<String> {
        void note(String what);

        Promise<String> ask(String what);

        Promise<String> ask(int number);

        Promise<@Nullable Void> fail(String why);

        void count(int to, Callback<Integer> callback);

        @Override
        Promise<String> put(String value);

        default void noteTwice(String what) {
            note("the default notes " + what);
        }

        default Promise<String> greet(String name) {
            return Promise.of("the default greets " + name);
        }

        default Promise<String> farewell(String name) {
            return Promise.of("the default leaves " + name + " on " + ActorSpace.current());
        }

        default String label() {
            return "a label on " + (ActorSpace.current() == null ? "the caller's thread" : ActorSpace.current());
        }

        @Override
        String toString();
    }

    private final List<String> notes = Collections.synchronizedList(new ArrayList<>());

    /** Overrides some of the default methods. */
    private final class Actual implements Everything {
        @Override
        public void note(String what) {
            notes.add(what + " on " + ActorSpace.current());
        }

        @Override
        public Promise<String> ask(String what) {
            return Promise.of("text " + what + " on " + ActorSpace.current());
        }

        @Override
        public Promise<String> ask(int number) {
            return Promise.of("number " + number + " on " + ActorSpace.current());
        }

        @Override
        public Promise<@Nullable Void> fail(String why) {
            throw new UnsupportedOperationException(why);
        }

        @Override
        public void count(int to, Callback<Integer> callback) {
            for (int i = 1; i <= to; i++) {
                callback.next(i);
            }
            callback.finish();
        }

        @Override
        public Promise<String> put(String value) {
            return Promise.of("put " + value + " on " + ActorSpace.current());
        }

        @Override
        public Promise<String> again(String value) {
            return Promise.of("again " + value + " on " + ActorSpace.current());
        }

        @Override
        public void noteTwice(String what) {
            note(what);
            note(what);
        }

        @Override
        public Promise<String> greet(String name) {
            return Promise.of("greets " + name + " on " + ActorSpace.current());
        }

        @Override
        public String label() {
            return "never called on a proxy";
        }

        @Override
        public String toString() {
            return "never called on a proxy";
        }
    }

    /** Where the actor is called from. */
    enum Place {
        DIRECTLY,
        ACROSS_SPACES,
        THROUGH_A_BROKER,
        OVER_HOSTS
    }

    private final ActorSpace provider = ActorSpace.create(SpaceSettings.named("provider"));
    private final ActorSpace caller = ActorSpace.create(SpaceSettings.named("caller"));

    @AfterEach
    void closeSpaces() {
        provider.close();
        caller.close();
    }

    private Everything in(Place place) {
        if (place == Place.DIRECTLY || place == Place.ACROSS_SPACES) {
            return provider.spawn(Everything.class, Actual::new);
        }
        Host there = host("there");
        Host here = place == Place.OVER_HOSTS ? host("here") : there;
        await(there.services.publish(provider, Everything.class, "everything", List.of(), Actual::new));
        return here.services
                .connect(Everything.class, Need.ofService("user", "everything"))
                .actor();
    }

    private <T extends @Nullable Object> T await(Promise<T> promise) {
        while (!promise.isDone()) {
            test.runQueued(); // broker and bus
            Thread.onSpinWait();
        }
        return test.get(promise);
    }

    /** On the caller's space, except where the actor's own space calls. */
    private <T> T call(Place place, java.util.concurrent.Callable<T> body) {
        return await((place == Place.DIRECTLY ? provider : caller).sequential(body));
    }

    @ParameterizedTest
    @EnumSource
    void everyKindOfMethod_meansTheSame(Place place) {
        Everything actor = in(place);
        List<Promise<String>> answers = call(
                place,
                () -> List.of(
                        actor.ask("a"),
                        actor.ask(1),
                        actor.put("p"),
                        ((Base<String>) actor).put("q"),
                        actor.again("r"),
                        actor.greet("g"),
                        actor.farewell("f")));
        assertThat(answers.stream().map(this::await))
                .containsExactly(
                        "text a on provider",
                        "number 1 on provider",
                        "put p on provider",
                        "put q on provider",
                        "again r on provider",
                        "greets g on provider",
                        "the default leaves f on provider");

        call(place, () -> {
            actor.note("one");
            actor.noteTwice("two");
            return true;
        });
        await(actor.ask("behind the notes"));
        assertThat(notes).containsExactly("one on provider", "two on provider", "two on provider");
    }

    @ParameterizedTest
    @EnumSource
    void callback_arrivesOnTheCallersSpace_inOrder_andEnds(Place place) throws Exception {
        Everything actor = in(place);
        List<String> results = Collections.synchronizedList(new ArrayList<>());
        var ended = new CountDownLatch(1);
        call(place, () -> {
            actor.count(
                    3,
                    new Callback.Stream<>(
                            value -> results.add(value + " on " + ActorSpace.current()), end -> ended.countDown()));
            return true;
        });
        while (ended.getCount() > 0) {
            test.runQueued();
        }
        String where = place == Place.DIRECTLY ? " on provider" : " on caller";
        assertThat(results).containsExactly("1" + where, "2" + where, "3" + where);
    }

    @ParameterizedTest
    @EnumSource
    void exception_isThatOfTheActor(Place place) {
        Everything actor = in(place);
        Promise<String> message = call(
                place,
                () -> actor.fail("not today")
                        .handle((nothing, error) ->
                                "" + Objects.requireNonNull(error).getMessage()));
        assertThat(await(message)).contains("not today");
    }

    @ParameterizedTest
    @EnumSource
    void otherDefaultMethods_andThoseOfObject_areOfTheProxy(Place place) {
        Everything actor = in(place);
        assertThat(actor.label()).isEqualTo("a label on the caller's thread");
        assertThat(actor.toString()).doesNotContain("never called");
        assertThat(actor).isEqualTo(actor).hasSameHashCodeAs(actor).isNotEqualTo("something else");
        assertThat(ActorSpace.of(actor)).isIn(provider, caller, test.space());
    }

    interface Looks {
        String look();
    }

    sealed interface Closed {}

    record OnlyOne() implements Closed {}

    static Stream<Arguments> noActorTypes() {
        return Stream.of(
                Arguments.of(
                        Looks.class,
                        "Looks.look() of actor type " + Looks.class.getName()
                                + " returns String, expected void (a one-way message) or Promise (a request)"),
                Arguments.of(Closed.class, Closed.class.getName() + " cannot be an actor type: it is sealed"));
    }

    @ParameterizedTest
    @MethodSource("noActorTypes")
    <A> void typeThatCannotBeAnActor_isRefusedInOneWay_whereItIsWritten(Class<A> type, String why) {
        Host host = host("host");
        var broker =
                Broker.open("alone", test.space(), BrokerSettings.defaults().withObserver(event -> {}));
        var local = broker.services();
        Supplier<A> none = () -> {
            throw new AssertionError("made");
        };
        Stream.<Runnable>of(
                        () -> provider.spawn(type, none),
                        () -> local.publish(provider, type, "looks", List.of(), none),
                        () -> local.connect(type, Need.ofService("user", "looks")),
                        () -> host.services.publish(provider, type, "looks", List.of(), none),
                        () -> host.services.connect(type, Need.ofService("user", "looks")))
                .forEach(each -> assertThatThrownBy(each::run)
                        .isInstanceOf(ActorTypeException.class)
                        .hasMessageContaining(why));
        await(broker.closeAsync());
    }
}
