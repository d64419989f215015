package io.troupe.bench.worlds;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.bench.BenchmarkTests;
import java.nio.file.Path;
import org.junit.jupiter.api.Test;

class CompareWorldsTest {
    private static CompareWorlds parsed(String... arguments) {
        return BenchmarkTests.parsed(new CompareWorlds(), arguments);
    }

    @Test
    void noOption_comparesAll() {
        var options = parsed();
        assertThat(options.robots()).containsExactly(1, 2, 10, 100, 1_000, 10_000);
        assertThat(options.contenders()).containsExactly(WorldKind.values());
        assertThat(options)
                .extracting(
                        each -> each.comparison.rounds,
                        each -> each.turnMillis,
                        each -> each.comparison.warmUpMillis,
                        each -> each.comparison.seed)
                .containsExactly(9, 500, 3_000, 1L);
    }

    @Test
    void options_areRead() {
        var options = parsed("--turn", "7", "--warm-up", "8", "--seed", "9", "--figure", "a.svg", "--robots", "2,1,2");
        assertThat(options.robots()).containsExactly(1, 2);
        assertThat(options.scene).isEqualTo(BuildScene.FULL);
        assertThat(parsed("--scene", "CAVE").scene).isEqualTo(BuildScene.CAVE);
        assertThat(options)
                .extracting(
                        each -> each.turnMillis,
                        each -> each.comparison.warmUpMillis,
                        each -> each.comparison.seed,
                        each -> each.comparison.figure)
                .containsExactly(7, 8, 9L, Path.of("a.svg"));
    }

    @Test
    void quick_replacesTheOptionsBeforeIt_andNotThoseAfterIt() {
        var options = parsed("--rounds", "8", "--quick", "--robots", "100,2", "--only", "dyn4j");
        assertThat(options.robots()).containsExactly(2, 100);
        assertThat(options.comparison.rounds).isEqualTo(3);
        assertThat(options.turnMillis).isEqualTo(200);
        assertThat(options.comparison.warmUpMillis).isEqualTo(1_000);
        assertThat(options.contenders()).containsExactly(WorldKind.TROUPE, WorldKind.DYN4J);
        assertThat(parsed("--robots", "5", "--quick").robots()).containsExactly(1, 2, 10, 100);
    }

    @Test
    void wrongOptions_areRefused() {
        assertThat(errorOf("--robots", "1,0")).startsWith("--robots is 0, expected 1 or more");
        assertThat(errorOf("--turn")).startsWith("Missing required parameter for option");
        assertThat(errorOf("--only", "stage")).startsWith("--only is stage, expected one of troupe, troupe-2, jbox2d");
        assertThat(errorOf("--slow")).contains("'--slow'", "Usage: CompareWorlds");
    }

    private static String errorOf(String... arguments) {
        return BenchmarkTests.errorOf(new CompareWorlds(), arguments);
    }
}
