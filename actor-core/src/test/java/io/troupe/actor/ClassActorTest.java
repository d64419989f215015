package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.util.Collections;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Only messages may run on the proxy of a class actor, whose fields are unset. */
class ClassActorTest extends InTestSpace {
    /** As in the paper, it calls itself through its proxy. */
    class Demo3 extends Actor {
        private int lives;

        Demo3() {
            log.add("constructor");
        }

        @Override
        protected void started() {
            log.add("started");
        }

        @Override
        protected void stopped() {
            log.add("stopped");
        }

        public void live() {
            log.add("live " + ++lives);
            if (lives < 3) {
                ((Demo3) self()).live();
                log.add("after the call");
            }
        }

        public Promise<Integer> lives() {
            return Promise.of(lives);
        }

        int secret() {
            return lives;
        }

        @Override
        public boolean equals(Object other) {
            return other instanceof Demo3;
        }

        @Override
        public int hashCode() {
            return 3;
        }
    }

    @Test
    void classActor_callsItselfThroughItsProxy_andItsConstructorRunsOnce() {
        Demo3 demo = test.spawn(Demo3.class, Demo3::new);
        demo.live();
        assertThat(test.get(demo.lives())).isEqualTo(2); // queued behind the first call, which has queued the second
        assertThat(test.get(demo.lives())).isEqualTo(3);
        stop(demo);
        String after = "after the call";
        assertThat(log)
                .containsExactly("constructor", "started", "live 1", after, "live 2", after, "live 3", "stopped");
    }

    @Test
    void methodsThatAreNoMessages_ofAProxy_areLocalOrThrow() {
        Demo3 one = test.spawn(Demo3.class, Demo3::new);
        Demo3 two = test.spawn(Demo3.class, Demo3::new);
        assertThat(one).isEqualTo(one).isNotEqualTo(two).hasToString("Demo3#1");
        assertThat(one.hashCode()).isEqualTo(System.identityHashCode(one));
        assertThatThrownBy(one::secret)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContainingAll("Demo3.secret()", "not public");
    }

    @Test
    void actorOnlyMethod_ofAnObjectThatWasNotSpawned_throws() {
        assertThatThrownBy(new Demo3()::live)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("spawned actor");
    }

    abstract static class Stepping extends Actor {
        protected abstract void step();
    }

    public class Walker extends Stepping {
        @Override
        public void step() {
            context().stop();
            log.add("step"); // the message is processed to its end
        }

        @Override
        protected void stopped() {
            log.add("stopped");
        }
    }

    @Test
    void methodThatBecomesPublicInASubclass_isAMessage_andStopWaitsForItsEnd() {
        test.spawn(Walker.class, Walker::new).step();
        test.runQueued();
        assertThat(log).containsExactly("step", "stopped");
    }

    interface Lamp {
        void set(boolean on);

        Promise<String> show();

        default Promise<String> twice() {
            return show().thenApply(text -> text + text);
        }

        default void off() {
            set(false);
        }
    }

    public abstract static class AbstractLamp extends Actor implements Lamp {}

    static class RealLamp extends AbstractLamp {
        private boolean on = true;

        @Override
        public void set(boolean value) {
            on = value;
        }

        @Override
        public Promise<String> show() {
            return Promise.of(on ? "on " : "off ");
        }
    }

    @Test
    void interfaceMethodsOfAClass_thatItDoesNotImplement_areMessages() {
        AbstractLamp lamp = test.spawn(AbstractLamp.class, RealLamp::new);
        assertThat(values(lamp.show())).containsExactly("on ");
        lamp.set(false);
        assertThat(values(lamp.show())).containsExactly("off ");
        RealLamp real = test.spawn(RealLamp.class, RealLamp::new);
        assertThat(values(real.twice())).containsExactly("on on ");
        real.off();
        Promise<String> later = real.twice();
        assertThat(later.toString()).startsWith("RealLamp.twice()");
        assertThat(values(later)).containsExactly("off off ");
    }

    private class Clockwork extends Actor {
        @Override
        protected void started() {
            log.add("started");
        }

        @Override
        protected void stopped() {
            log.add("stopped");
        }

        public void started(int times) {
            log.add("started " + times);
        }
    }

