package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.junit.jupiter.api.Test;

/** What a space logs by default, as java.util.logging prints it. */
class SpaceLogTest {
    private static final class Kept extends Handler {
        private final List<String> sources = new ArrayList<>();

        @Override
        public void publish(LogRecord record) {
            sources.add(record.getSourceClassName() + " " + record.getSourceMethodName() + ": " + record.getMessage());
        }

        @Override
        public void flush() {}

        @Override
        public void close() {}
    }

    @Test
    void logLines_nameTheirSource_insteadOfALambda() throws Exception {
        var logger = Logger.getLogger(ActorSpace.class.getName());
        var kept = new Kept();
        logger.addHandler(kept);
        logger.setUseParentHandlers(false);
        try {
            var settings = SpaceSettings.named("logged");
            settings.onError().handle("here", new IllegalStateException("broken"));
        } finally {
            logger.setUseParentHandlers(true);
            logger.removeHandler(kept);
        }
        assertThat(kept.sources).containsExactly("io.troupe.actor.SpaceLog error: in here");
    }

    @Test
    void metrics_areReadableAsText() {
        try (var test = new TestSpace()) {
            test.space().execute(() -> {});
            test.crank();
            assertThat(test.space().metrics())
                    .hasToString("served 1, waiting 0, latency PT0S, actors 0, timers 0, errors 0, dead letters 0");
        }
    }
}
