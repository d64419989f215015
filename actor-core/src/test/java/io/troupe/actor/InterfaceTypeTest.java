package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.internal.Request;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class InterfaceTypeTest {
    interface Source {
        Object value();
    }

    interface Asked {
        Promise<String> value();
    }

    /** Both methods are abstract here, and the compiler has generated no bridge between them. */
    interface Both extends Asked, Source {}

    interface AlsoAsked {
        Promise<String> value();
    }

    interface Box<T> {
        void put(T value);
    }

    interface Diamond extends Asked, AlsoAsked, Box<String> {
        @Override
        void put(String value);
    }

    interface Names {
        void troupe$cell();

        Promise<String> troupe$cell(int number);

        Promise<Names> clone();

        Promise<String> wait(String what);

        Promise<Integer> notifyAll(int... whom) throws IOException;

        Promise<Boolean> equals(String other);

        boolean equals(Object other);

        int hashCode();

        String toString();

        void started();

        @Deprecated
        <T> Promise<T> same(T value);
    }

    private interface Secret {
        Promise<String> tell();
    }

    enum Colour {
        RED
    }

    sealed interface Closed permits Only {}

    record Only() implements Closed {}

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void methodOfAParentWithAWiderResult_isTheSameMessage() {
        Both both = test.spawn(Both.class, () -> () -> Promise.of("value"));
        Object answer = ((Source) both).value();
        assertThat(answer).isInstanceOf(Request.class);
        assertThat(test.get((Promise<?>) answer)).isEqualTo("value");
        assertThat(test.get(both.value())).isEqualTo("value");
    }

    @Test
    void methodOfTwoParents_isOneMessage() {
        var kept = new ArrayList<String>();
        Diamond diamond = test.spawn(Diamond.class, () -> new Diamond() {
            @Override
            public Promise<String> value() {
                return Promise.of("one");
            }

            @Override
            public void put(String value) {
                kept.add(value);
            }
        });
        Promise<String> asked = ((AlsoAsked) diamond).value();
        ((Box<String>) diamond).put("text");
        assertThat(test.get(asked)).isEqualTo("one");
        assertThat(test.get(diamond.value())).isEqualTo("one");
        assertThat(kept).containsExactly("text");
    }

    @Test
    void namesOfObjectAndOfGeneratedCode_areMessagesLikeOthers() throws IOException {
        var log = new ArrayList<String>();
        Names names = test.spawn(Names.class, () -> new EveryName(log));
        assertThat(test.get(names.troupe$cell(3))).isEqualTo("cell 3");
        names.troupe$cell();
        names.started();
        assertThat(test.get(names.clone())).isNull();
        assertThat(test.get(names.wait("you"))).isEqualTo("waited for you");
        assertThat(test.get(names.notifyAll(1, 2, 3))).isEqualTo(3);
        assertThat(test.get(names.equals("x"))).isFalse();
        assertThat(test.get(names.same(List.of(1)))).containsExactly(1);
        assertThat(names).isEqualTo(names).hasToString("Names#1");
        assertThat(log).containsExactly("cell", "started");
    }

    private record EveryName(List<String> log) implements Names {
        @Override
        public void troupe$cell() {
            log.add("cell");
        }

        @Override
        public Promise<String> troupe$cell(int number) {
            return Promise.of("cell " + number);
        }

        @Override
        public Promise<Names> clone() {
            return Promise.of(null);
        }

        @Override
        public Promise<String> wait(String what) {
            return Promise.of("waited for " + what);
        }

        @Override
        public Promise<Integer> notifyAll(int... whom) {
            return Promise.of(whom.length);
        }

        @Override
        public Promise<Boolean> equals(String other) {
            return Promise.of(false);
        }

        @Override
        public void started() {
            log.add("started");
        }

        @Override
        @Deprecated
        public <T> Promise<T> same(T value) {
            return Promise.of(value);
        }
    }

    @Test
    void privateInterface_canBeAnActorType() {
        Secret secret = test.spawn(Secret.class, () -> () -> Promise.of("hush"));
        assertThat(test.get(secret.tell())).isEqualTo("hush");
        interface Local {
            Promise<String> tell();
        }
        Local local = test.spawn(Local.class, () -> () -> Promise.of("near"));
        assertThat(test.get(local.tell())).isEqualTo("near");
    }

    @Test
    void typesThatAreNoInterfaces_areRejectedWithAReason() {
        refused(Colour.class, "does not extend io.troupe.actor.Actor");
        refused(Only.class, "does not extend io.troupe.actor.Actor");
        refused(int.class, "does not extend io.troupe.actor.Actor");
        refused(Secret[].class, "does not extend io.troupe.actor.Actor");
        refused(Closed.class, "it is sealed");
        refused(Override.class, "it is an annotation");
        refused(ActorProxy.class, "ActorProxy.troupe$cell()", "returns Recipient");
    }

    private void refused(Class<?> type, String... reasons) {
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining(type.getName())
                .hasMessageContainingAll(reasons);
    }

    interface Door {
        Promise<Integer> visitors();

        default Promise<Integer> twice() {
            return visitors().thenApply(number -> 2 * number);
        }

        default void close() {}

        default Promise<String> called(String name) {
            return Promise.of("door " + name);
        }

        default String label() {
            return "label of " + this;
        }
    }

    interface Named<T> {
        default Promise<String> of(T value) {
            return Promise.of("any " + value);
        }
    }

    interface NamedText extends Named<String> {
        @Override
        Promise<String> of(String value);
    }

    private static class Gate implements Door {
        private final List<String> log;

        Gate(List<String> log) {
            this.log = log;
        }

        @Override
        public Promise<Integer> visitors() {
            return Promise.of(1);
        }

        @Override
        public Promise<Integer> twice() {
            return Promise.of(100);
        }

        @Override
        public void close() {
            log.add("closed");
        }
    }

    @Test
    void defaultMethodThatCanBeAMessage_isTheImplementations_overriddenOrNot() {
        var log = new ArrayList<String>();
        Door door = test.spawn(Door.class, () -> new Gate(log));
        Promise<Integer> twice = door.twice();
        assertThat(twice).isInstanceOf(Request.class);
        assertThat(test.get(twice)).isEqualTo(100);
        assertThat(test.get(door.called("one"))).isEqualTo("door one");
        door.close();
        test.crank();
        assertThat(log).containsExactly("closed");
    }

    @Test
    void defaultMethodThatReturnsSomethingElse_runsWhereItIsCalled() {
        Door door = test.spawn(Door.class, () -> new Gate(new ArrayList<>()));
        assertThat(door.label()).isEqualTo("label of " + door);
    }

    @Test
    void genericDefaultMethod_thatASubtypeNarrows_leadsToTheSameMessage() {
        NamedText text = test.spawn(NamedText.class, () -> value -> Promise.of("text " + value));
        Named<String> general = text;
        assertThat(test.get(text.of("a"))).isEqualTo("text a");
        assertThat(test.get(general.of("b"))).isEqualTo("text b");
    }
}
