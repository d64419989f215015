package io.troupe.demo.terminal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import java.time.Duration;
import java.util.ArrayList;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class InterruptionTest {
    private final Interruption interruption = Interruption.none();

    @Test
    void request_isNoticedByAllWaysToLook_andALateListenerRunsAtOnce() {
        interruption.check();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isFalse();
        var log = new ArrayList<String>();
        interruption.onRequest(() -> log.add("asked"));

        interruption.request();

        assertThat(interruption.isRequested()).isTrue();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isTrue();
        assertThat(log).containsExactly("asked");
        assertThatThrownBy(interruption::check).isInstanceOf(InterruptedCommand.class);

        interruption.onRequest(() -> log.add("late"));
        assertThat(log).containsExactly("asked", "late");
    }

    @Test
    void waitForARequest_endsWithTheRequest_orWhenItsThreadIsInterrupted() throws Exception {
        Thread.currentThread().interrupt();
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isFalse();
        assertThat(Thread.interrupted()).isTrue();

        var waiting = Thread.ofPlatform().start(interruption::request);
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isTrue(); // returns at once
        waiting.join();
    }
}
