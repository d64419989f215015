package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.testkit.TestSpace;
import java.io.IOException;
import java.lang.invoke.MethodHandles;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Path;
import java.util.List;
import java.util.Objects;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;

/** What cannot be an actor type, and what its author reads at {@code spawn}; and types of other class loaders. */
class ActorTypeRejectionTest extends InTestSpace {
    /** Types; the line below one that is rejected has the parts of the error's text, where @ is the type's name. */
    private static final String TYPES = """
            interface Thermometer { int degrees(); }
              Thermometer.degrees() | returns int | Promise<Integer>
            interface Listing { List<String> names(); }
              Listing.names() | returns List<String>, expected void | make it Promise<List<String>>, and return Promise.of(..)
            interface Wildcards { Map<? super String, ? extends List<?>>[] all(); }
              Wildcards.all() | make it Promise<Map<? super String, ? extends List<?>>[]>
            interface Completing { CompletableFuture<String> name(); }
              returns CompletableFuture<String>, expected void | make it Promise<String>, and return Promise.from(future)
            interface Staged { CompletionStage<List<String>> names(); }
              Staged.names() | make it Promise<List<String>>, and return Promise.from(future)
            interface Blocking { Future<String> name(); }
              returns Future<String>, expected void | make it Promise<String>, and return space().offload(future::get)
            interface Raw { CompletableFuture name(); }
              Raw.name() | make it Promise<Object>, and return Promise.from(future)
            interface Deferring { Deferred<String> name(); }
              Deferring.name() | returns Deferred<String> | make it Promise<String>, which Deferred is
            interface Welcome { void hello(); }
            class Host implements java.io.Serializable, Welcome { public void hello() {} }
              does not extend io.troupe.actor.Actor; spawn it by its interface | spawn(Welcome.class, Host::new) | spawn<Welcome> { Host() }
            class Guest { public void hello() {} }
              does not extend io.troupe.actor.Actor; use an interface, or extend Actor
            final class Butler extends Actor implements Welcome { public void hello() {} }
              it is final | spawn(Welcome.class, Butler::new)
            public class Gauge extends Actor { public int level() { return 1; } }
              Gauge.level() | less visible than public
            interface Labelled { default String label() { return "label of " + this; } }
            public class Jar extends Actor implements Labelled {}
              Labelled.label() of actor type @ | returns String | make it static, or spawn the actor by an interface
            public abstract class Shelf extends Actor implements Comparable<Shelf> {}
              Comparable.compareTo( | returns int
            public class PublicField extends Actor { public int count; }
              the field PublicField.count of actor type @ | make it private | Promise
            abstract class ProtectedField extends Actor { protected final List<String> shared = new ArrayList<>(); }
            public class InheritedField extends ProtectedField {}
              the field ProtectedField.shared of actor type @ | make it private
            public class PackageField extends Actor { long total; }
              the field PackageField.total of actor type @ | make it private
            public abstract class FinalMessage extends Actor { public final void fixed() {} }
              FinalMessage.fixed() | is final
            public class FinalHelper extends Actor { protected final void help() {} }
              FinalHelper.help() of actor type @ | is final | remove final | or make it private
            class Lamp extends Actor { private boolean on; public void set(boolean value) { on = value; } }
            public class FinalPackageHelper extends Lamp { final String help(int times) { return "help" + times; } }
              FinalPackageHelper.help(int) of actor type @ | or make it private
            public class FinalStart extends Actor { @Override protected final void started() {} }
              FinalStart.started() of actor type @ | is final
            public class PublicStop extends Actor { @Override public void stopped() {} }
              PublicStop.stopped() of actor type @ | hook of Actor | make it protected, or give the message another name
            interface Race { void started(); }
            public class Runner extends Actor implements Race { @Override public void started() {} }
              Runner.started() of actor type @ | hook of Actor | another name
            public class Sprinter extends Runner {}
              Runner.started() of actor type @ | hook of Actor
            public class FinalText extends Actor { @Override public final String toString() { return "text"; } }
              FinalText.toString() of actor type @ | is final
            public class Finalized extends Actor { @Override protected void finalize() {} }
              Finalized.finalize() of actor type @ | garbage collector | stopped()
            interface Collected { void finalize(); }
              Collected.finalize() of actor type @ | garbage collector
            enum Colour { RED }
              does not extend io.troupe.actor.Actor
            record Only() implements Closed {}
              does not extend io.troupe.actor.Actor
            sealed interface Closed permits Only {}
              it is sealed
            public interface Fits { void go(126 PARAMETERS, int last); }
            public interface Longs { void go(127 PARAMETERS); }
              Longs.go(long, | takes 254 argument slots | at most 253 | pass an array or a record
            interface Answering { Promise<Callback<Integer>> listener(); }
              Answering.listener() | on the caller's side
            """;

