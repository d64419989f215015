package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.Request;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Only messages may run on the proxy of a class actor, whose fields are unset. */
class ClassActorTest {
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

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void unimplementedInterfaceMethodsOfAnAbstractClass_areMessages() {
        AbstractLamp lamp = test.spawn(AbstractLamp.class, RealLamp::new);
        assertThat(test.get(lamp.show())).isEqualTo("on ");
        lamp.set(false);
        assertThat(test.get(lamp.show())).isEqualTo("off ");
    }

    @Test
    void inheritedDefaultMethods_areMessages() {
        RealLamp lamp = test.spawn(RealLamp.class, RealLamp::new);
        assertThat(test.get(lamp.twice())).isEqualTo("on on ");
        lamp.off();
        Promise<String> later = lamp.twice();
        assertThat(later.toString()).startsWith("RealLamp.twice()");
        assertThat(test.get(later)).isEqualTo("off off ");
    }

    interface Labelled {
        default String label() {
            return "label of " + this;
        }
    }

    public static class Jar extends Actor implements Labelled {}

    public abstract static class Shelf extends Actor implements Comparable<Shelf> {}

    @Test
    void interfaceMethodThatAnswersAtOnce_isRejectedAtSpawn() {
        refused(Jar.class, "Labelled.label()", "returns String", "make it static, or spawn the actor by an interface");
        refused(Shelf.class, "Comparable.compareTo(", "returns int");
    }

    public static class Clockwork extends Actor {
        private final List<String> log = new ArrayList<>();

        @Override
        public void started() {
            log.add("started");
        }

        @Override
        public void stopped() {
            log.add("stopped");
        }

        public void started(int times) {
            log.add("started " + times);
        }
    }

    @Test
    void startedAndStopped_throwOnAProxy_evenIfPublic() {
        var made = new Clockwork();
        Clockwork proxy = test.spawn(Clockwork.class, () -> made);
        for (Runnable call : List.<Runnable>of(proxy::started, proxy::stopped)) {
            assertThatThrownBy(call::run)
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageStartingWith("Clockwork.st")
                    .hasMessageContaining("the actor's space calls it");
        }
        Actor silent = test.spawn(RealLamp.class, RealLamp::new);
        assertThatThrownBy(silent::started).isInstanceOf(IllegalStateException.class);
        proxy.started(2);
        test.space().stop(proxy);
        test.crank();
        assertThat(made.log).containsExactly("started", "started 2", "stopped");
    }

    public static class PublicField extends Actor {
        public int count;
    }

    abstract static class ProtectedField extends Actor {
        protected final List<String> shared = new ArrayList<>();
    }

    public static class InheritedField extends ProtectedField {}

    public static class PackageField extends Actor {
        long total;
    }

    @Test
    void fieldsThatOthersCanReach_areRejectedAtSpawn() {
        refused(PublicField.class, "the field PublicField.count", "make it private", "Promise");
        refused(InheritedField.class, "the field ProtectedField.shared", "make it private");
        refused(PackageField.class, "the field PackageField.total", "make it private");
    }

    public static class FinalHelper extends Actor {
        protected final void help() {}
    }

    public static class FinalPackageHelper extends RealLamp {
        final String help(int times) {
            return "help" + times;
        }
    }

    public static class FinalStart extends Actor {
        @Override
        protected final void started() {}
    }

    public static class FinalText extends Actor {
        @Override
        public final String toString() {
            return "text";
        }
    }

    public static class Finalized extends Actor {
        @Override
        @SuppressWarnings({"removal", "Finalize"})
        protected void finalize() {}
    }

    interface Collected {
        void finalize();
    }

    @Test
    void methodsThatAProxyCannotOverride_areRejectedAtSpawn() {
        refused(FinalHelper.class, "FinalHelper.help()", "is final", "remove final", "or make it private");
        refused(FinalPackageHelper.class, "FinalPackageHelper.help(int)", "or make it private");
        refused(FinalStart.class, "FinalStart.started()", "is final");
        refused(FinalText.class, "FinalText.toString()", "is final");
        refused(Finalized.class, "Finalized.finalize()", "garbage collector", "stopped()");
        refused(Collected.class, "Collected.finalize()", "garbage collector");
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
        public Promise<String> old() throws java.io.IOException {
            throw new java.io.IOException("too old");
        }

        public native void machine();

        public <T extends Comparable<T>> Promise<T> max(List<? extends T> values) {
            return Promise.of(java.util.Collections.max(values));
        }

        static String unrelated() {
            return "static";
        }
    }

