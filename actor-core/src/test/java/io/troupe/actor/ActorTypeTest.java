package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class ActorTypeTest {
    interface Thermometer {
        int degrees();
    }

    interface AllTypes {
        Promise<String> all(
                boolean z, byte b, short s, char c, int i, long j, float f, double d, String text, int[] array);
    }

    interface Overloaded {
        Promise<String> show(int value);

        Promise<String> show(long value);

        Promise<String> show(Object value);

        Promise<String> show();
    }

    interface Box<T> {
        void put(T value);

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

    /** A class actor, as in the paper: it calls itself through its proxy. */
    public static class Demo3 extends Actor {
        static final List<String> LOG = new ArrayList<>();
        private final String colour;
        private int lives;

        Demo3(String colour) {
            this.colour = colour;
            LOG.add("constructor");
        }

        @Override
        protected void started() {
            LOG.add("started");
        }

        @Override
        protected void stopped() {
            LOG.add("stopped");
        }

        public void live() {
            LOG.add("live " + colour + " " + ++lives);
            if (lives < 3) {
                ((Demo3) self()).live();
                LOG.add("after the call");
            }
        }

        public Promise<Integer> lives() {
            return Promise.of(lives);
        }

        String secret() {
            return colour;
        }

        @Override
        public boolean equals(Object other) {
            return other instanceof Demo3 demo && demo.colour.equals(colour);
        }

        @Override
        public int hashCode() {
            return colour.hashCode();
        }
    }

    public abstract static class WithFinalMethod extends Actor {
        public final void fixed() {}
    }

    public static class Gauge extends Actor {
        public int level() {
            return 1;
        }
    }

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
        Demo3.LOG.clear();
    }

    @Test
    void methodReturningInt_isRejectedAtSpawn_withWhatToDo() {
        assertThatThrownBy(() -> test.space().spawn(Thermometer.class, () -> () -> 20))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("Thermometer.degrees()")
                .hasMessageContaining("returns int")
                .hasMessageContaining("Promise<Integer>");
        assertThatThrownBy(() -> test.space().spawn(Gauge.class, Gauge::new))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("Gauge.level()")
                .hasMessageContaining("less visible than public");
    }

    @Test
    void finalMethodOfAClassActor_isRejectedAtSpawn() {
        assertThatThrownBy(() -> test.space().spawn(WithFinalMethod.class, () -> new WithFinalMethod() {}))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("WithFinalMethod.fixed()")
                .hasMessageContaining("is final");
    }

    @Test
    void typesThatCannotHaveAProxy_areRejectedWithAReason() {
        record Data(int x) {}
        assertThatThrownBy(() -> test.space().spawn(Data.class, () -> new Data(1)))
                .hasMessageContaining("does not extend io.troupe.actor.Actor");
        assertThatThrownBy(() -> test.space().spawn(Runnable.class, () -> () -> {}))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining("opens java.lang;")
                .hasMessageContaining("java.base");
    }

    @Test
    void argumentsOfEveryKind_arrive() {
        AllTypes proxy = test.spawn(
                AllTypes.class,
                () -> (z, b, s, c, i, j, f, d, text, array) ->
                        Promise.of("" + z + b + s + c + i + j + f + d + text + array.length));
        Promise<String> answer = proxy.all(true, (byte) 1, (short) 2, 'c', 3, 4L, 5f, 6d, "t", new int[] {7, 8});
        assertThat(answer)
                .hasToString("AllTypes.all(true, 1, 2, c, 3, 4, 5.0, 6.0, t, "
                        + answer.toString().split("t, ")[1]);
        assertThat(test.get(answer)).isEqualTo("true12c345.06.0t2");
    }

    @Test
    void overloads_areDistinguished() {
        Overloaded proxy = test.spawn(Overloaded.class, () -> new Overloaded() {
            @Override
            public Promise<String> show(int value) {
                return Promise.of("int " + value);
            }

            @Override
            public Promise<String> show(long value) {
                return Promise.of("long " + value);
            }

            @Override
            public Promise<String> show(Object value) {
                return Promise.of("object " + value);
            }

            @Override
            public Promise<String> show() {
                return Promise.of("nothing");
            }
        });
        assertThat(List.of(
                        test.get(proxy.show(1)),
                        test.get(proxy.show(1L)),
                        test.get(proxy.show("x")),
                        test.get(proxy.show())))
                .containsExactly("int 1", "long 1", "object x", "nothing");
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
        Promise<String> before = box.swap("full");
        assertThat(test.get(before)).isEqualTo("empty");
        assertThat(test.get(box.take())).isEqualTo("full");
        assertThat(TextBox.label()).isEqualTo("text");
    }

    @Test
    void equalsHashCodeAndToString_stayLocal() {
        Demo3 one = test.spawn(Demo3.class, () -> new Demo3("red"));
        Demo3 two = test.spawn(Demo3.class, () -> new Demo3("red"));
        assertThat(one).isEqualTo(one).isNotEqualTo(two).hasToString("Demo3#1");
        assertThat(one.hashCode()).isEqualTo(System.identityHashCode(one));
        TextBox box = test.spawn(TextBox.class, () -> null);
        assertThat(box).hasToString("TextBox#3").isEqualTo(box);
        assertThat(test.takeProblems()).hasSize(1);
    }

    @Test
    void classActor_callsItselfThroughItsProxy_andItsConstructorRunsOnce() {
        Demo3 demo = test.spawn(Demo3.class, () -> new Demo3("red"));
        demo.live();
        assertThat(test.get(demo.lives()))
                .isEqualTo(2); // this request is queued behind the first call, which has queued the second
        assertThat(test.get(demo.lives())).isEqualTo(3);
        test.space().stop(demo);
        test.crank();
        assertThat(Demo3.LOG)
                .containsExactly(
                        "constructor",
                        "started",
                        "live red 1",
                        "after the call",
                        "live red 2",
                        "after the call",
                        "live red 3",
                        "stopped");
    }

    @Test
    void methodThatIsNoMessage_throwsOnAProxy() {
        Demo3 demo = test.spawn(Demo3.class, () -> new Demo3("red"));
        assertThatThrownBy(demo::secret)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("Demo3.secret()")
                .hasMessageContaining("not public");
    }

    @Test
    void actorOnlyMethod_outsideItsSpace_throws() {
        var escaped = new Demo3("red");
        assertThatThrownBy(escaped::live)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("spawned actor");
    }

    @Test
    void spawn_ofAFactoryThatAnswersAProxy_isReported() throws Exception {
        TextBox inner = test.spawn(TextBox.class, () -> null);
        test.spawn(TextBox.class, () -> inner);
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getMessage())
                .satisfiesExactly(
                        first -> assertThat(first).contains("answered null"),
                        second -> assertThat(second).contains("answered a proxy"));
        Callable<String> label = TextBox::label;
        assertThat(label.call()).isEqualTo("text");
    }

    abstract static class Stepping extends Actor {
        protected abstract void step();
    }

    public static class Walker extends Stepping {
        static int steps;

        @Override
        public void step() {
            steps++;
            stop();
            steps++; // the message is processed to its end
        }

        @Override
        protected void stopped() {
            steps *= 10;
        }
    }

    @Test
    void methodThatBecomesPublicInASubclass_isAMessage_andStopWaitsForItsEnd() {
        Walker walker = test.spawn(Walker.class, Walker::new);
        walker.step();
        test.crank();
        assertThat(Walker.steps).isEqualTo(20);
        Walker.steps = 0;
    }

    interface Named {
        Promise<String> Proxy();

        Promise<String> Proxy(int number);
    }

    @Test
    void methodNames_neverMeetGeneratedOnes() {
        Named named = test.spawn(Named.class, () -> new Named() {
            @Override
            public Promise<String> Proxy() {
                return Promise.of("plain");
            }

            @Override
            public Promise<String> Proxy(int number) {
                return Promise.of("number " + number);
            }
        });
        assertThat(test.get(named.Proxy())).isEqualTo("plain");
        assertThat(test.get(named.Proxy(2))).isEqualTo("number 2");
    }
}