    @Test
    void startedAndStopped_throwOnAProxy() {
        Clockwork proxy = test.spawn(Clockwork.class, Clockwork::new);
        for (Runnable call : List.<Runnable>of(proxy::started, proxy::stopped)) {
            assertThatThrownBy(call::run)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageStartingWith("Clockwork.st")
                    .hasMessageContaining("the actor's space calls it");
        }
        Actor silent = test.spawn(RealLamp.class, RealLamp::new);
        assertThatThrownBy(silent::started).isInstanceOf(IllegalStateException.class);
        proxy.started(2);
        stop(proxy);
        assertThat(log).containsExactly("started", "started 2", "stopped");
    }

    public static class Cloned extends Actor {
        @Override
        public Promise<String> clone() {
            return Promise.of("copy");
        }

        public Promise<String> wait(String what) {
            return Promise.of("waited for " + what);
        }

        public void notify(int times) {}

        public synchronized Promise<Boolean> locked() {
            return Promise.of(Thread.holdsLock(this));
        }

        @Deprecated
        public Promise<String> old() throws IOException {
            throw new IOException("too old");
        }

        public native void machine();

        public <T extends Comparable<T>> Promise<T> max(List<? extends T> values) {
            return Promise.of(Collections.max(values));
        }

        static final String TEXT = "static"; // only fields of an instance must be private

        static String unrelated() {
            return TEXT;
        }
    }

    @Test
    void oddButPossibleMethods_areMessages() {
        Cloned proxy = test.spawn(Cloned.class, Cloned::new);
        assertThat(values(proxy.clone(), proxy.wait("you"), proxy.locked(), proxy.max(List.of(3, 5, 4))))
                .containsExactly("copy", "waited for you", true, 5);
        assertThat(Cloned.unrelated()).isEqualTo("static");
        proxy.notify(2);
        assertThatThrownBy(() -> test.get(proxy.old())).hasStackTraceContaining("too old");
        proxy.machine();
        test.runQueued();
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getClass().getSimpleName())
                .containsExactly("UnsatisfiedLinkError");
    }

    /** Is not public, so the compiler generates bridges to its public methods in a public subclass. */
    abstract class Base<T> extends Actor {
        public void put(T value) {
            log.add("base");
        }

        public Object answer() {
            return "base";
        }

        protected abstract void step(T value);

        protected Object part() {
            return "base";
        }

        public Promise<Integer> next(Callback<String> names) {
            names.next("callback");
            return Promise.of(1);
        }

        public void next(Object any) {
            log.add("object " + any);
        }
    }

    public class Sub extends Base<String> {
        @Override
        public void put(String value) {
            log.add(value);
        }

        @Override
        public Promise<String> answer() {
            return Promise.of("sub");
        }

        @Override
        public void step(String value) {
            log.add("step " + value);
        }

        @Override
        protected String part() {
            return "sub";
        }

        public void next(String text) {
            log.add("text " + text);
        }
    }

    @Test
    void bridges_andMethodsOfASuperclassThatIsNotPublic_areMessages() {
        Sub proxy = test.spawn(Sub.class, Sub::new);
        Base<String> base = proxy;
        proxy.put("a");
        base.put("b");
        base.step("c");
        proxy.next((Object) 1);
        proxy.next("d");
        assertThat(log).isEmpty();
        assertThat(base.answer()).isInstanceOf(Request.class);
        assertThatThrownBy(base::part).hasMessageContaining("Sub.part()");
        assertThat(values(proxy.answer(), proxy.next((String name, Throwable error) -> log.add(name))))
                .containsExactly("sub", 1);
        test.runQueued();
        assertThat(log).containsExactly("a", "b", "step c", "object 1", "text d", "callback");
    }

    private abstract static class Hidden extends Actor {
        public abstract Promise<String> name();

        abstract String secret();
    }

    @Test
    void privateAbstractClass_canBeAnActorType() {
        Hidden hidden = test.spawn(Hidden.class, () -> new Hidden() {
            @Override
            public Promise<String> name() {
                return Promise.of(secret());
            }

            @Override
            String secret() {
                return "hidden";
            }
        });
        assertThat(values(hidden.name())).containsExactly("hidden");
        assertThatThrownBy(hidden::secret)
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("Hidden.secret()");
    }
}
