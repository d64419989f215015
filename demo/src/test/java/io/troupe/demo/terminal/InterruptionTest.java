package io.troupe.demo.terminal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class InterruptionTest {
    private final Interruption interruption = Interruption.none();

    @Test
    void request_isNoticedByAllWaysToLook() {
        interruption.check();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isFalse();
        List<String> log = new ArrayList<>();
        interruption.onRequest(() -> log.add("asked"));

        interruption.request();

        assertThat(interruption.isRequested()).isTrue();
        assertThat(interruption.isRequestedWithin(Duration.ZERO)).isTrue();
        assertThat(log).containsExactly("asked");
        assertThatThrownBy(interruption::check).isInstanceOf(InterruptedCommand.class);
    }

    @Test
    void actionOfALateListener_runsAtOnce() {
        interruption.request();
        List<String> log = new ArrayList<>();
        interruption.onRequest(() -> log.add("asked"));
        assertThat(log).containsExactly("asked");
    }

    @Test
    void waitForARequest_endsWithTheRequest() throws Exception {
        var waiting = Thread.ofPlatform().start(interruption::request);
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isTrue(); // returns at once
        waiting.join();
    }

    @Test
    void waitForARequest_endsWhenItsThreadIsInterrupted() {
        Thread.currentThread().interrupt();
        assertThat(interruption.isRequestedWithin(Duration.ofHours(1))).isFalse();
        assertThat(Thread.interrupted()).isTrue();
    }
}
