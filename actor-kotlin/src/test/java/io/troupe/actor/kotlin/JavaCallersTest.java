package io.troupe.actor.kotlin;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** Java code calls actors whose functions suspend: it passes the continuation that it is given. */
class JavaCallersTest {
    private final TestSpace test = new TestSpace();
    private final SamplesTest.Greeter greeter = test.spawn(SamplesTest.Greeter.class, SamplesTest.PoliteGreeter::new);

    @AfterEach
    void close() {
        test.close();
    }

    @Test
    void callOfASuspendFunction_isAPromise() {
        Promise<String> text = Promises.ask(continuation -> greeter.greet("Ada", continuation));
        assertThat(test.get(text)).isEqualTo("Hello, Ada");
        assertThat(text).asString().startsWith("Greeter.greet(String) of Greeter#1");
    }

    @Test
    void promise_canBeCancelledWhileTheCallWaits() {
        Promise<String> text = Promises.ask(continuation -> greeter.greet("Ada", continuation));
        text.cancel();
        assertThat(test.error(text)).isInstanceOf(CancellationException.class);
    }

    @Test
    void otherSuspendFunction_isRefusedByName() {
        var plain = new SamplesTest.PoliteGreeter();
        assertThatThrownBy(() -> Promises.<String>ask(continuation -> plain.greet("Ada", continuation)))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("made on a proxy of an actor");
    }
}
