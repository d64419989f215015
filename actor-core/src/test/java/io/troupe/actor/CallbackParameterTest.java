package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** A callback is wrapped only where the parameter is one, so no other argument may contain one. */
class CallbackParameterTest {
    interface Colours extends Callback<Integer> {}

    interface Subtype {
        void wander(String where, Colours colours);
    }

    interface StreamItself {
        void wander(String where, Callback.Stream<Integer> colours);
    }

    interface Array {
        Promise<String> wander(String where, Callback<Integer>[] colours);
    }

    interface DeepArray {
        void wander(String where, Callback<Integer>[][] colours);
    }

    @SuppressWarnings("unchecked") // varargs of a generic type
    interface Varargs {
        void wander(String where, Callback<Integer>... colours);
    }

    interface Listed {
        void wander(String where, List<Callback<Integer>> colours);
    }

    interface Wild {
        void wander(String where, Map<String, ? extends List<? super Colours>> colours);
    }

    interface Nested {
        void wander(String where, Callback<Callback<Integer>> colours);
    }

    interface Variable {
        <C extends Callback<Integer>> void wander(String where, C colours);
    }

    interface Follower<T> {
        void wander(String where, T colours);
    }

    interface Inherited extends Follower<Callback<Integer>> {}

    public abstract static class OfAClass extends Actor implements Follower<Callback<Integer>[]> {}

    abstract static class Unseen extends Actor {
        public void wander(String where, List<Callback<Integer>> colours) {}
    }

    /** The compiler's bridge to the method above does not include the type of the list's elements. */
    public static class Seen extends Unseen {}

    abstract static class Wanderer<T> extends Actor {
        public void wander(String where, T colours) {}
    }

    public static class Robot extends Wanderer<Callback<Integer>> {
        @Override
        public void wander(String where, Callback<Integer> colours) {
            colours.next(9);
        }
    }

    interface Harmless<T extends Comparable<T>> {
        <U extends Comparable<U>> void sort(
                List<U> values, T most, Map<String, ? super T[]> least, List<String>[] names);

        void both(Callback<? super List<Integer>> first, @SuppressWarnings("rawtypes") Callback second);
    }

    interface Overriding extends Follower<Callback<Integer>> {
        @Override
        void wander(String where, Callback<Integer> colours);
    }

    /** The descriptor with Object is inherited here a second time, and the compiler has generated no bridge. */
    interface Twice extends Follower<Callback<Integer>>, Walking {}

    interface Walking {
        void wander(String where, Callback<Integer> colours);
    }

    interface Answering {
        Promise<Callback<Integer>> listener();
    }

    private final TestSpace test = new TestSpace();
    private final List<Integer> seen = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @ParameterizedTest
    @ValueSource(
            classes = {
                Subtype.class,
                StreamItself.class,
                Array.class,
                DeepArray.class,
                Varargs.class,
                Listed.class,
                Wild.class,
                Nested.class,
                Variable.class,
                Inherited.class,
                OfAClass.class,
                Seen.class
            })
    void callbackInAnotherType_isRejectedAtSpawn(Class<?> type) {
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining(".wander(String, ")
                .hasMessageContaining("actor type " + type.getName())
                .hasMessageContaining("parameter 2 (colours)")
                .hasMessageContaining("declare the parameter as Callback<T>");
    }

    @Test
    void promiseOfACallback_isRejectedAtSpawn() {
        assertThatThrownBy(() -> test.space().spawn(Answering.class, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("Answering.listener()")
                .hasMessageContaining("on the asker's side");
    }

    @Test
    void otherGenericParameters_areNotRejected() {
        Harmless<?> proxy = test.spawn(Harmless.class, () -> null);
        assertThat(proxy).hasToString("Harmless#1");
        assertThat(test.takeProblems()).hasSize(1); // the factory
    }

    @Test
    void callbackThroughAGenericSupertype_runsInTheCallersSpace() {
        try (var callee = new TestSpace()) {
            Overriding overriding = callee.spawn(Overriding.class, () -> (where, colours) -> colours.next(7));
            Wanderer<Callback<Integer>> robot = callee.spawn(Robot.class, Robot::new);
            Twice twice = callee.spawn(Twice.class, () -> new Twice() {
                @Override
                public void wander(String where, Callback<Integer> colours) {
                    colours.next(8);
                }
            });
            for (Follower<Callback<Integer>> follower : List.of(overriding, twice)) {
                inCallersSpace(() -> follower.wander("here", (colour, error) -> seen.add(colour)));
            }
            inCallersSpace(() -> robot.wander("here", (colour, error) -> seen.add(colour)));
            inCallersSpace(() -> ((Walking) twice).wander("here", (colour, error) -> seen.add(colour)));
            callee.crank();
            assertThat(seen).isEmpty();
            test.crank();
            assertThat(seen).containsExactlyInAnyOrder(7, 8, 8, 9);
        }
    }

    private void inCallersSpace(Runnable task) {
        test.space().execute(task);
        test.crank();
    }

    @Test
    void callbackOfTheWrongClass_throwsInTheCaller() {
        Overriding overriding = test.spawn(Overriding.class, () -> (where, colours) -> colours.next(7));
        @SuppressWarnings({"unchecked", "rawtypes"}) // on purpose
        Consumer<Object> raw = colours -> ((Follower) overriding).wander("here", colours);
        assertThatThrownBy(() -> raw.accept("no callback")).isInstanceOf(ClassCastException.class);
    }
}
