package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.io.InputStream;
import java.lang.invoke.MethodHandles;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Path;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Types from other packages, from other class loaders, and hidden types. */
class ForeignTypeTest {
    @TempDir
    private Path folder;

    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void methodWithTooManyArguments_isRejectedAtSpawn() throws Exception {
        var sources = new Compiled(folder);
        sources.add("many.Fits", "package many; public interface Fits { void go(" + parameters(126) + ", int last); }");
        sources.add("many.Longs", "package many; public interface Longs { void go(" + parameters(127) + "); }");
        try (var loader = sources.load()) {
            Object proxy = test.space().spawn(loader.loadClass("many.Fits"), () -> null);
            test.crank();
            assertThat(proxy).hasToString("Fits#1");
            assertThat(test.takeProblems()).hasSize(1); // the factory
            refused(
                    loader.loadClass("many.Longs"),
                    "Longs.go(long, ",
                    "takes 254 argument slots",
                    "at most 253",
                    "pass an array or a record");
        }
    }

    private static String parameters(int count) {
        return IntStream.range(0, count).mapToObj(index -> "long a" + index).collect(Collectors.joining(", "));
    }

    @Test
    void packagePrivateMethodOfAnotherPackage_isRejectedAtSpawn_unlessOverriddenThere() throws Exception {
        var sources = new Compiled(folder);
        sources.add("one.Base", "package one; public class Base extends io.troupe.actor.Actor { void help() {} }");
        sources.add("one.Open", "package one; public class Open extends Base { @Override public void help() {} }");
        sources.add("two.Bad", "package two; public class Bad extends one.Base { void help() {} }");
        sources.add("two.Good", "package two; public class Good extends one.Open {}");
        try (var loader = sources.load()) {
            refused(
                    loader.loadClass("two.Bad"),
                    "Base.help()",
                    "package-private in another package",
                    "protected or private");
            assertThat(test.space().spawn(loader.loadClass("two.Good"), () -> null))
                    .isNotNull();
            test.crank();
            assertThat(test.takeProblems()).hasSize(1); // the factory
        }
    }

    @Test
    void typesOfAnotherLoader_workWithTheirLoadersClasses() throws Exception {
        var sources = new Compiled(folder);
        sources.add("far.Greeter", """
                package far;
                interface Parent { io.troupe.actor.promise.Promise<String> greet(String name); }
                public interface Greeter extends Parent {
                    class Polite implements Greeter {
                        public io.troupe.actor.promise.Promise<String> greet(String name) {
                            return io.troupe.actor.promise.Promise.of("dear " + name);
                        }
                    }
                    static io.troupe.actor.promise.Promise<String> ask(Object greeter, String name) {
                        return ((Greeter) greeter).greet(name);
                    }
                }
                """);
        try (var loader = sources.load()) {
            Class<?> type = loader.loadClass("far.Greeter");
            var polite = loader.loadClass("far.Greeter$Polite").getConstructor();
            Object proxy = spawn(type, polite.newInstance());
            var answer = (io.troupe.actor.promise.Promise<?>)
                    type.getMethod("ask", Object.class, String.class).invoke(null, proxy, "Ann");
            assertThat(test.get(answer)).isEqualTo("dear Ann");
            assertThat(proxy.getClass().getClassLoader()).isSameAs(loader);
        }
    }

    private <A> A spawn(Class<A> type, Object implementation) {
        return test.spawn(type, () -> type.cast(implementation));
    }

    @Test
    void typeWhoseLoaderDoesNotSeeThisLibrary_isRejectedAtSpawn() throws Exception {
        var sources = new Compiled(folder);
        sources.add("far.Plain", "package far; public interface Plain { void go(); }");
        sources.load().close();
        try (var alone = new URLClassLoader(new URL[] {sources.classes().toUri().toURL()}, null)) {
            refused(alone.loadClass("far.Plain"), "far.Plain", "io.troupe.actor", "does not see it");
        }
    }

    @Test
    void typeThatSeesAnotherCopyOfThisLibrary_isRejectedAtSpawn() throws Exception {
        URL own = ActorSpace.class.getProtectionDomain().getCodeSource().getLocation();
        var sources = new Compiled(folder);
        sources.add(
                "far.Plain", "package far; public interface Plain { io.troupe.actor.promise.Promise<String> go(); }");
        sources.load().close();
        try (var copies =
                new URLClassLoader(new URL[] {sources.classes().toUri().toURL(), own}, null)) {
            refused(copies.loadClass("far.Plain"), "far.Plain", "another copy");
        }
    }

    interface ToHide {
        void go();
    }

    @Test
    void hiddenInterface_isRejectedAtSpawn() throws Exception {
        Class<?> hidden = MethodHandles.lookup()
                .defineHiddenClass(bytes(ToHide.class), false)
                .lookupClass();
        refused(hidden, "it is hidden");
    }

    private static byte[] bytes(Class<?> type) throws IOException {
        try (InputStream file = type.getResourceAsStream(
                type.getName().substring(type.getPackageName().length() + 1) + ".class")) {
            return java.util.Objects.requireNonNull(file).readAllBytes();
        }
    }

    interface Taken {
        void go();
    }

    @SuppressWarnings("unused") // has the name of the proxy of Taken
    static class Taken$$Proxy {}

    @Test
    void typeWhoseProxysNameIsTaken_isRejectedAtSpawn_andAgain() {
        refused(Taken.class, "cannot be defined in its package");
        refused(Taken.class, "cannot be defined in its package");
    }

    private void refused(Class<?> type, String... reasons) {
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining(type.getName())
                .hasMessageContainingAll(reasons);
    }
}
