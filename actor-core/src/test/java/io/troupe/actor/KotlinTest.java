package io.troupe.actor;

import static io.troupe.actor.ActorTypeRejectionTest.rejects;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.internal.ActorProxy;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.util.HexFormat;
import java.util.List;
import org.junit.jupiter.api.Test;

/** Kotlin's interfaces, classes and lambdas work unchanged. The Kotlin code is src/test/kotlin/greeter/Greeter.kt. */
class KotlinTest extends InTestSpace {
    @Test
    void kotlinInterface_isAnActorType_withLambdasAsCallbacksAndListeners() throws Exception {
        Class<?> type = type("Greeter");
        Object companion = type.getField("Companion").get(null);
        Object greeter =
                companion.getClass().getMethod("spawnIn", ActorSpace.class).invoke(companion, test.space());
        test.run(() -> callAll(greeter));
        assertThat(log)
                .containsExactlyInAnyOrder(
                        "hello hello Ann",
                        "hello Bob null",
                        "null",
                        "5000000001",
                        "number 1 null",
                        "number 2 null",
                        "number 3 null",
                        "0.5",
                        "hello hello Cid and Dan",
                        "9"); // 3 after forgetting, twice that added
        assertThat(log.stream().filter(line -> line.startsWith("number")))
                .containsExactly("number 1 null", "number 2 null", "number 3 null");
    }

    private void callAll(Object greeter) {
        try {
            type("Callers").getMethod("callAll", type("Greeter"), List.class).invoke(null, greeter, log);
        } catch (ReflectiveOperationException e) {
            throw new AssertionError(e);
        }
    }

    @Test
    void openKotlinClass_isAClassActor() throws Exception {
        Object counter =
                type("Callers").getMethod("spawnCounter", ActorSpace.class).invoke(null, test.space());
        Class<?> type = type("Counter");
        type.getMethod("increment").invoke(counter);
        type.getMethod("increment").invoke(counter);
        assertThat(counter).isInstanceOf(ActorProxy.class);
        assertThat((Object) test.get((Promise<?>) type.getMethod("count").invoke(counter)))
                .isEqualTo(110);
    }

    @Test
    void finalClassesAndFunctions_areRejectedWithTheWordThatKotlinHasForIt() throws Exception {
        String open = "in Kotlin, make it open";
        rejects(test, type("Closed"), "greeter.Closed cannot be an actor type", open);
        rejects(test, type("HalfClosed"), "HalfClosed.fixed() of actor type greeter.HalfClosed", open);
        String advice = "declare the parameter as Callback<T>";
        rejects(test, type("ManyCallbacks"), "ManyCallbacks.listen(Callback[])", advice);
    }

    /** What Kotlin compiles {@code suspend fun greet(name: String): String} to. */
    interface Suspending {
        Object greet(String name, kotlin.coroutines.Continuation<? super String> caller);
    }

    @Test
    void suspendFunction_withoutTheModuleThatRunsIt_isRejectedWithItsName() {
        String problem = "Suspending.greet(String) of actor type " + Suspending.class.getName();
        rejects(test, Suspending.class, problem, "is a suspend function: add troupe-actor-kotlin");
    }

    @Test
    void compiledClasses_areThoseOfTheSource() throws Exception {
        byte[] source = Files.readAllBytes(Path.of("src", "test", "kotlin", "greeter", "Greeter.kt"));
        String digest =
                HexFormat.of().formatHex(MessageDigest.getInstance("SHA-256").digest(source));
        try (var recorded = KotlinTest.class.getResourceAsStream("/greeter/source.sha256")) {
            assertThat(recorded).isNotNull();
            assertThat(new String(recorded.readAllBytes(), StandardCharsets.US_ASCII))
                    .as("Greeter.kt has changed: compile it as src/test/kotlin/README.md says")
                    .startsWith(digest);
        }
    }

    /** By name, because Java sources are compiled without the test resources in Gradle. */
    private static Class<?> type(String name) throws ClassNotFoundException {
        return Class.forName("greeter." + name);
    }
}
