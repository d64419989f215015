package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.internal.ActorProxy;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.util.ArrayList;
import java.util.HexFormat;
import java.util.List;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Kotlin's interfaces, classes and lambdas work unchanged. The Kotlin code is src/test/kotlin/greeter/Greeter.kt. */
class KotlinTest {
    private final TestSpace test = new TestSpace();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void kotlinInterface_isAnActorType_withLambdasAsCallbacksAndListeners() throws Exception {
        Class<?> type = type("Greeter");
        Object companion = type.getField("Companion").get(null);
        Object greeter =
                companion.getClass().getMethod("spawnIn", ActorSpace.class).invoke(companion, test.space());
        var log = new ArrayList<String>();
        test.run(() -> call("callAll", greeter, log));
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

    private static void call(String method, Object greeter, List<String> log) {
        try {
            type("Callers").getMethod(method, type("Greeter"), List.class).invoke(null, greeter, log);
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
        refused("Closed", "greeter.Closed cannot be an actor type", "in Kotlin, make it open");
        refused("HalfClosed", "HalfClosed.fixed() of actor type greeter.HalfClosed", "in Kotlin, make it open");
        refused("ManyCallbacks", "ManyCallbacks.listen(Callback[])", "declare the parameter as Callback<T>");
    }

    private void refused(String name, String... reasons) throws ClassNotFoundException {
        Class<?> type = type(name);
        assertThatThrownBy(() -> test.space().spawn(type, () -> null))
                .isInstanceOf(ActorTypeException.class)
                .hasMessageContainingAll(reasons);
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
