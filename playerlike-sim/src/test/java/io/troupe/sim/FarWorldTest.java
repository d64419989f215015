package io.troupe.sim;

import static io.troupe.sim.Specs.wall;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.sim.model.WorldSpec;
import java.text.MessageFormat;
import java.util.ArrayList;
import java.util.List;
import java.util.logging.Handler;
import java.util.logging.LogRecord;
import java.util.logging.Logger;
import org.junit.jupiter.api.Test;

/** Physics runs in single precision: a world should be centred on the origin. */
class FarWorldTest {
    private static List<String> warnings(WorldSpec spec) {
        List<String> messages = new ArrayList<>();
        var handler = new Handler() {
            @Override
            public void publish(LogRecord logged) {
                messages.add(MessageFormat.format(logged.getMessage(), logged.getParameters()));
            }

            @Override
            public void flush() {}

            @Override
            public void close() {}
        };
        Logger logger = Logger.getLogger(SpecCheck.class.getName());
        logger.addHandler(handler);
        try {
            World.create(spec, WorldSettings.DEFAULT);
        } finally {
            logger.removeHandler(handler);
        }
        return messages;
    }

    @Test
    void worldBeyond150Metres_isWarnedOf_once_namingWhatIsFarthest() {
        assertThat(warnings(Specs.world(List.of(), wall("far", 160, 0, 1, 1), wall("farther", 0, -200, 1, 1))))
                .containsExactly(
                        "test.world: obstacle 'farther' reaches 201 m from the origin along x or y: beyond 150 m"
                                + " collisions get coarse, expected a world centred on the origin");
    }

    @Test
    void worldWithin150Metres_isNot() {
        assertThat(warnings(Specs.world(List.of(), wall("near", 149, -149, 1, 1))))
                .isEmpty();
    }
}
