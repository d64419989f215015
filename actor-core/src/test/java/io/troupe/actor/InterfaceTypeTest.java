package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Which methods of an interface are messages, and where the others run. */
class InterfaceTypeTest extends InTestSpace {
    interface AllTypes {
        Promise<String> all(
                boolean z, byte b, short s, char c, int i, long j, float f, double d, String text, int[] array);
    }

    @Test
    void argumentsOfEveryKind_arrive() {
        AllTypes proxy = test.spawn(
                AllTypes.class,
                () -> (z, b, s, c, i, j, f, d, text, array) ->
                        Promise.of("" + z + b + s + c + i + j + f + d + text + array.length));
        Promise<String> answer = proxy.all(true, (byte) 1, (short) 2, 'c', 3, 4L, 5f, 6d, "t", new int[] {7, 8});
        assertThat(answer)
                .hasToString(
                        "AllTypes.all(boolean, byte, short, char, int, long, float, double, String, int[]) of AllTypes#1");
        assertThat(test.get(answer)).isEqualTo("true12c345.06.0t2");
    }

    interface Puttable<T> {
        void put(T value);
    }

    interface Box<T> extends Puttable<T> {
        Promise<T> take();
    }

    interface TextBox extends Box<String> {
        default Promise<String> swap(String value) {
            Promise<String> old = take();
            put(value);
            return old;
        }

        static String label() {
            return "text";
        }

        private String hidden() {
            return "not a message";
        }
    }

    @Test
    void genericAndInheritedAndDefaultMethods_work() {
        TextBox box = test.spawn(TextBox.class, () -> new TextBox() {
            private String content = "empty";

            @Override
            public void put(String value) {
                content = value;
            }

            @Override
            public Promise<String> take() {
                return Promise.of(content);
            }
        });
        assertThat(values(box.swap("full"))).containsExactly("empty");
        assertThat(values(box.take())).containsExactly("full");
        assertThat(TextBox.label()).isEqualTo("text");
    }

    @Test
    void spawn_ofAFactoryThatAnswersNullOrAProxy_isReported() {
        TextBox inner = test.spawn(TextBox.class, () -> null);
        test.spawn(TextBox.class, () -> inner);
        assertThat(takeErrors())
                .satisfiesExactly(
                        first -> assertThat(first).contains("returned null"),
                        second -> assertThat(second).contains("returned a proxy"));
        assertThat(inner).hasToString("TextBox#1").isEqualTo(inner);
    }

    interface Bag<T> {
        Promise<Integer> add(T what);
    }

    @Test
    @SuppressWarnings({"unchecked", "rawtypes"}) // the mistake
    void wrongTypeByARawProxy_rejectsTheRequest() {
        Bag<String> bag = test.spawn(Bag.class, () -> (Bag<String>) what -> Promise.of(what.length()));
        Bag raw = bag;
        assertThat(test.error(raw.add(1))).isInstanceOf(ClassCastException.class);
        assertThat(test.get(bag.add("four"))).isEqualTo(4);
    }

    interface Source {
        Object value();
    }

    interface Asked {
        Promise<String> value();
    }

    interface AlsoAsked {
        Promise<String> value();
    }

    /** Both methods are abstract here, and the compiler has generated no bridge between them. */
    interface Both extends Asked, Source {}

    interface Diamond extends Asked, AlsoAsked, Puttable<String> {
        @Override
        void put(String value);
    }

    @Test
    void methodOfSeveralParents_isOneMessage_evenIfOneHasAWiderResult() {
        Both both = test.spawn(Both.class, () -> () -> Promise.of("value"));
        Object answer = ((Source) both).value();
        assertThat(answer).isInstanceOf(Request.class);
        assertThat(values((Promise<?>) answer, both.value())).containsExactly("value", "value");
        Diamond diamond = test.spawn(Diamond.class, () -> new Diamond() {
            @Override
            public Promise<String> value() {
                return Promise.of("one");
            }

            @Override
            public void put(String value) {
                log.add(value);
            }
        });
        Promise<String> asked = ((AlsoAsked) diamond).value();
        ((Puttable<String>) diamond).put("text");
        assertThat(values(asked, diamond.value())).containsExactly("one", "one");
        assertThat(log).containsExactly("text");
    }