    @Test
    void oddButPossibleMethods_areMessages() {
        Cloned proxy = test.spawn(Cloned.class, Cloned::new);
        assertThat(test.get(proxy.clone())).isEqualTo("copy");
        assertThat(test.get(proxy.wait("you"))).isEqualTo("waited for you");
        assertThat(test.get(proxy.locked())).isTrue();
        assertThat(test.get(proxy.max(List.of(3, 5, 4)))).isEqualTo(5);
        assertThat(Cloned.unrelated()).isEqualTo("static");
        proxy.notify(2);
        assertThatThrownBy(() -> test.get(proxy.old())).hasStackTraceContaining("too old");
        proxy.machine();
        test.crank();
        assertThat(test.takeProblems())
                .extracting(problem -> problem.error().getClass().getSimpleName())
                .containsExactly("UnsatisfiedLinkError");
    }

    abstract static class Base<T> extends Actor {
        private final List<Object> got = new ArrayList<>();

        List<Object> got() {
            return got;
        }

        public void put(T value) {
            got.add("base");
        }

        public Object answer() {
            return "base";
        }

        protected abstract void step(T value);

        protected Object part() {
            return "base";
        }
    }

    public static class Sub extends Base<String> {
        @Override
        public void put(String value) {
            got().add(value);
        }

        @Override
        public Promise<String> answer() {
            return Promise.of("sub");
        }

        @Override
        public void step(String value) {
            got().add("step " + value);
        }

        @Override
        protected String part() {
            return "sub";
        }
    }

    @Test
    void bridges_leadToMessages() {
        var made = new Sub();
        Sub proxy = test.spawn(Sub.class, () -> made);
        Base<String> base = proxy;
        proxy.put("a");
        base.put("b");
        base.step("c");
        assertThat(base.answer()).isInstanceOf(Request.class);
        assertThatThrownBy(base::part).hasMessageContaining("Sub.part()");
        assertThat(test.get(proxy.answer())).isEqualTo("sub");
        assertThat(made.got()).containsExactly("a", "b", "step c");
        test.crank();
    }

    /** Public methods of a class that is not public: the compiler generates bridges to them in a public subclass. */
    abstract static class Unseen extends Actor {
        private int count;

        void count(int more) {
            count += more;
        }

        public Promise<Integer> next(Callback<String> names) {
            names.next("n" + ++count);
            return Promise.of(count);
        }

        public void next(Object any) {
            count += 10;
        }
    }

    public static class Seen extends Unseen {
        public void next(String text) {
            count(100);
        }
    }

    @Test
    void methodsOfAnUnseenSuperclass_areMessages() {
        var names = new ArrayList<String>();
        Seen proxy = test.spawn(Seen.class, Seen::new);
        proxy.next((Object) 1);
        proxy.next("text");
        Promise<Integer> answer = proxy.next((String name, Throwable error) -> names.add(name));
        assertThat(test.get(answer)).isEqualTo(111);
        test.crank();
        assertThat(names).containsExactly("n111");
    }

    public static class Outer {
        private final String name = "outer";

        private class Inner extends Actor {
            public Promise<String> name() {
                return Promise.of(name);
            }
        }
    }

    private abstract static class Hidden extends Actor {
        public abstract Promise<String> name();

        abstract String secret();
    }

    @Test
    void innerAndPrivateClasses_canBeActors() {
        var outer = new Outer();
        Outer.Inner inner = test.spawn(Outer.Inner.class, () -> outer.new Inner());
        assertThat(test.get(inner.name())).isEqualTo("outer");
        Hidden hidden = test.spawn(Hidden.class, () -> new Hidden() {
            @Override
            public Promise<String> name() {
                return Promise.of("hidden");
            }

            @Override
            String secret() {
                return "secret";
            }
        });
        assertThat(test.get(hidden.name())).isEqualTo("hidden");
        assertThatThrownBy(hidden::secret).hasMessageContaining("Hidden.secret()");
    }

    private void refused(Class<?> type, String method, String... reasons) {
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining(method + (method.endsWith("(") ? "" : " of actor type " + type.getName()))
                .hasMessageContainingAll(reasons);
    }
}