    /** A callback is wrapped only where the parameter is one, so no other argument may contain one. */
    private static final String WANDERERS = """
            interface Subtype { void wander(String where, Colours colours); }
            interface StreamItself { void wander(String where, Callback.Stream<Integer> colours); }
            interface Array { Promise<String> wander(String where, Callback<Integer>[] colours); }
            interface DeepArray { void wander(String where, Callback<Integer>[][] colours); }
            interface Varargs { void wander(String where, Callback<Integer>... colours); }
            interface Listed { void wander(String where, List<Callback<Integer>> colours); }
            interface Wild { void wander(String where, Map<String, ? extends List<? super Colours>> colours); }
            interface Nested { void wander(String where, Callback<Callback<Integer>> colours); }
            interface Variable { <C extends Callback<Integer>> void wander(String where, C colours); }
            interface Inherited extends Follower<Callback<Integer>> {}
            public abstract class OfAClass extends Actor implements Follower<Callback<Integer>[]> {}
            public class Seen extends Unseen {}
            """;

    /** The compiler's bridge to the method of Unseen does not include the type of the list's elements. */
    private static final String SUPERTYPES_OF_WANDERERS = """
            interface Colours extends Callback<Integer> {}
            interface Follower<T> { void wander(String where, T colours); }
            abstract class Unseen extends Actor { public void wander(String where, List<Callback<Integer>> colours) {} }
            """;

    private static final String IMPORTS =
            "package types; import io.troupe.actor.*; import io.troupe.actor.*; import java.util.*;"
                    + " import java.util.concurrent.*; ";

    @TempDir
    private static Path folder;

    private static URLClassLoader loader;

    @BeforeAll
    static void compile() throws IOException {
        var sources = new Compiled(folder);
        Stream.of(TYPES, WANDERERS, SUPERTYPES_OF_WANDERERS)
                .flatMap(String::lines)
                .filter(line -> !line.startsWith(" "))
                .map(line -> line.replace("126 PARAMETERS", longs(126)).replace("127 PARAMETERS", longs(127)))
                .forEach(line -> sources.add("types." + nameOf(line), IMPORTS + line));
        sources.add("one.Base", "package one; public class Base extends io.troupe.actor.Actor { void help() {} }");
        sources.add("one.Open", "package one; public class Open extends Base { @Override public void help() {} }");
        sources.add("two.Bad", "package two; public class Bad extends one.Base { void help() {} }");
        sources.add("two.Good", "package two; public class Good extends one.Open {}");
        sources.add("far.Plain", "package far; public interface Plain { void go(); }");
        sources.add("far.Asked", "package far; public interface Asked { io.troupe.actor.Promise<String> go(); }");
        sources.add("far.Greeter", """
                package far;
                import io.troupe.actor.Promise;
                interface Parent { Promise<String> greet(String name); }
                public interface Greeter extends Parent {
                    class Polite implements Greeter {
                        public Promise<String> greet(String name) { return Promise.of("dear " + name); }
                    }
                    static Promise<String> ask(Object greeter, String name) { return ((Greeter) greeter).greet(name); }
                }
                """);
        loader = sources.load();
    }

    private static String longs(int count) {
        return IntStream.range(0, count).mapToObj(index -> "long a" + index).collect(Collectors.joining(", "));
    }

    private static String nameOf(String source) {
        return source.replaceFirst(".*?(class|interface|enum|record) (\\w+).*", "$2");
    }

    @AfterAll
    static void close() throws IOException {
        if (loader != null) { // without a compiler the tests are skipped
            loader.close();
        }
    }

    static void rejects(TestSpace test, Class<?> type, String... parts) {
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContaining(type.getName())
                .hasMessageContainingAll(parts);
    }

    static List<Arguments> rejectedTypes() {
        List<String> lines = TYPES.lines().toList();
        return IntStream.range(1, lines.size())
                .filter(line -> lines.get(line).startsWith(" "))
                .mapToObj(line -> Arguments.of(
                        nameOf(lines.get(line - 1)), lines.get(line).strip()))
                .toList();
    }