    interface Names {
        void troupe$cell();

        void started();

        Promise<Names> clone();

        boolean equals(Object other);

        int hashCode();

        String toString();

        default Promise<String> troupe$cell(int number) {
            return Promise.of("cell " + number);
        }

        default Promise<String> Proxy() {
            return Promise.of("nothing");
        }

        default Promise<String> Proxy(int number) {
            return Promise.of("int " + number);
        }

        default Promise<String> Proxy(long number) {
            return Promise.of("long " + number);
        }

        default Promise<String> Proxy(Object any) {
            return Promise.of("object " + any);
        }

        default Promise<String> wait(String what) {
            return Promise.of("waited for " + what);
        }

        default Promise<Integer> notifyAll(int... whom) throws IOException {
            return Promise.of(whom.length);
        }

        default Promise<Boolean> equals(String other) {
            return Promise.of(false);
        }

        @Deprecated
        default <T> Promise<T> same(T value) {
            return Promise.of(value);
        }
    }

    @Test
    void overloadsAndNamesOfObjectAndOfGeneratedCode_areMessagesLikeOthers() throws IOException {
        Names names = test.spawn(Names.class, () -> new Names() {
            @Override
            public void troupe$cell() {
                log.add("cell");
            }

            @Override
            public void started() {
                log.add("started");
            }

            @Override
            public Promise<Names> clone() {
                return Promise.of(null);
            }
        });
        names.troupe$cell();
        names.started();
        Promise<?>[] overloads = {names.Proxy(1), names.Proxy(1L), names.Proxy("x"), names.Proxy()};
        Promise<?>[] others = {
            names.troupe$cell(3),
            names.clone(),
            names.wait("you"),
            names.notifyAll(1, 2, 3),
            names.equals("x"),
            names.same(List.of(1))
        };
        // a default method that ran on the caller's thread would answer with another promise
        assertThat(overloads).hasOnlyElementsOfType(Request.class);
        assertThat(others).hasOnlyElementsOfType(Request.class);
        assertThat(values(overloads)).containsExactly("int 1", "long 1", "object x", "nothing");
        assertThat(values(others)).containsExactly("cell 3", null, "waited for you", 3, false, List.of(1));
        assertThat(names).isEqualTo(names).hasToString("Names#1");
        assertThat(log).containsExactly("cell", "started");
    }

    private interface Secret {
        Promise<String> tell();
    }

    @Test
    void privateAndLocalInterfaces_canBeActorTypes() {
        interface Local {
            Promise<String> tell();
        }
        Secret secret = test.spawn(Secret.class, () -> () -> Promise.of("hush"));
        Local local = test.spawn(Local.class, () -> () -> Promise.of("near"));
        assertThat(values(secret.tell(), local.tell())).containsExactly("hush", "near");
    }

    interface Door {
        default Promise<Integer> twice() {
            return Promise.of(2);
        }

        default void close() {}

        default Promise<String> called(String name) {
            return Promise.of("door " + name);
        }

        default String label() {
            return "label of " + this;
        }
    }

    private record Gate(List<String> log) implements Door {
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
    void defaultMethodThatCanBeAMessage_isTheImplementations_anyOtherRunsWhereItIsCalled() {
        Door door = test.spawn(Door.class, () -> new Gate(log));
        Promise<Integer> twice = door.twice();
        assertThat(twice).isInstanceOf(Request.class);
        door.close();
        assertThat(values(twice, door.called("one"))).containsExactly(100, "door one");
        assertThat(log).containsExactly("closed");
        assertThat(door.label()).isEqualTo("label of " + door);
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

    @Test
    void genericDefaultMethod_thatASubtypeNarrows_leadsToTheSameMessage() {
        NamedText text = test.spawn(NamedText.class, () -> value -> Promise.of("text " + value));
        Named<String> general = text;
        assertThat(values(text.of("a"), general.of("b"))).containsExactly("text a", "text b");
    }
}