    @ParameterizedTest
    @MethodSource("rejectedTypes")
    void typeThatCannotBeAnActorType_isRejectedAtSpawn_withWhatToDo(String name, String text) throws Exception {
        Class<?> type = loader.loadClass("types." + name);
        rejects(test, type, text.replace("@", type.getName()).split(" \\| "));
    }

    static Stream<String> wanderers() {
        return WANDERERS.lines().map(ActorTypeRejectionTest::nameOf);
    }

    @ParameterizedTest
    @MethodSource("wanderers")
    void callbackInAnotherType_isRejectedAtSpawn(String name) throws Exception {
        Class<?> type = loader.loadClass("types." + name);
        String advice = "declare the parameter as Callback<T>";
        rejects(test, type, ".wander(String, ", "actor type " + type.getName(), "parameter 2 (colours)", advice);
    }

    @Test
    void typesOfTheJavaLibrary_andOfThisOne_areRejectedWithAReason() {
        rejects(test, Runnable.class, "opens java.lang;", "java.base");
        rejects(test, Override.class, "it is an annotation");
        rejects(test, int.class, "does not extend io.troupe.actor.Actor");
        rejects(test, Taken[].class, "does not extend io.troupe.actor.Actor");
        rejects(test, ActorProxy.class, "ActorProxy.troupe$cell()", "returns Recipient");
    }

    interface ToHide {
        void go();
    }

    @Test
    void hiddenInterface_isRejectedAtSpawn() throws Exception {
        try (var file = ToHide.class.getResourceAsStream("ActorTypeRejectionTest$ToHide.class")) {
            byte[] bytes = Objects.requireNonNull(file).readAllBytes();
            rejects(test, MethodHandles.lookup().defineHiddenClass(bytes, false).lookupClass(), "it is hidden");
        }
    }

    interface Taken {
        void go();
    }

    @SuppressWarnings("unused") // has the name of the proxy of Taken
    static class Taken$$Proxy {}

    @Test
    void typeWhoseProxysNameIsTaken_isRejectedAtSpawn_andAgain() {
        rejects(test, Taken.class, "cannot be defined in its package");
        rejects(test, Taken.class, "cannot be defined in its package");
    }

    @Test
    void packagePrivateMethodOfAnotherPackage_isRejectedAtSpawn_unlessOverriddenThere() throws Exception {
        String why = "package-private in another package";
        rejects(test, loader.loadClass("two.Bad"), "Base.help()", why, "protected or private");
        assertThat(test.space().spawn(loader.loadClass("two.Good"), () -> null)).isNotNull();
        test.runQueued();
        assertThat(test.takeProblems()).hasSize(1); // the factory
    }

    @Test
    void methodWithAsManyArgumentsAsAreAllowed_isAccepted() throws Exception {
        assertThat((Object) test.spawn(loader.loadClass("types.Fits"), () -> null))
                .hasToString("Fits#1");
        assertThat(test.takeProblems()).hasSize(1); // the factory
    }

    @Test
    void typesOfAnotherLoader_workWithTheirLoadersClasses() throws Exception {
        Class<?> type = loader.loadClass("far.Greeter");
        Object polite = loader.loadClass("far.Greeter$Polite").getConstructor().newInstance();
        Object proxy = spawn(type, polite);
        var answer =
                (Promise<?>) type.getMethod("ask", Object.class, String.class).invoke(null, proxy, "Ann");
        assertThat(test.get(answer)).isEqualTo("dear Ann");
        assertThat(proxy.getClass().getClassLoader()).isSameAs(loader);
    }

    private <A> A spawn(Class<A> type, Object implementation) {
        return test.spawn(type, () -> type.cast(implementation));
    }

    @Test
    void typeWhoseLoaderDoesNotSeeThisLibrary_orSeesAnotherCopy_isRejectedAtSpawn() throws Exception {
        URL classes = folder.toUri().toURL();
        URL own = ActorSpace.class.getProtectionDomain().getCodeSource().getLocation();
        try (var alone = new URLClassLoader(new URL[] {classes}, null);
                var copies = new URLClassLoader(new URL[] {classes, own}, null)) {
            rejects(test, alone.loadClass("far.Plain"), "far.Plain", "io.troupe.actor", "does not see it");
            rejects(test, copies.loadClass("far.Asked"), "far.Asked", "another copy");
        }
    }
}
